// csgrt sample: the regions of points and of planes are those of the library.
#include <algorithm>
#include <cstring>

#include <csgrt/csgrt.hpp>

#include "cli/command.hpp"

using namespace command_test;

namespace {

/// The numbers of an .npy file, whose shape is that text.
std::vector<std::int32_t> numbers_in(const std::string& npy, const std::string& shape) {
    const std::size_t header = npy.find('\n') + 1;
    REQUIRE(header % 64 == 0);
    CHECK(contains(npy.substr(0, header), "{'descr': '<i4', 'fortran_order': False, 'shape': (" + shape + "), }"));
    std::vector<std::int32_t> numbers((npy.size() - header) / 4);
    std::memcpy(numbers.data(), npy.data() + header, npy.size() - header);
    return numbers;
}

template <class Numbers>
std::vector<std::int32_t> list_of(const Numbers& numbers) {
    return {numbers.begin(), numbers.end()};
}

}  // namespace

TEST_CASE("sample tells the region of each point", "[promise:command][promise:lists]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string points = folder.write("points", "# x y z\n0 0 0\n-5 0 0.25\n\n8 0 0  # both\n20 0 0\n99 0 0\n");
    const Result csv = run({"sample", scene, "all.g", "--points", points, "--reference"});
    REQUIRE(csv.status == 0);
    CHECK(csv.out ==
          "x,y,z,region_id,path\n0,0,0,-1,\n-5,0,0.25,0,/all.g/left.r\n8,0,0,0,/all.g/left.r\n"
          "20,0,0,1,/all.g/right.r\n99,0,0,-1,\n");
    const std::string npy = folder / "ids.npy";
    REQUIRE(run({"sample", scene, "all.g", "--points", "-", "--reference", "-o", npy}, {.input = points}).status == 0);
    const csgrt::Model model(csgrt::load_scene(scene), {"all.g"});
    csgrt::Array<std::int32_t> ids;
    model.region_at(std::vector<csgrt::Vec3>{{0, 0, 0}, {-5, 0, 0.25}, {8, 0, 0}, {20, 0, 0}, {99, 0, 0}}, ids);
    CHECK(numbers_in(read_file(npy), "5, ") == list_of(ids));
}

TEST_CASE("lines that are no points are told with their place") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string points = folder.write("points", "0 0\n1 2 three\n1 2 3 4\n2e18 0 0\n");
    const Result result = run({"sample", scene, "--points", points, "--reference"});
    CHECK(result.status == 6);
    for (const char* part : {"points:1:4: z is missing", "points:2:5: z: 'three' is not a number",
                             "points:3:7: more than three numbers", "points:4:1: it has the coordinate 2e+18"})
        CHECK(contains(result.err, part));
}

TEST_CASE("sample shows a plane of the model", "[promise:command][promise:lists]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const csgrt::Model model(csgrt::load_scene(scene), {"all.g"});
    csgrt::Array<std::int32_t> ids;
    model.slice(csgrt::slice_of(model.bounds(), {0, 0, 1}, 1.5, 14, 9), ids);
    CHECK(std::count(ids.begin(), ids.end(), -2) > 0);
    const auto sample = [&](const std::string& plane, const std::string& name) {
        const Result result =
            run({"sample", scene, "all.g", "--plane", plane, "--size", "14x9", "--reference", "-o", folder / name});
        INFO(result.err);
        CHECK(result.status == 0);
        return read_file(folder / name);
    };
    CHECK(numbers_in(sample("z:1.5", "ids.npy"), "9, 14, ") == list_of(ids));
    CHECK(sample("0,0,2:1.5", "other.npy") == sample("z:1.5", "ids.npy"));
    std::string expected = "column,row,region_id,path\n";
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (ids[i] != -1)
            expected += std::to_string(i % 14) + ',' + std::to_string(i / 14) + ',' + std::to_string(ids[i]) + ',' +
                        (ids[i] < 0 ? "" : model.regions()[static_cast<std::size_t>(ids[i])].path) + '\n';
    CHECK(sample("z:1.5", "ids.csv") == expected);
#ifdef CSGRT_HAVE_IMAGE
    const std::string png = sample("z:1.5", "ids.png");
    CHECK(png.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    CHECK(png.substr(16, 8) == std::string("\0\0\0\x0e\0\0\0\x09", 8));
#endif
}

TEST_CASE("sample refuses what it cannot write") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls), points = folder.write("points", "0 0 0\n");
    const std::pair<std::vector<std::string>, const char*> mistakes[] = {
        {{}, "nothing to sample\n  name a file of points with --points"},
        {{"--points", points, "--plane", "z:0"}, "--plane: cannot be combined with --points"},
        {{"--points", points, "--size", "4"}, "--size: cannot be combined with --points"},
        {{"--plane", "0,0,0:1"}, "--plane: '0,0,0:1' is not a plane"},
        {{"--plane", "z"}, "--plane: 'z' is not a plane"},
        {{"--plane", "z:0", "-o", folder / "a.exr"}, "ends in none of .npy, .csv and .png"},
        {{"--points", points, "-o", folder / "a.png"}, "--output: points make no picture"},
        {{"--points", points, "-o", points}, "ends in none of"},
    };
    for (const auto& [more, said] : mistakes) {
        std::vector<std::string> words = {"sample", scene, "--reference"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = run(words);
        CAPTURE(said, result.err);
        CHECK(result.status == 2);
        CHECK(contains(result.err, said));
    }
}
