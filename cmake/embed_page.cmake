# Writes OUTPUT, a C++ file with the text of PAGE: cmake -DPAGE=... -DOUTPUT=... -P embed_page.cmake
file(READ ${PAGE} text)
set(parts "")
string(LENGTH "${text}" length)
set(size 8000)  # compilers need not take longer literals
set(begin 0)
while(begin LESS length)
    string(SUBSTRING "${text}" ${begin} ${size} part)
    string(APPEND parts "        R\"page(${part})page\",\n")
    math(EXPR begin "${begin} + ${size}")
endwhile()
file(WRITE ${OUTPUT} "// Made by cmake/embed_page.cmake of page.html; edit that.
#include \"view/page.hpp\"

namespace csgrt {

const std::string& page_html() {
    static constexpr const char* parts[] = {
${parts}        \"\"};
    static const std::string text = [] {
        std::string all;
        for (const char* const part : parts) all += part;
        return all;
    }();
    return text;
}

}  // namespace csgrt
")
