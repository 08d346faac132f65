// What an Error says: places, excerpts and suggestions as text.
#include "catch.hpp"

#include <csgrt/error.hpp>

using namespace csgrt;

TEST_CASE("error text: a place as far as it is known") {
    CHECK(format({{"a.json", 3, 7, -1, "/solids/x"}, "is wrong", "", ""}) == "a.json:3:7: /solids/x: is wrong");
    CHECK(format({{"a.json", 3, 0, -1, ""}, "is wrong", "", ""}) == "a.json:3: is wrong");
    CHECK(format({{"a.g", 0, 0, 120, "box"}, "is wrong", "", ""}) == "a.g: byte 120: box: is wrong");
    CHECK(format({{"a.g", 0, 0, 0, ""}, "is wrong", "", ""}) == "a.g: byte 0: is wrong");
    CHECK(format({{"", 0, 0, -1, "box"}, "is wrong", "", ""}) == "box: is wrong");
    CHECK(format({{}, "is wrong", "", ""}) == "is wrong");
}

TEST_CASE("error text: excerpt and suggestion stand on lines of their own") {
    const Diagnostic diagnostic{{"f", 1, 2, -1, ""}, "is wrong", "mend it\nsoon", "ab\n ^"};
    CHECK(format(diagnostic) == "f:1:2: is wrong\n    ab\n     ^\n  mend it\n  soon");
}

TEST_CASE("error text: what() holds every finding", "[promise:refusals]") {
    const Error error(Status::scene, std::vector<Diagnostic>{{{}, "first", "", ""}, {{}, "second", "", ""}});
    CHECK(error.what() == std::string("first\nsecond"));
    CHECK(error.status() == Status::scene);
    CHECK(error.diagnostics().size() == 2);

    const Error plain(Status::file, "cannot be read");
    CHECK(plain.what() == std::string("cannot be read"));
    REQUIRE(plain.diagnostics().size() == 1);
    CHECK(plain.diagnostics()[0].message == "cannot be read");
}
