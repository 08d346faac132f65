#include "catch.hpp"

#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include "device/kernel_source.hpp"

using namespace csgrt;

namespace {

std::istringstream lines_of(const std::string& name) {
    for (const KernelFile& file : kernel_files()) {
        if (name == file.name) return std::istringstream(file.text);
    }
    throw std::logic_error("no kernel file " + name);
}

/// What stands in a file's lines of one directive: the first word after it, which no two lines share.
std::set<std::string> words_after(const std::string& directive, const std::string& name) {
    std::set<std::string> found;
    std::istringstream lines = lines_of(name);
    for (std::string first, second, line; std::getline(lines, line);) {
        if (!(std::istringstream(line) >> first >> second) || first != directive) continue;
        INFO(name << ": " << line);
        CHECK(found.insert(second).second);
    }
    return found;
}

/// The headers that packet.h includes between begin.h and end.h, from kernels/ on.
std::set<std::string> compiled_for_packets() {
    std::set<std::string> found;
    std::istringstream lines = lines_of("packet/packet.h");
    bool between = false;
    for (std::string line; std::getline(lines, line);) {
        if (line == "#include \"end.h\"") return found;
        if (between && !line.empty()) {
            INFO(line);
            REQUIRE(line.starts_with("#include \""));
            const std::string name = line.substr(10, line.size() - 11);
            CHECK(found.insert(name.starts_with("../") ? name.substr(3) : "packet/" + name).second);
        }
        between = between || line == "#include \"begin.h\"";
    }
    FAIL("packet.h does not include end.h");
    return found;
}

/// "geometry/ell.h" -> "CSGRT_GEOMETRY_ELL_H".
std::string guard_of(const std::string& name) {
    std::string guard = "CSGRT_";
    for (const char c : name)
        guard += c == '.' || c == '/' ? '_' : static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    return guard;
}

}  // namespace

TEST_CASE("packet/end.h undefines each name that packet/begin.h defines, and no other", "[kernels]") {
    std::set<std::string> defined = words_after("#define", "packet/begin.h");
    CHECK(defined.erase("CSGRT_PACKET_BEGIN_H") == 1);
    CHECK(defined.size() > 20);
    CHECK(defined == words_after("#undef", "packet/end.h"));
}

TEST_CASE("packet/begin.h lifts the guards of the headers that packet.h includes once more, and of no others",
          "[kernels]") {
    const std::set<std::string> headers = compiled_for_packets();
    std::set<std::string> guards;
    for (const std::string& name : headers) {
        if (name != "packet/closed_form.h") guards.insert(guard_of(name));  // that is compiled for packets alone
    }
    CHECK(headers.size() == guards.size() + 1);
    CHECK(guards.size() > 10);
    CHECK(guards == words_after("#undef", "packet/begin.h"));
}

TEST_CASE("a header that is compiled once more for packets is twice in their program, any other once", "[kernels]") {
    const std::set<std::string> headers = compiled_for_packets();
    std::istringstream lines(assemble_program({"packet/first_hits_packet.h", "first_hits.cl"}));
    std::multiset<std::string> begun;
    const std::string mark = "#line 1 \"kernels/";
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(mark)) begun.insert(line.substr(mark.size(), line.size() - mark.size() - 1));
    }
    CHECK(begun.size() > 40);
    for (const std::string& name : std::set<std::string>(begun.begin(), begun.end())) {
        INFO(name);
        CHECK(begun.count(name) == (headers.count(name) && name != "packet/closed_form.h" ? 2u : 1u));
    }
}
