// Solids of binary databases: every number of each type in its place, and bodies that are wrong.
#include <functional>

#include "formats/brlcad/brlcad_asc_text.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/g/brlcad_g_nmg.hpp"
#include "formats/brlcad/g/brlcad_g_writer.hpp"

using namespace csgrt;
using namespace csgrt::g_test;
using asc_test::shape;

namespace {

std::string word(std::uint64_t value) { return number(value, 2); }
std::string words(std::initializer_list<std::uint64_t> values) {
    std::string out;
    for (const std::uint64_t value : values) out += word(value);
    return out;
}

Scene parse(const std::string& objects) { return parse_brlcad_g(ByteSource("model.g", header + objects)); }

std::string object(int type, const std::string& body, const std::string& name = "s") {
    return WrittenObject{.minor = type, .name = name, .body = body, .width = 2}.bytes();
}
Scene one(int type, const std::string& body) { return parse(object(type, body)); }
Scene counted(int type, int numbers) { return one(type, counted_reals(1, numbers)); }

const std::string corners = reals({0, 0, 0, 1, 0, 0, 0, 1, 0});
const std::string volume_bot = words({3, 1}) + "\2\2" + zero + corners + words({0, 1, 2});
const std::string plate_bot = words({3, 2}) + "\3\3\1" + corners + words({0, 1, 2, 2, 1, 0}) + reals({5, 6}) + "02" +
                              zero + words({1, 1}) + reals({0, 0, 1}) + words({0, 0, 0});
const std::string ars_body = words({2, 2}) + counted_reals(1, 12);
const std::string pipe_body = word(2) + counted_reals(1, 12);
const std::string metaball_body = words({2, 1}) + reals({1.5}) + counted_reals(1, 10);
const std::string sketch_body = counted_reals(0, 9) + words({3, 4}) + counted_reals(1, 6) + "lseg" + words({0, 1}) +
                                "carc" + words({1, 2, 0, 1}) + reals({7}) + "bezi" + words({2, 0, 1, 2}) + "nurb" +
                                words({2, 11, 4}) + reals({0, 0, 1, 1}) + words({2, 1, 0}) + reals({1, .5}) +
                                words({0, 1, 0, 0});
const std::string extrude_body = counted_reals(1, 12) + word(0) + "sk" + zero;
const std::string revolve_body = counted_reals(1, 10) + "sk" + zero;

}  // namespace

TEST_CASE("g: part, epa, rpc, rhc, eto, hyp, superell, hrt, cline", "[g]") {
    const Scene part_scene = counted(16, 8), epa_scene = counted(19, 11), rpc_scene = counted(17, 10);
    CHECK(shape<Part>(part_scene, "s").h == Vec3{4, 5, 6});
    CHECK(shape<Part>(part_scene, "s").r_v == 7);
    CHECK(shape<Part>(part_scene, "s").r_h == 8);
    CHECK(shape<Epa>(epa_scene, "s").h == Vec3{4, 5, 6});
    CHECK(shape<Epa>(epa_scene, "s").r_1 == 10);
    CHECK(shape<Epa>(epa_scene, "s").r_2 == 11);
    CHECK(shape<Rpc>(rpc_scene, "s").b == Vec3{7, 8, 9});
    CHECK(shape<Rpc>(rpc_scene, "s").r == 10);
    const Scene rhc_scene = counted(18, 11), eto_scene = counted(21, 11), superell_scene = counted(35, 14);
    CHECK(shape<Rhc>(rhc_scene, "s").b == Vec3{7, 8, 9});
    CHECK(shape<Rhc>(rhc_scene, "s").c == 11);
    CHECK(shape<Eto>(eto_scene, "s").n == Vec3{4, 5, 6});
    CHECK(shape<Eto>(eto_scene, "s").c == Vec3{7, 8, 9});
    CHECK(shape<Eto>(eto_scene, "s").r == 10);
    CHECK(shape<Eto>(eto_scene, "s").r_d == 11);
    CHECK(shape<Superell>(superell_scene, "s").c == Vec3{10, 11, 12});
    CHECK(shape<Superell>(superell_scene, "s").n == 13);
    CHECK(shape<Superell>(superell_scene, "s").e == 14);
    const Scene hrt_scene = counted(43, 13), cline_scene = counted(29, 8);
    CHECK(shape<Hrt>(hrt_scene, "s").z == Vec3{10, 11, 12});
    CHECK(shape<Hrt>(hrt_scene, "s").d == 13);
    CHECK(shape<Cline>(cline_scene, "s").thickness == 1);
    CHECK(shape<Cline>(cline_scene, "s").radius == 2);
    CHECK(shape<Cline>(cline_scene, "s").v == Vec3{3, 4, 5});
    CHECK(shape<Cline>(cline_scene, "s").h == Vec3{6, 7, 8});
    // BRL-CAD writes eight bytes too many, and never sets them.
    for (const std::string& more : {std::string(), std::string(8, '\xFF')}) {
        const Scene hyp_scene = one(38, counted_reals(1, 11) + more);
        CHECK(shape<Hyp>(hyp_scene, "s").a == Vec3{7, 8, 9});
        CHECK(shape<Hyp>(hyp_scene, "s").b == 10);
        CHECK(shape<Hyp>(hyp_scene, "s").neck == 11);
    }
}

