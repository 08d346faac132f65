# Writes OUTPUT, a C++ file with the text of the page: cmake -DFOLDER=... -DOUTPUT=... -P embed_page.cmake
#
# The page is FOLDER/index.html with the files that it names in place of their names. Modules become scripts: a name at
# the top of a script is known to all scripts after it, so that their imports and exports go.
file(READ ${FOLDER}/index.html text)
string(REGEX MATCHALL "<script src=\"[^\"]+\"></script>|<link rel=\"stylesheet\" href=\"[^\"]+\">" names "${text}")
foreach(name IN LISTS names)
    string(REGEX REPLACE "^.*(src|href)=\"([^\"]+)\".*$" "\\2" file "${name}")
    file(READ ${FOLDER}/${file} inner)
    if(file MATCHES "\\.mjs$")
        string(REGEX REPLACE "import {[^}]*} from \"[^\"]*\";\n" "" inner "${inner}")
        string(REGEX REPLACE "\nexport " "\n" inner "${inner}")
        set(inner "<script>\n\"use strict\";\n${inner}</script>")
    else()
        set(inner "<style>\n${inner}</style>")
    endif()
    string(REPLACE "${name}" "${inner}" text "${text}")
endforeach()
set(parts "")
string(LENGTH "${text}" length)
set(size 8000)  # compilers need not take longer literals
set(begin 0)
while(begin LESS length)
    string(SUBSTRING "${text}" ${begin} ${size} part)
    string(APPEND parts "        R\"page(${part})page\",\n")
    math(EXPR begin "${begin} + ${size}")
endwhile()
file(WRITE ${OUTPUT} "// Made by cmake/embed_page.cmake of src/view/page; edit the files there.
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
