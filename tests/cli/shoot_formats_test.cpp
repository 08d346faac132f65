// What shoot writes for other programs, and of which rays: formats by their bytes, ranges, grids.
#include <cstring>
#include <sstream>

#include <csgrt/csgrt.hpp>

#include "cli/command.hpp"
#include "cli/text/partitions.hpp"

using namespace command_test;

namespace {

constexpr std::size_t record_bytes = 84;

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
    T number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

/// What the command writes to a file.
std::string written(const Folder& folder, std::vector<std::string> words, const std::string& format) {
    const std::string file = folder / "rows";
    words.insert(words.end(), {"--format", format, "-o", file});
    const Result result = run(words);
    INFO(result.err);
    REQUIRE(result.status == 0);
    CHECK(run({words.begin(), words.end() - 2}).out == read_file(file));  // on standard output, too
    return read_file(file);
}

}  // namespace

TEST_CASE("shoot writes CSV with nirt's columns, a line a partition", "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string rays = folder.write("rays", "0 0 500 1 0 0\n-100 0 0 2 0 0\n15 6 -20 0 0 1\n");
    const std::string head =
        "ray,reg_name,path_name,reg_id,x_in,y_in,z_in,d_in,x_out,y_out,z_out,d_out,los,scaled_los,obliq_in,obliq_out\n";
    const std::vector<std::string> words = {"shoot", scene, "all.g", "--rays", rays, "--reference"};
    std::istringstream lines(written(folder, words, "csv"));
    std::string line;
    std::getline(lines, line);
    CHECK(line + '\n' == head);
    std::getline(lines, line);
    CHECK(line == "1,left.r,/all.g/left.r,1001,-10,0,0,10,-2,0,0,2,8,8,0,0");
    std::getline(lines, line);
    CHECK(line == "1,left.r,/all.g/left.r,1001,2,0,0,-2,10,0,0,-10,8,8,0,0");
    std::getline(lines, line);
    CHECK(line == "1,right.r,/all.g/right.r,1002,10,0,0,-10,25,0,0,-25,15,15,0,0");
    std::getline(lines, line);
    CHECK(line.starts_with("2,right.r,/all.g/right.r,1002,15,6,-7.99"));
    CHECK(std::stod(line.substr(line.rfind(',') + 1)) == Approx(36.86989764584402));
    CHECK(!std::getline(lines, line));

    std::vector<std::string> cut = words;
    cut.insert(cut.end(), {"--near", "46", "--far=52", "--format", "csv"});
    CHECK(run(cut).out == head + "1,left.r,/all.g/left.r,1001,-8,0,0,8,-2,0,0,2,6,6,,0\n" +
                              "1,left.r,/all.g/left.r,1001,2,0,0,-2,4,0,0,-4,2,2,0,\n");

    const std::string odd =
        folder.write("odd.json", R"({"csgrt": 1, "solids": {"b": {"type": "sphere", "center": [0, 0, 0], "radius": 2}},
                        "combinations": {"a,\"b": {"region": true, "tree": "b"}}})");
    CHECK(contains(run({"shoot", odd, "--rays", rays, "--reference", "--format", "csv"}).out,
                   "\n1,\"a,\"\"b\",\"/a,\"\"b\","));
}

TEST_CASE("npy is a header and the records of binary") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string rays = folder.write("rays", "0 0 500 1 0 0\n-100 0 0 2 0 0\n");
    const std::vector<std::string> words = {"shoot", scene, "all.g", "--rays", rays, "--reference", "--near", "46"};
    const std::string binary = written(folder, words, "binary"), npy = written(folder, words, "npy");
    REQUIRE(binary.size() == 3 * record_bytes);
    CHECK(number_at<std::int64_t>(binary, 0) == 1);
    CHECK(number_at<std::int32_t>(binary, 8) == 0);    // the region left.r
    CHECK(number_at<std::int32_t>(binary, 12) == -1);  // its first solid: the range cuts it
    CHECK(number_at<std::int32_t>(binary, 16) >= 0);
    const double first[] = {46, 49, 0, 0, 0, 1, 0, 0};
    for (std::size_t i = 0; i < 8; ++i) CHECK(number_at<double>(binary, 20 + 8 * i) == first[i]);
    CHECK(number_at<std::int32_t>(binary, 2 * record_bytes + 8) == 1);
    CHECK(number_at<double>(binary, 2 * record_bytes + 28) == 62.5);

    REQUIRE(npy.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
    const std::size_t header = 10 + number_at<std::uint16_t>(npy, 8);
    CHECK(header % 64 == 0);
    const std::string text = npy.substr(10, header - 10);
    CHECK(text.starts_with(
        "{'descr': [('ray', '<i8'), ('region_id', '<i4'), ('in_solid', '<i4'), ('out_solid', '<i4'), ('t_in', '<f8'), "
        "('t_out', '<f8'), ('in_normal', '<f8', (3,)), ('out_normal', '<f8', (3,))], 'fortran_order': False, "
        "'shape': (3, ), }"));
    CHECK(text.back() == '\n');
    CHECK(npy.substr(header) == binary);
}