TEST_CASE("g: bot, ars, pipe, metaball", "[g]") {
    const Scene volume_scene = one(30, volume_bot), plate_scene = one(30, plate_bot);
    const Bot& volume = shape<Bot>(volume_scene, "s");
    CHECK(volume.mode == Bot::Mode::volume);
    CHECK(volume.orientation == Bot::Orientation::counterclockwise);
    CHECK(volume.vertices[2] == Vec3{0, 1, 0});
    CHECK(volume.faces == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    const Bot& plate = shape<Bot>(plate_scene, "s");
    CHECK(plate.mode == Bot::Mode::plate);
    CHECK(plate.orientation == Bot::Orientation::clockwise);
    CHECK(plate.thickness == std::vector<double>{5, 6});
    CHECK(plate.append == std::vector<std::uint8_t>{0, 1});
    CHECK(plate.normals == std::vector<Vec3>{{0, 0, 1}});
    CHECK(plate.face_normals.size() == 1);

    const Scene ars_scene = one(5, ars_body);
    REQUIRE(shape<Ars>(ars_scene, "s").curves.size() == 2);
    CHECK(shape<Ars>(ars_scene, "s").curves[1][0] == Vec3{7, 8, 9});

    const Scene pipe_scene = one(15, pipe_body);
    const Pipe& pipe = shape<Pipe>(pipe_scene, "s");
    REQUIRE(pipe.points.size() == 2);
    CHECK(pipe.points[1].position == Vec3{7, 8, 9});
    CHECK(pipe.points[1].inner == 10);
    CHECK(pipe.points[1].outer == 11);
    CHECK(pipe.points[1].bend == 12);

    const Scene ball_scene = one(36, metaball_body);
    const Metaball& ball = shape<Metaball>(ball_scene, "s");
    CHECK(ball.method == Metaball::Method::isopotential);
    CHECK(ball.threshold == 1.5);
    REQUIRE(ball.points.size() == 2);
    CHECK(ball.points[1].position == Vec3{6, 7, 8});
    CHECK(ball.points[1].strength == 9);
    CHECK(ball.points[1].softness == 10);
}

TEST_CASE("g: nmg", "[g]") {
    const Scene scene = one(11, tetrahedron_nmg());
    const Nmg& nmg = shape<Nmg>(scene, "s");
    CHECK(nmg.vertices.size() == 4);
    REQUIRE(nmg.faces.size() == 4);
    for (const auto& face : nmg.faces) {
        REQUIRE(face.size() == 1);
        CHECK(face[0].size() == 3);
    }
    CHECK(nmg.vertices[nmg.faces[0][0][1]] == Vec3{0, 10, 0});
    // A face of a spline: curved.
    std::string curved = tetrahedron_nmg() + std::string(52, '\0');
    curved[4 + 8 * 4 + 3] = 1;
    CHECK(shape<Unsupported>(one(11, curved), "s").reason == "it has curved faces");
}

TEST_CASE("g: sketch, extrude, revolve", "[g]") {
    const Scene scene = parse(object(27, extrude_body) + object(26, sketch_body, "sk") + object(40, revolve_body, "r") +
                              object(27, counted_reals(1, 12) + word(0) + "none" + zero, "lost"));
    CHECK(scene.objects.size() == 3);
    const Extrude& extrude = shape<Extrude>(scene, "s");
    CHECK(extrude.h == Vec3{4, 5, 6});
    CHECK(extrude.b == Vec3{10, 11, 12});
    const Sketch& sketch = extrude.sketch;
    CHECK(sketch.name == "sk");
    REQUIRE(sketch.vertices.size() == 3);
    CHECK(sketch.vertices[2].u == 5);
    REQUIRE(sketch.curves.size() == 4);
    const auto& arc = std::get<Sketch::Arc>(sketch.curves[1]);
    CHECK(arc.start == 1);
    CHECK(arc.radius == 7);
    CHECK(arc.center_left);
    CHECK_FALSE(arc.clockwise);
    CHECK(std::get<Sketch::Bezier>(sketch.curves[2]).points.size() == 3);
    CHECK(std::get<Sketch::Nurb>(sketch.curves[3]).weights == std::vector<double>{1, .5});
    CHECK(sketch.reversed == std::vector<std::uint8_t>{0, 1, 0, 0});
    CHECK(shape<Revolve>(scene, "r").r == Vec3{7, 8, 9});
    CHECK(shape<Revolve>(scene, "r").angle == 10);
    CHECK(shape<Revolve>(scene, "r").sketch.curves.size() == 4);
    CHECK(shape<Unsupported>(scene, "lost").type == "extrude");
    CHECK(shape<Unsupported>(scene, "lost").reason.find("'none'") != std::string::npos);
}

TEST_CASE("g: cells in objects", "[g]") {
    const auto numbers = [](int type, const std::string& data, const std::string& name) {
        return WrittenObject{.major = 9, .minor = type, .name = name, .body = data}.bytes();
    };
    const std::string dsp =
        words({2, 2}) + reals({1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 2, 7, 0, 0, 0, 1}) + number(1, 1) + "oL";
    const Scene scene = parse(
        object(12, "file=\"b\" src=\"o\" w=2 n=3 d=4 mat=1,0,0,5,0,1,0,6,0,0,1,7,0,0,0,1" + zero, "e") +
        object(13, "file=b src=o w=1 n=2 d=3 lo=1 hi=9 size=1,2,3 mat=1,0,0,5,0,1,0,6,0,0,1,7,0,0,0," + zero, "v") +
        object(25, dsp + "h" + zero, "d") + object(25, dsp + "b" + zero, "wrong") +
        object(25, dsp + "x" + zero, "none") + numbers(4, "\1\2\3\4\5\6", "b") +
        numbers(5, "\1\2" + zero + "\4\5\6\7\10", "h"));
    CHECK(scene.objects.size() == 5);
    const Ebm& ebm = shape<Ebm>(scene, "e");
    CHECK(ebm.width == 2);
    CHECK(ebm.depth == 3);
    CHECK(ebm.height == 4);
    CHECK(ebm.matrix[7] == 6);
    CHECK(ebm.cells == std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6});
    const Vol& vol = shape<Vol>(scene, "v");
    CHECK(vol.height == 3);
    CHECK(vol.low == 1);
    CHECK(vol.high == 9);
    CHECK(vol.cell == Vec3{1, 2, 3});
    CHECK(vol.matrix[11] == 7);  // and the last number, which BRL-CAD cut off
    CHECK(vol.matrix[15] == 1);
    CHECK(vol.cells.size() == 6);
    const Dsp& heights = shape<Dsp>(scene, "d");
    CHECK(heights.heights == std::vector<std::uint16_t>{0x102, 4, 0x506, 0x708});
    CHECK(heights.smooth);
    CHECK(heights.cut == Dsp::Cut::upper_left);
    CHECK(heights.matrix[10] == 2);
    CHECK(shape<Unsupported>(scene, "wrong").reason.find("16 bits") != std::string::npos);
    CHECK(shape<Unsupported>(scene, "none").reason.find("not in the model") != std::string::npos);
}

