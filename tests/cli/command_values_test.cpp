#include <limits>

#include "catch.hpp"
#include "cli/text/partitions.hpp"
#include "cli/values.hpp"

using namespace csgrt::cli;

TEST_CASE("sizes") {
    CHECK(parse_size("1024") == std::pair{1024, 1024});
    CHECK(parse_size("1920x1080") == std::pair{1920, 1080});
    CHECK(parse_size("1x32768") == std::pair{1, 32768});
    for (const char* same : {"640X480", "640 x 480", " 640x480 ", "640*480",
                             "640\xC3\x97"
                             "480",
                             "640 \xC3\x97 480"}) {
        CAPTURE(same);
        CHECK(parse_size(same) == std::pair{640, 480});
    }
    for (const char* wrong :
         {"", "x", "0", "32769", "1x", "x1", "1x2x3", "1 2", "1xx2", "-1", "+1", "1.5", "0x10", "99999999999"}) {
        CAPTURE(wrong);
        CHECK(!parse_size(wrong));
    }
}

TEST_CASE("amounts of memory") {
    CHECK(parse_memory("800000") == 800'000u);
    CHECK(parse_memory("3K") == 3072u);
    CHECK(parse_memory("512M") == std::uint64_t{512} << 20);
    CHECK(parse_memory("2G") == std::uint64_t{2} << 30);
    CHECK(parse_memory("1.5G") == std::uint64_t{3} << 29);
    CHECK(parse_memory("0.5k") == 512u);
    CHECK(parse_memory("700B") == 700u);
    for (const char* same : {"2g", "2GB", "2gb", "2GiB", "2 GB", " 2G "}) {
        CAPTURE(same);
        CHECK(parse_memory(same) == std::uint64_t{2} << 30);
    }
    CHECK(parse_memory("16777215T") == std::uint64_t{16'777'215} << 40);
    for (const char* wrong : {"", "M", "B", "iB", "2iB", "0", "0G", "0.0G", "1.5", "1.5B", "2GG", "2 G B", "-1",
                              "-1.5G", "1e3", "16777216T", "18446744073709551616"}) {
        CAPTURE(wrong);
        CHECK(!parse_memory(wrong));
    }
}

TEST_CASE("numbers") {
    CHECK(parse_number("+2.5e-3") == 2.5e-3);
    CHECK(parse_number("-0") == 0.0);
    for (const char* wrong : {"", "+", "+-1", "inf", "nan", "1e999", "1,5", "1 ", "0x1p3", "--1"}) {
        CAPTURE(wrong);
        CHECK(!parse_number(wrong));
    }
}

TEST_CASE("bounds, planes and grids") {
    CHECK(parse_bound("INF") == std::numeric_limits<double>::infinity());
    CHECK(parse_bound("-inf") == -std::numeric_limits<double>::infinity());
    CHECK(parse_bound("-2.5") == -2.5);
    CHECK(!parse_bound("nan"));
    CHECK(parse_plane("Y:-3")->normal == csgrt::Vec3{0, 1, 0});
    CHECK(parse_plane("1,0,2:4")->normal == csgrt::Vec3{1, 0, 2});
    CHECK(parse_plane("1,0,2:4")->distance == 4);
    for (const char* wrong : {"", "z", ":", "z:", ":1", "w:1", "0,0,0:1", "1,2:3", "z:1:2", "z:inf"}) {
        CAPTURE(wrong);
        CHECK(!parse_plane(wrong));
    }
    CHECK(parse_grid("z:32768") == std::pair{csgrt::Axis::z, 32768});
    for (const char* wrong : {"", "z", "z:", "z:0", "z:32769", "w:1", "z:1x1", "z:-1"}) {
        CAPTURE(wrong);
        CHECK(!parse_grid(wrong));
    }
}

TEST_CASE("numbers are written so that they read back", "[promise:shoot]") {
    std::string text;
    append_number(text, 0.1);
    CHECK(text == "0.10000000000000001");
    text.clear();
    csgrt::append_shortest(text, 0.1);
    CHECK(text == "0.1");
    text.clear();
    append_number(text, -std::numeric_limits<double>::infinity());
    CHECK(text == "-inf");
}

TEST_CASE("names are one word", "[promise:shoot]") {
    std::string text;
    append_name(text, "a b\\c\td");
    CHECK(text == "a\\040b\\134c\\011d");
    text.clear();
    append_name(text, "");
    CHECK(text == "-");
    text.clear();
    append_name(text, "-");
    CHECK(text == "\\055");
}