TEST_CASE("a range cuts the text's partitions and overlaps, and a cut end has no solid", "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string rays = folder.write("rays", "0 0 0 1 0 0\n");
    const std::vector<std::string> words = {"shoot", scene, "all.g", "--rays", rays, "--reference"};
    const auto lines_after = [&](std::initializer_list<std::string> more) {
        std::vector<std::string> all = words;
        all.insert(all.end(), more);
        const std::string text = run(all).out;
        return text.substr(text.find("\nray ") + 1);
    };
    CHECK(lines_after({"--near", "-5", "--far", "7"}) ==
          "ray 0 2 1\n"
          "/all.g/left.r -5 -2 0 0 0 1 -0 -0 - hole.s - arb8\n"
          "/all.g/left.r 2 7 -1 -0 -0 0 0 0 hole.s - arb8 -\n"
          "overlap 5 7 /all.g/left.r /all.g/right.r\n");
    CHECK(lines_after({"--near=-inf", "--far", "-2"}) ==
          "ray 0 1 0\n/all.g/left.r -10 -2 -1 0 0 1 -0 -0 left.s hole.s ell arb8\n");
    check_run({"shoot", scene, "--rays", rays, "--reference", "--far", "-1"}, 2,
              "--far: the range is from 0 to -1\n  --near must not be above --far");
}

TEST_CASE("a grid is the same as its rays in a file, in any format", "[promise:shoot]") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const csgrt::Model model(csgrt::load_scene(scene), {"all.g"});
    const csgrt::RayGrid grid = csgrt::rays_parallel(model.bounds(), csgrt::Axis::y, 9, 9);
    std::string list;
    for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 9; ++column) {
            const auto [o, d] = grid.ray(column, row);
            for (const double number : {o.x, o.y, o.z, d.x, d.y, d.z}) csgrt::cli::append_number(list += ' ', number);
            list += '\n';
        }
    const std::string rays = folder.write("rays", list);
    for (const char* format : {"text", "csv", "npy"}) {
        CAPTURE(format);
        const std::string of_grid =
            run({"shoot", scene, "all.g", "--rays", "grid:y:9", "--reference", "--format", format}).out;
        CHECK(of_grid.size() > 2000);
        CHECK(of_grid == run({"shoot", scene, "all.g", "--rays", rays, "--reference", "--format", format}).out);
    }
    const std::string half = folder.write(
        "half.json", R"({"csgrt": 1, "solids": {"h": {"type": "half", "normal": [0, 0, 1], "distance": 0}}})");
    check_run({"shoot", half, "--rays", "grid:z:4", "--reference"}, 2,
              "--rays: the model has no bounded region for a grid to cover");
}

TEST_CASE("the rows of more rays than a device gets at once keep their rays' numbers") {
    NEEDS_COMMAND();
    const Folder folder;
    const std::string scene = folder.write("balls.asc", two_balls);
    const std::string rows = run({"shoot", scene, "hole.s", "--rays", "grid:x:600", "--format", "binary"}).out;
    REQUIRE(rows.size() == 360'000 * record_bytes);
    std::size_t wrong = 0;
    for (std::int64_t i = 0; i < 360'000; ++i)
        wrong += number_at<std::int64_t>(rows, static_cast<std::size_t>(i) * record_bytes) != i;
    CHECK(wrong == 0);
}