TEST_CASE("g: any end of a solid's body, and any byte in it, gives a solid or findings", "[g][broken]") {
    const std::pair<int, std::string> bodies[] = {
        {30, volume_bot},
        {30, plate_bot},
        {5, ars_body},
        {15, pipe_body},
        {36, metaball_body},
        {26, sketch_body},
        {27, extrude_body},
        {40, revolve_body},
        {11, tetrahedron_nmg()},
        {12, "file=\"b\" src=\"o\" w=2 n=3 d=4 mat=1,0,0,5,0,1,0,6,0,0,1,7,0,0,0,1" + zero},
        {25, words({2, 2}) + counted_reals(1, 16) + number(1, 1) + "fab" + zero},
    };
    for (const auto& [type, body] : bodies) {
        std::size_t read = 0, refused = 0;
        const auto attempt = [&, type = type](const std::string& changed) {
            try {
                one(type, changed);
                ++read;
            } catch (const Error& error) {
                ++refused;
                if (error.status() != Status::scene) FAIL("a broken database is an error of the scene");
            }
        };
        for (std::size_t length = 1; length < body.size(); ++length) attempt(body.substr(0, length));
        for (std::size_t i = 0; i < body.size(); ++i) {
            for (const int value : {0x00, 0x01, 0x02, 0x07, 0x7F, 0x80, 0xFF}) {
                std::string changed = body;
                changed[i] = static_cast<char>(value);
                attempt(changed);
            }
        }
        INFO(type);
        CHECK(read > 0);
        CHECK(refused > body.size() / 2);
    }
}
