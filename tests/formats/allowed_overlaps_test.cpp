// Lists of allowed overlaps.
#include <csgrt/check.hpp>

#include "folder.hpp"
#include "thrown.hpp"

using namespace csgrt;

TEST_CASE("a list of allowed overlaps has two patterns a line, in quotation marks if they have blanks",
          "[promise:check]") {
    const test::Folder folder;
    const auto rows = load_allowed_overlaps(folder.write("allowed",
                                                         "\xef\xbb\xbf# known\n"
                                                         "\n"
                                                         "/a.r /b.r\r\n"
                                                         "  \"/left axle/*\"\t*/wheel.r  # welded\n"
                                                         "/x#1.r [!/]*\n"
                                                         "   # the last line has no end\n"
                                                         "\"/p q\" \"/r s\""));
    REQUIRE(rows.size() == 4);
    CHECK((rows[0].first == "/a.r" && rows[0].second == "/b.r"));
    CHECK((rows[1].first == "/left axle/*" && rows[1].second == "*/wheel.r"));
    CHECK((rows[2].first == "/x#1.r" && rows[2].second == "[!/]*"));
    CHECK((rows[3].first == "/p q" && rows[3].second == "/r s"));
    CHECK(load_allowed_overlaps(folder.write("none", "")).empty());
    CHECK(test::thrown_by([&] { load_allowed_overlaps(folder / "absent"); }).status == Status::file);
}

TEST_CASE("all wrong lines of a list of allowed overlaps are told with their places", "[promise:check]") {
    const test::Folder folder;
    const test::Thrown thrown = test::thrown_by([&] {
        load_allowed_overlaps(folder.write("wrong",
                                           "/a /b\n"
                                           "/a\n"
                                           "/a /b /c\n"
                                           "/a \"/b c\n"
                                           "\"/a\"/b /c\n"
                                           "/a b.r\n"
                                           "\"\" /b\n"));
    });
    CHECK(thrown.status == Status::scene);
    const struct {
        int line, column;
        const char* said;
    } all[] = {{2, 3, "the second pattern is missing"},
               {3, 6, "there are more than two patterns"},
               {4, 4, "a quotation mark has no second one on its line"},
               {5, 5, "no blank follows the quotation mark"},
               {6, 4, "'b.r' can be no path, which begins with '/'"},
               {7, 1, "'' can be no path, which begins with '/'"}};
    REQUIRE(thrown.findings.size() == std::size(all));
    for (std::size_t i = 0; i < std::size(all); ++i) {
        CAPTURE(i, thrown.findings[i].message);
        CHECK(thrown.findings[i].message == all[i].said);
        CHECK(thrown.findings[i].place.line == all[i].line);
        CHECK(thrown.findings[i].place.column == all[i].column);
        CHECK(test::says(thrown.findings[i].suggestion, "a line is two patterns of paths"));
    }
}
