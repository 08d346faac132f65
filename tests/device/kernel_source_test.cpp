#include "catch.hpp"

#include <stdexcept>
#include <cctype>
#include <set>
#include <string>

#include "device/kernel_source.hpp"

using namespace csgrt;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("every kernel file is in the library, whole", "[device]") {
    bool base = false;
    for (const KernelFile& file : kernel_files()) {
        const std::string text = file.text;
        REQUIRE(!text.empty());
        CHECK(text.back() == '\n');
        if (std::string(file.name) == "shared/base.h") {
            base = true;
            CHECK(text.starts_with("// The language that both compilers accept"));
            CHECK(text.ends_with("#endif\n"));
        }
    }
    CHECK(base);
    CHECK(kernel_files().size() > 10);
}

TEST_CASE("an assembled program has each file once and no #include left", "[device]") {
    const std::string text = assemble_program({"1_count_segments.cl", "2_store_segments.cl"});
    CHECK(count(text, "#include") == 0);
    CHECK(count(text, "#line 1 \"kernels/shared/layout.h\"") == 1);
    CHECK(count(text, "#line 1 \"kernels/traversal/candidates.h\"") == 1);
    CHECK(count(text, "__kernel void count_segments(") == 1);
    CHECK(count(text, "__kernel void store_segments(") == 1);
    // What is included stands before what includes it.
    CHECK(text.find("SolidRecord;") < text.find("__kernel void count_segments("));
}

TEST_CASE("a header's guard is its path, so that no two share one", "[device]") {
    std::set<std::string> guards;
    for (const KernelFile& file : kernel_files()) {
        std::string guard = std::string("CSGRT_") + file.name;
        if (!guard.ends_with(".h")) continue;
        INFO(file.name);
        for (char& c : guard)
            c = c == '.' || c == '/' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        CHECK(guards.insert(guard).second);
        CHECK(std::string(file.text).find("#ifndef " + guard + "\n#define " + guard + "\n") != std::string::npos);
    }
    CHECK(guards.size() > 30);
}

TEST_CASE("a file whose guard is undefined is assembled once more where it is included again", "[device]") {
    const std::string text = assemble_program({"packet/first_hits_packet.h", "first_hits.cl"});
    CHECK(count(text, "#include") == 0);
    for (const char* twice : {"shared/vectors.h", "shared/slab.h", "geometry/ell.h", "geometry/cone.h",
                              "geometry/torus.h", "shading/plastic.h"})
        CHECK(count(text, std::string("#line 1 \"kernels/") + twice + "\"") == 2);
    for (const char* once :
         {"shared/base.h", "shared/layout.h", "geometry/tgc.h", "geometry/tor.h", "shading/pixel.h", "packet/packet.h"})
        CHECK(count(text, std::string("#line 1 \"kernels/") + once + "\"") == 1);
}

TEST_CASE("#line marks give every line its own place", "[device]") {
    // Reads the marks as a compiler does, and looks each line up in the file that they name.
    const std::string text = assemble_program({"1_count_segments.cl"});
    std::string file;
    std::size_t number = 0, at = 0, compared = 0;
    const auto line_of = [](const std::string& name, std::size_t wanted) -> std::string {
        for (const KernelFile& candidate : kernel_files()) {
            if (std::string("kernels/") + candidate.name != name) continue;
            const std::string all = candidate.text;
            std::size_t begin = 0;
            for (std::size_t n = 1; n < wanted; ++n) begin = all.find('\n', begin) + 1;
            return all.substr(begin, all.find('\n', begin) - begin);
        }
        return "no such file: " + name;
    };
    while (at < text.size()) {
        const std::size_t end = text.find('\n', at);
        const std::string line = text.substr(at, end - at);
        at = end + 1;
        if (line.starts_with("#line ")) {
            std::size_t digits = 0;
            number = std::stoul(line.substr(6), &digits);
            file = line.substr(6 + digits + 2);
            file.pop_back();
            continue;
        }
        if (line != line_of(file, number)) FAIL_CHECK(file << ':' << number << ": " << line);
        ++number;
        ++compared;
    }
    CHECK(compared > 100);
}

TEST_CASE("a kernel file that does not exist is named, with who wants it", "[device]") {
    CHECK_THROWS_AS(assemble_program({"6_missing.cl"}), std::logic_error);
    CHECK_THROWS_WITH(assemble_program({"6_missing.cl"}), "no kernel file \"6_missing.cl\", wanted by the host");
}
