// csgrt compare: equal, different, and no files for it.
#include <csgrt/image.hpp>

#include "cli/command.hpp"

using namespace command_test;

namespace {

constexpr const char* partitions =
    "# csgrt 0 model balls.json\n"
    "ray 0 2 1\n"
    "/a 1 2 1 0 0 -1 0 0 s s ell ell\n"
    "/b 2 inf 1 0 0 -1 0 0 s t ell half\n"
    "overlap 1.5 2 /a /b\n"
    "ray 1 0 0\n";

struct Change {
    const char *from, *to;
    const char* said;
    int status, status_within;  ///< bit by bit, and with --tolerance 0.01
};

std::string changed(std::string text, const std::string& from, const std::string& to) {
    REQUIRE(contains(text, from));
    return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("files of partitions are compared bit by bit, or within a tolerance", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string a = folder.write("a.txt", partitions);
    const Result equal = run({"compare", a, folder.write("b.txt", std::string("# another head\n") + partitions)});
    CHECK(equal.status == 0);
    CHECK(equal.err.empty());
    CHECK(equal.out == "2 rays compared\nequal\n");
    const std::string shorter = folder.write("shorter.txt", changed(partitions, "ray 1 0 0\n", ""));
    for (const auto& words : {std::vector{a, shorter}, std::vector{shorter, a}}) {
        const Result lacking = run({"compare", words[0], words[1]});
        CHECK(lacking.status == 8);
        CHECK(contains(lacking.out, "1 ray more in " + a));
    }

    const Change changes[] = {
        {"/a 1 2 ", "/a 1.0000000000000002 2 ", "1 ray with other distances, by at most 2.2204460492503131e-16: ray 0",
         8, 0},
        {"/a 1 2 ", "/a 1.02 2 ", "1 ray with other distances", 8, 8},
        {"/a 1 2 ", "/c 1 2 ", "1 ray with other regions, the first is ray 0", 8, 8},
        {"inf", "1e300", "other distances, by at most inf", 8, 8},
        {"overlap 1.5", "overlap 1.501", "1 ray with other overlaps", 8, 0},
        {"overlap 1.5 2 /a /b", "overlap 1.5 2 /b /a", "1 ray with other overlaps", 8, 8},
        {" 1 0 0 -1 0 0 s s", " 1 -0 0 -1 0 0 s s", "1 ray with other normals", 8, 0},
        {"s t ell half", "s u ell half", "1 ray with other solids", 8, 0},
        {"ray 1 0 0", "ray 2 0 0", "1 ray with other numbers", 8, 8},
        {"ray 1 0 0\n", "", "1 ray more in ", 8, 8},
        {"ray 1 0 0\n", "ray 1 1 0\n/a 1 2 1 0 0 -1 0 0 s s ell ell\n", "1 ray with other regions, the first is ray 1",
         8, 8},
    };
    for (const Change& change : changes) {
        CAPTURE(change.from, change.to);
        const std::string b = folder.write("b.txt", changed(partitions, change.from, change.to));
        const Result exact = run({"compare", a, b});
        CHECK(exact.status == change.status);
        INFO(exact.out);
        CHECK(contains(exact.out, change.said));
        CHECK(run({"compare", a, b, "--tolerance", "0.01"}).status == change.status_within);
    }
}

TEST_CASE("what shoot writes compares equal with itself", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string rays = folder.write("rays", "-100 0.1 0.2 1 0 0\n0.3 0 -70 0 0.1 1\n");
    const std::string out = folder / "out.txt";
    REQUIRE(run({"shoot", scene, "--rays", rays, "--reference", "-o", out}).status == 0);
    CHECK(run({"compare", out, out}).status == 0);
}

TEST_CASE("files that are neither pictures nor partitions are refused with their place") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string good = folder.write("good.txt", partitions);
    struct Wrong {
        std::string text;
        const char* said;
    };
    const Wrong files[] = {
        {"hello\n", "wrong.txt:1:1: no ray begins here"},
        {"ray one 0 0\n", "wrong.txt:1:5: 'one' is not a whole number"},
        {"ray 0 1 0\n", "ends in the middle of a ray"},
        {"ray 0 1 0\n/a 1 2 1 0 0 -1 0 0 s s ell\n", "wrong.txt:2:25: too few words"},
        {"ray 0 1 0\n/a 1 2 1 0 0 -1 0 0 s s ell ell more\n", "wrong.txt:2:33: too many words"},
        {"ray 0 1 0\n/a 1 far 1 0 0 -1 0 0 s s ell ell\n", "wrong.txt:2:6: 'far' is not a number"},
        {"ray 0 0 1\nunderlap 1 2 /a\n", "wrong.txt:2:1: no overlap"},
        {"\x1f\x8b\x08", "wrong.txt: is compressed"},
        {"\x89PNG\r\n", "compare .exr files"},
        {"\x76\x2f\x31\x01", "is no EXR picture, but the other file is one"},
    };
    for (const Wrong& wrong : files) {
        check_run({"compare", good, folder.write("wrong.txt", wrong.text)}, 6, wrong.said);
    }
    check_run({"compare", good, folder / "absent.txt"}, 6, "absent.txt: cannot read");
}

#ifdef CSGRT_HAVE_IMAGE

TEST_CASE("pictures are compared channel by channel", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    csgrt::Image image;
    image.width = 4;
    image.height = 3;
    image.names = {"R", "G", "B", "Z"};
    image.channels = csgrt::Channels(12, std::vector<float>(4, 0.5f));
    const std::string a = folder / "a.exr", b = folder / "b.exr";
    csgrt::write_image(image, a);
    csgrt::write_image(image, b);
    const Result equal = run({"compare", a, b});
    CHECK(equal.status == 0);
    CHECK(equal.out == "equal: 4 channels of 4x3 pixels\n");

    csgrt::Image other = image;
    other.channels[1][6] = 0.75f;  // x 2 y 1
    other.channels[1][7] = 0.5625f;
    csgrt::write_image(other, b);
    const Result differs = run({"compare", a, b});
    INFO(differs.out);
    CHECK(differs.status == 8);
    CHECK(contains(differs.out, "R           equal"));
    CHECK(contains(differs.out, "G           2 pixels (16.7 %) differ, by at most 0.25 at x 2 y 1: 0.5 and 0.75"));
    CHECK(run({"compare", a, b, "--tolerance", "0.25"}).status == 0);
    CHECK(run({"compare", a, b, "--tolerance", "0.2"}).status == 8);

    other = image;
    other.channels[3][0] = std::numeric_limits<float>::infinity();
    csgrt::write_image(other, b);
    CHECK(run({"compare", b, b}).status == 0);
    const Result infinite = run({"compare", a, b, "--tolerance", "1e30"});
    CHECK(infinite.status == 8);
    CHECK(contains(infinite.out, "by at most inf at x 0 y 0"));

    other = image;
    other.channels[0][0] = 0.0f;
    csgrt::write_image(other, a);
    other.channels[0][0] = -0.0f;
    csgrt::write_image(other, b);
    CHECK(run({"compare", a, b}).status == 8);
    CHECK(run({"compare", a, b, "--tolerance", "0"}).status == 0);
}

TEST_CASE("pictures of other size or channels differ", "[promise:command]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string a = folder / "a.exr", b = folder / "b.exr";
    REQUIRE(run({scene, "--reference", "--size", "16", "-o", a}).status == 0);
    REQUIRE(run({scene, "--reference", "--size", "16x8", "-o", b}).status == 0);
    const Result size = run({"compare", a, b});
    CHECK(size.status == 8);
    CHECK(contains(size.out, "sizes differ"));

    csgrt::Image image = csgrt::read_image(a);
    image.names.pop_back();
    std::vector<std::vector<float>> channels;
    for (std::size_t c = 0; c < image.names.size(); ++c)
        channels.emplace_back(image.channels[c].begin(), image.channels[c].end());
    image.channels = channels;
    csgrt::write_image(image, b);
    const Result fewer = run({"compare", a, b});
    CHECK(fewer.status == 8);
    CHECK(contains(fewer.out, "channel overlap: only in " + a));

    check_run({"compare", a, scene}, 6, "balls.asc: is no EXR picture");
    const std::string whole = read_file(a);
    check_run({"compare", a, folder.write("torn.exr", whole.substr(0, whole.size() / 2))}, 6, "torn.exr");
}

#endif
