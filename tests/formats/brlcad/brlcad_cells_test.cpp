// Cells of ebm, vol and dsp in files beside the model: found, and what is said when they are not.
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "folder.hpp"
#include "formats/brlcad/brlcad_asc_text.hpp"
#include "formats/brlcad/g/reader.hpp"

using namespace csgrt;
using asc_test::shape;
using test::Folder;

namespace {

namespace fs = std::filesystem;

const std::string unit = "{1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}";

std::string dsp(const std::string& name, const std::string& file) {
    return "put {" + name + "} dsp file {" + file + "} src f w 2 n 2 sm 0 cut l stom " + unit + "\n";
}

}  // namespace

TEST_CASE("cells: files beside the model", "[asc][promise:databases]") {
    const Folder folder;
    folder.write("heights.bin", std::string("\0\1\0\2\1\0\377\377", 8));
    folder.write("cells.u8", "abcdef");
    const fs::path model = folder.write(
        "model.asc", "title {}\nunits mm\n" + dsp("d", "heights.bin") + "put {e} ebm F cells.u8 W 2 N 3 H 5 M " + unit +
                         "\n"
                         "put {v} vol file cells.u8 src f w 1 n 2 d 3 lo 98 hi 200 size {1 2 3} mat " +
                         unit + "\n" + dsp("absolute", (folder.path() / "heights.bin").string()));
    const Scene scene = read_brlcad_asc(model.string());
    CHECK(shape<Dsp>(scene, "d").heights == std::vector<std::uint16_t>{1, 2, 256, 65535});
    CHECK(shape<Dsp>(scene, "d").cut == Dsp::Cut::lower_left);
    CHECK(shape<Dsp>(scene, "absolute").heights.size() == 4);
    CHECK(shape<Ebm>(scene, "e").height == 5);
    CHECK(shape<Ebm>(scene, "e").cells == std::vector<std::uint8_t>{'a', 'b', 'c', 'd', 'e', 'f'});
    const Vol& vol = shape<Vol>(scene, "v");
    CHECK(vol.width == 1);
    CHECK(vol.depth == 2);
    CHECK(vol.height == 3);
    CHECK(vol.low == 98);
    CHECK(vol.high == 200);
    CHECK(vol.cell == Vec3{1, 2, 3});
    CHECK(vol.cells.size() == 6);

    const fs::path old = folder.write("old.asc",
                                      "I 1 v4\ntitle\ns dsp d file=\"heights.bin\" w=2 n=2 "
                                      "stom=3,0,0,7,0,3,0,8,0,0,3,9,0,0,0,1\ns ebm e file=cells.u8 w=3 n=2 "
                                      "d=4\ns vol v file=cells.u8 w=3 n=2 d=1 lo=7\n");
    const Scene old_scene = read_brlcad_asc(old.string());
    const Dsp& heights = shape<Dsp>(old_scene, "d");
    CHECK(heights.heights[2] == 256);
    CHECK(heights.cut == Dsp::Cut::adaptive);
    CHECK(heights.smooth);
    CHECK(heights.matrix == Matrix{3, 0, 0, 7, 0, 3, 0, 8, 0, 0, 3, 9, 0, 0, 0, 1});
    CHECK(shape<Ebm>(old_scene, "e").width == 3);
    CHECK(shape<Vol>(old_scene, "v").low == 7);
    CHECK(shape<Vol>(old_scene, "v").high == 255);
}

TEST_CASE("cells: a file that cannot be had is named when the solid is used, and not before", "[asc][broken]") {
    const Folder folder;
    folder.write("short.bin", "1234567");
    folder.write("long.bin", "123456789");
    fs::create_directory(folder.path() / "folder.bin");
    REQUIRE(mkfifo((folder.path() / "fifo.bin").c_str(), 0600) == 0);
    const std::pair<const char*, const char*> cases[] = {
        {"missing.bin", "No such file"}, {"short.bin", "has 7 bytes, not 8"}, {"long.bin", "has 9 bytes, not 8"},
        {"folder.bin", "is no file"},    {"fifo.bin", "is no file"},          {"/dev/zero", "may not name"}};
    for (const auto& [file, reason] : cases) {
        const fs::path model =
            folder.write("model.asc", "title {}\nunits mm\nput {ball} ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n" +
                                          dsp("d", file) + "put {c} comb region yes tree {u {l d} {l ball}}\n");
        INFO(file);
        const Scene scene = read_brlcad_asc(model.string());
        CHECK(validate(scene, {"ball"}).empty());
        const std::vector<Diagnostic> findings = validate(scene, {"c"});
        REQUIRE(findings.size() == 1);
        INFO(format(findings[0]));
        CHECK(findings[0].place.line == 4);
        CHECK(findings[0].message.find("'d'") != std::string::npos);
        CHECK(findings[0].message.find(file) != std::string::npos);
        CHECK(findings[0].message.find(reason) != std::string::npos);
        CHECK(findings[0].message.find("used by 'c'") != std::string::npos);
    }
}

TEST_CASE("cells: sizes that no file has are refused without room made for them", "[asc][broken]") {
    const std::string most = "2147483647";
    const Scene scene = asc_test::parse("title {}\nput {v} vol file a src f w " + most + " n " + most + " d " + most +
                                        " lo 0 hi 9 size {1 1 1} mat " + unit + "\n");
    CHECK(shape<Unsupported>(scene, "v").reason.find("256 MiB") != std::string::npos);
}

TEST_CASE("cells: numbers in an object of a text database", "[asc]") {
    const Scene scene = asc_test::parse(
        "title {}\nput {n} binunif T 5 D {\n0001\n0002 ffff0100}\n"
        "put {d} dsp file n src o w 2 n 2 sm 0 cut a stom " +
        unit +
        "\n"
        "put {x} dsp file y src o w 2 n 2 sm 0 cut a stom " +
        unit +
        "\n"
        "put {y} ell V {0 0 0} A {1 0 0} B {0 1 0} C {0 0 1}\n");
    CHECK(shape<Dsp>(scene, "d").heights == std::vector<std::uint16_t>{1, 2, 0xffff, 0x100});
    CHECK(shape<Unsupported>(scene, "x").reason.find("holds no numbers") != std::string::npos);
}

TEST_CASE("cells: what solids take together is bounded", "[asc][broken]") {
    // One sketch of 1 MiB in 260 extrudes.
    std::string text = "title {}\nput {sk} sketch V {0 0 0} A {1 0 0} B {0 1 0} VL {";
    for (int i = 0; i < 65536; ++i) text += " {0 0}";
    text += " } SL {}\n";
    for (int i = 0; i < 260; ++i) {
        text += "put {e" + std::to_string(i) + "} extrude V {0 0 0} H {0 0 1} A {1 0 0} B {0 1 0} S sk\n";
    }
    const Scene scene = asc_test::parse(text);
    CHECK(shape<Extrude>(scene, "e0").sketch.vertices.size() == 65536);
    CHECK(shape<Unsupported>(scene, "e259").reason.find("256 MiB") != std::string::npos);
}
