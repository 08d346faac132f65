// Solids of BRL-CAD's three forms of a database, in one table: every number of each type in its place.
#include <set>

#include "formats/brlcad/brlcad_asc_text.hpp"
#include "formats/brlcad/g/brlcad_g_nmg.hpp"
#include "formats/brlcad/g/brlcad_g_writer.hpp"
#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/json/write/writer.hpp"
#include "formats/same_scene.hpp"
#include "scene/make_scene.hpp"

using namespace csgrt;
using namespace csgrt::g_test;
using asc_test::shape;

namespace {

const std::string v4_head = "I 1 v4\ntitle\n", v5_head = "title {T}\nunits m\n";  // numbers are millimetres, always

std::string words(std::initializer_list<std::uint64_t> values) {
    std::string out;
    for (const std::uint64_t value : values) out += number(value, 2);
    return out;
}

/// A binary database's object of a type.
struct Body {
    int type = -1;  ///< none if it is negative
    std::string bytes{};
    std::string others{};  ///< objects that it needs

    std::string object(const std::string& name = "s") const {
        return WrittenObject{.minor = type, .name = name, .body = bytes, .width = 2}.bytes();
    }
};

Scene parse_g(const std::string& objects) { return parse_brlcad_g(ByteSource("model.g", header + objects)); }

/// What each form has of the solid "s"; nothing if it is empty.
struct Written {
    Shape shape;
    std::string v4{}, v5{};
    Body g{};
};

/// 1, 2, 3, ...
std::vector<double> counted(int count) {
    std::vector<double> numbers;
    for (int i = 1; i <= count; ++i) numbers.push_back(i);
    return numbers;
}

/// `numbers` are those of a record S of the type `v4`, unless that is 0, and of the binary type `g`; `v5` is what
/// follows the name.
Written plain(Shape shape, int v4, const std::string& v5, int g, const std::vector<double>& numbers) {
    std::string record = "S " + std::to_string(v4) + " s 0";
    for (std::size_t i = 0; i < 24; ++i) record += " " + std::to_string(i < numbers.size() ? numbers[i] : 0);
    return {std::move(shape), v4 > 0 ? record + "\n" : "", v5.empty() ? "" : "put {s} " + v5, {g, reals(numbers)}};
}

Sketch square_of_curves(std::vector<std::uint8_t> reversed) {
    return {"sk",
            {{0, 0}, {2, 0}, {2, 2}, {0, 2.5}},
            {Sketch::Line{0, 1}, Sketch::Arc{1, 2, 1.5, true, false}, Sketch::Arc{2, 1, -1, false, true},
             Sketch::Bezier{{1, 2, 3}}, Sketch::Nurb{3, {0, 0, 0, 1, 2, 2, 2}, {0, 1, 2, 3}, {}},
             Sketch::Nurb{2, {0, 0, 1, 1}, {2, 3}, {1, .5}}},
            std::move(reversed)};
}
const std::string v4_curves =
    "d sk 0 0 0 1 0 0 0 1 0 4 6\n 0 0 2 0 2 2 0 2.5\n  L 0 0 1\n  A 1 1 2 1.5 1 0\n  A 0 2 1 -1 0 1\n  B 0 2\n   1 2 "
    "3\n"
    "  N 0 3 10 7 4\n   0 0 0 1 2 2 2\n   0 1 2 3\n  N 0 2 11 4 2\n   0 0 1 1\n   2 3\n   1 .5\n";
const std::string v5_curves =
    "\nput {sk} sketch V {0 0 0} A {1 0 0} B {0 1 0} VL { {0 0} {2 0} {2 2} {0 2.5} } SL { { line S 0 E 1 }"
    " { carc S 1 E 2 R 1.5 L 1 O 0 } { carc S 2 E 1 R -1 L 0 O 1 } { bezier D 2 P {1 2 3} }"
    " { nurb O 3 T 10 K {0 0 0 1 2 2 2} P {0 1 2 3} } { nurb O 2 T 11 K {0 0 1 1} P {2 3} W {1 .5} } }";
const Body g_curves = {26, counted_reals(0, 9) + words({4, 6}) + reals({0, 0, 2, 0, 2, 2, 0, 2.5}) + "lseg" +
                               words({0, 1}) + "carc" + words({1, 2, 0, 1}) + reals({1.5}) + "carc" +
                               words({2, 1, 1, 0}) + reals({-1}) + "bezi" + words({2, 1, 2, 3}) + "nurb" +
                               words({3, 10, 7}) + reals({0, 0, 0, 1, 2, 2, 2}) + words({4, 0, 1, 2, 3}) + "nurb" +
                               words({2, 11, 4}) + reals({0, 0, 1, 1}) + words({2, 2, 3}) + reals({1, .5}) +
                               words({0, 1, 0, 0, 0, 0})};

const Tgc cone{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, {13, 14, 15}, {16, 17, 18}};
const Hyp hyp{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10, .25};
const Metaball balls{Metaball::Method::blob, 1.5, {{{1, 2, 3}, 4, 5}, {{6, 7, 8}, 9, 10}}};
const Arbn slab{{{{0, 0, 1}, 5}, {{0, 0, -1}, 5}}};
const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 2}};
const std::string v4_corners = "\t0: 0 0 0\n\t1: 1 0 0\n\t2: 0 1 2\n", v5_corners = " V { {0 0 0} {1 0 0} {0 1 2} }",
                  g_corners = reals({0, 0, 0, 1, 0, 0, 0, 1, 2});
const Matrix placed = {1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 2, 7, 0, 0, 0, 1};
const std::string matrix = " {1 0 0 5 0 1 0 6 0 0 2 7 0 0 0 1}", struct_matrix = "=1,0,0,5,0,1,0,6,0,0,2,7,0,0,0,1";
const std::string g_cells = WrittenObject{.major = 9, .minor = 4, .name = "b", .body = "\1\2\3\4\5\6"}.bytes();

std::vector<Written> all_written() {
    // A normal that is no unit vector is made one, and the plane stays where it is; so are the directions of the axes.
    std::vector<Written> out = {
        plain(Tor{{1, 2, 3}, {0, 0, 1}, 5, 2}, 16, "", -1, {1, 2, 3, 0, 0, 2, 3, 4, 0, 9}),
        plain(Tor{{1, 2, 3}, {4, 5, 6}, 7, 2.5}, 0, "tor V {1 2 3} H {4 5 6} r_a 7 r_h 2.5", 1,
              {1, 2, 3, 4, 5, 6, 7, 2.5}),
        plain(Ell{{1, 2, 3}, {4, 0, 0}, {0, 5, 0}, {0, 0, 6}}, 19, "ell V {1 2 3} A {4 0 0} B {0 5 0} C {0 0 6}", 3,
              {1, 2, 3, 4, 0, 0, 0, 5, 0, 0, 0, 6}),
        plain(Ell{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}, 0, "sph C {10 11 12} B {7 8 9} A {4 5 6} V {1 2 3}",
              10, counted(12)),
        plain(Half{{{0, -1, 0}, 4}}, 24, "half N {0 -2 0} d 8", 6, {0, -2, 0, 8}),
        plain(Rpc{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10}, 26, "rpc V {1 2 3} H {4 5 6} B {7 8 9} r 10", 17, counted(10)),
        plain(Rhc{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10, 11}, 27, "rhc V {1 2 3} H {4 5 6} B {7 8 9} r 10 c 11", 18,
              counted(11)),
        plain(Epa{{1, 2, 3}, {4, 5, 6}, {0, .6, .8}, 7, 6}, 28, "epa V {1 2 3} H {4 5 6} A {0 3 4} r_1 7 r_2 6", 19,
              {1, 2, 3, 4, 5, 6, 0, 3, 4, 7, 6}),
        plain(Ehy{{1, 2, 3}, {4, 5, 6}, {0, .6, .8}, 7, 8, 9}, 29, "ehy V {1 2 3} H {4 5 6} A {0 3 4} r_1 7 r_2 8 c 9",
              20, {1, 2, 3, 4, 5, 6, 0, 3, 4, 7, 8, 9}),
        plain(Eto{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10, 11}, 30, "eto V {1 2 3} N {4 5 6} C {7 8 9} r 10 r_d 11", 21,
              counted(11)),
        plain(Superell{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, .5, 2}, 32,
              "superell V {1 2 3} A {4 5 6} B {7 8 9} C {10 11 12} n .5 e 2", 35,
              {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, .5, 2}),
        plain(hyp, 33, "hyp V {1 2 3} H {4 5 6} A {7 8 9} b 10 bnr .25", 38, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, .25}),
        plain(Hrt{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, 13}, 0,
              "hrt V {1 2 3} X {4 5 6} Y {7 8 9} Z {10 11 12} d 13", 43, counted(13)),
        {.shape = Part{{1, 2, 3}, {0, 0, 4}, 5, 6},
         .v4 = "p s 1 2 3 0 0 4 5 6\n",
         .v5 = "put {s} part V {1 2 3} H {0 0 4} r_v 5 r_h 6",
         .g = {16, reals({1, 2, 3, 0, 0, 4, 5, 6})}},
        {.shape = Cline{{1, 2, 3}, {0, 0, 4}, 5, 1},
         .v4 = "c s 1 2 3 0 0 4 5 1\n",
         .v5 = "put {s} cline V {1 2 3} H {0 0 4} R 5 T 1",
         .g = {29, reals({1, 5, 1, 2, 3, 0, 0, 4})}},
        {.shape = slab,
         .v4 = "n s 2\nn 0 0 1 5\nn 0 0 -4 20\n",
         .v5 = "put {s} arbn N 2 P0 {0 0 1 5} P1 {0 0 -4 20}",
         .g = {14, words({2}) + reals({0, 0, 1, 5, 0, 0, -4, 20})}},
        {.shape = balls,
         .v5 = "put {s} metaball method 2 thresh 1.5 PL { {1 2 3 4 5} {6 7 8 9 10} }",
         .g = {36, words({2, 2}) + reals({1.5}) + counted_reals(1, 10)}},
        {.shape = Metaball{Metaball::Method::isopotential, 1, {}},
         .v5 = "put {s} metaball method 1 thresh 1 PL {}",
         .g = {36, words({0, 1}) + reals({1})}},
        {.shape = Metaball{Metaball::Method::metaball, 1, {}},
         .v5 = "put {s} metaball method 0 thresh 1 PL {}",
         .g = {36, words({0, 0}) + reals({1})}},
        {.shape = Pipe{{{{1, 2, 3}, 8, 9, 10}, {{4, 5, 6}, 7, 2, 11}}},
         .v4 = "w s\n9 8 10 1 2 3\n2 7 11 4 5 6\nEND_PIPE s\n",
         .v5 = "put {s} pipe V0 { 1 2 3 } O0 8 I0 9 R0 10 V1 {4 5 6} O1 7 I1 2 R1 11",
         .g = {15, words({2}) + reals({1, 2, 3, 9, 8, 10, 4, 5, 6, 2, 7, 11})}},
        {.shape = Bot{.orientation = Bot::Orientation::clockwise, .vertices = corners, .faces = {{0, 2, 1}}},
         .v4 = "t s 2 3 0 3 1\n" + v4_corners + "\t0: 0 2 1\n",
         .v5 = "put {s} bot mode volume orient lh flags {use_floats}" + v5_corners + " F { {0 2 1} }",
         .g = {30, words({3, 1}) + "\3\2" + zero + g_corners + words({0, 2, 1})}},
        // A bit a face, the bit of face 0 last in a number of version 5.
        {.shape = Bot{Bot::Mode::plate,
                      Bot::Orientation::counterclockwise,
                      corners,
                      {{0, 1, 2}, {2, 1, 0}},
                      {5, 6},
                      {0, 1},
                      {},
                      {}},
         .v4 = "t s 3 2 0 3 2\n" + v4_corners + "\t0: 0 1 2 5\n\t1: 2 1 0 6\n\t02\n",
         .v5 = "put {s} bot mode plate orient rh flags {}" + v5_corners +
               " F { {0 1 2} {2 1 0} } T {5 6} fm 0000000000000002",
         .g = {30,
               words({3, 2}) + "\2\3" + zero + g_corners + words({0, 1, 2, 2, 1, 0}) + reals({5, 6}) + "02" + zero}},
        {.shape = Bot{Bot::Mode::plate_nocos, Bot::Orientation::unoriented, corners, {{0, 1, 2}}, {4}, {0}, {}, {}},
         .v5 = "put {s} bot mode plate_nocos orient no" + v5_corners + " F { {0 1 2} } T 4",
         .g = {30, words({3, 1}) + "\1\4" + zero + g_corners + words({0, 1, 2}) + reals({4}) + "00" + zero}},
        {.shape = Bot{Bot::Mode::surface,
                      Bot::Orientation::unoriented,
                      corners,
                      {{0, 1, 2}},
                      {},
                      {},
                      {{0, 0, 1}, {0, 1, 0}},
                      {{1, 0, 1}}},
         .v5 = "put {s} bot mode surf orient no flags {has_normals}" + v5_corners +
               " F { {0 1 2} } N { {0 0 1} {0 1 0} } fn { {1 0 1} }",
         .g = {30, words({3, 1}) + "\1\1\1" + g_corners + words({0, 1, 2}) + words({2, 1}) + reals({0, 0, 1, 0, 1, 0}) +
                       words({1, 0, 1})}},
        {.shape = Nmg{{{0, 0, 0}, {1, 0, 0}, {0, 1, 2}}, {{{0, 2, 1}}, {{0, 1, 2}, {1, 2, 0}}}},
         .v5 = "put {s} nmg" + v5_corners + " F {{0 2 1}} F {{0 1 2} {1 2 0}}"},
        {.shape =
             Nmg{{{0, 0, 0}, {0, 10, 0}, {10, 0, 0}, {0, 0, 10}}, {{{0, 1, 2}}, {{0, 2, 3}}, {{2, 1, 3}}, {{1, 0, 3}}}},
         .g = {11, tetrahedron_nmg()}},
        {.shape = Extrude{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, square_of_curves({0, 1, 0, 0, 0, 0})},
         .v4 = "e s sk 0 1 2 3 4 5 6 7 8 9 10 11 12\n" + v4_curves,
         .g = {27, counted_reals(1, 12) + words({0}) + "sk" + zero, g_curves.object("sk")}},
        {.shape = Extrude{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}, square_of_curves({0, 0, 0, 0, 0, 0})},
         .v5 = "put {s} extrude V {1 2 3} H {4 5 6} A {7 8 9} B {10 11 12} S sk" + v5_curves},
        {.shape = Revolve{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 1.5, square_of_curves({0, 0, 0, 0, 0, 0})},
         .v5 = "put {s} revolve V {1 2 3} axis {4 5 6} R {7 8 9} ang 1.5 sk_name sk" + v5_curves},
        {.shape = Revolve{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10, square_of_curves({0, 1, 0, 0, 0, 0})},
         .g = {40, counted_reals(1, 10) + "sk" + zero, g_curves.object("sk")}},
        {.shape = Dsp{"n", 2, 2, true, Dsp::Cut::upper_left, placed, {0x102, 4, 0x506, 0x708}},
         .v5 =
             "put {n} binunif T 5 D {\n0102\n0004 05060708}\nput {s} dsp file n src o w 2 n 2 sm 1 cut L stom" + matrix,
         .g = {25, words({2, 2}) + reals({placed.begin(), placed.end()}) + number(1, 1) + "oLn" + zero,
               WrittenObject{.major = 9, .minor = 5, .name = "n", .body = "\1\2" + zero + "\4\5\6\7\10"}.bytes()}},
        {.shape = Ebm{"b", 2, 3, 4, placed, {1, 2, 3, 4, 5, 6}},
         .v5 = "put {b} binunif T 4 D {010203040506}\nput {s} ebm name b src o W 2 N 3 H 4 M" + matrix,
         .g = {12, "file=\"b\" src=\"o\" w=2 n=3 d=4 mat" + struct_matrix + zero, g_cells}},
        // BRL-CAD cuts off the last number of a long text.
        {.shape = Vol{"b", 1, 2, 3, 1, 9, {1, 2, 3}, placed, {1, 2, 3, 4, 5, 6}},
         .v5 = "put {b} binunif T 4 D {010203040506}\nput {s} vol name b src o w 1 n 2 d 3 lo 1 hi 9 size {1 2 3} mat" +
               matrix,
         .g = {13,
               "file=b src=o w=1 n=2 d=3 lo=1 hi=9 size=1,2,3 mat" + struct_matrix.substr(0, struct_matrix.size() - 1) +
                   zero,
               g_cells}},
    };
    std::string tgc = " V {1 2 3} H {4 5 6} A {7 8 9} B {10 11 12} C {13 14 15} D {16 17 18}", arb8 = "arb8";
    Arb relative, arb;
    relative.vertices[0] = {1, 2, 3};  // the others of version 4 stand relative to it
    for (std::size_t i = 0; i < 8; ++i) {
        const auto at = static_cast<double>(3 * i);
        if (i > 0) relative.vertices[i] = {at + 2, at + 4, at + 6};
        arb.vertices[i] = {at + 1, at + 2, at + 3};
        arb8 += " V" + std::to_string(i + 1) + " {" + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2) +
                " " + std::to_string(3 * i + 3) + "}";
    }
    out.push_back(plain(relative, 20, "", -1, counted(24)));
    out.push_back(plain(arb, 0, arb8, 4, counted(24)));
    out.push_back(plain(cone, 18, "tgc" + tgc, 2, counted(18)));
    out.push_back(plain(cone, 0, "rec" + tgc, 7, counted(18)));
    // Points of version 4 stand relative to the first of all.
    out.push_back({Ars{{{{1, 2, 3}, {1, 2, 4}, {2, 2, 3}}, {{1, 2, 8}, {1, 2, 9}, {1, 2, 10}}}},
                   "A 21 s 2 3 1 2 0 0 0 0 0 0\nB 22 0 1 1 2 3 0 0 1 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
                   "B 22 1 1 0 0 5 0 0 6 0 0 7 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n",
                   "put {s} ars NC 2 PPC 3 C0 { { 1 2 3 } { 1 2 4 } { 2 2 3 } } C1 { {1 2 8} {1 2 9} {1 2 10} }",
                   {5, words({2, 3}) + reals({1, 2, 3, 1, 2, 4, 2, 2, 3, 1, 2, 8, 1, 2, 9, 1, 2, 10})}});
    // BRL-CAD writes eight bytes too many, and never sets them.
    out.push_back({hyp, "", "", {38, reals({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, .25}) + std::string(8, '\xFF')}});
    return out;
}

}  // namespace

TEST_CASE("brlcad solids: every number of each type, in every form that has it", "[asc][g]") {
    std::set<std::size_t> v4, v5, g;
    const auto check = [](const Scene& scene, const Written& written) {
        CHECK(scene.objects.size() == 1);
        REQUIRE(scene.find("s") != nullptr);
        const Object &found = *scene.find("s"), expected = solid("s", written.shape);
        INFO(json_scene_text(make_scene({found})) << "should be\n" << json_scene_text(make_scene({expected})));
        CHECK(same_shape(std::get<Solid>(found).shape, written.shape));
    };
    for (const Written& written : all_written()) {
        INFO(type_name(written.shape) << "\n" << written.v4 << written.v5);
        if (!written.v4.empty())
            check(asc_test::parse(v4_head + written.v4), written), v4.insert(written.shape.index());
        if (!written.v5.empty()) {
            check(asc_test::parse(v5_head + written.v5 + "\n"), written), v5.insert(written.shape.index());
        }
        if (written.g.type >= 0) {
            check(parse_g(written.g.object() + written.g.others), written), g.insert(written.shape.index());
        }
    }
    const std::size_t types = std::variant_size_v<Shape::variant> - 1;  // without Unsupported
    CHECK(v5.size() == types);
    CHECK(g.size() == types);
    CHECK(v4.size() == types - 7);  // hrt, metaball, revolve; nmg, ebm, vol and dsp elsewhere
}

TEST_CASE("brlcad solids: what is not there, or not for csgrt, is said", "[asc][g]") {
    const auto is_lost = [](const Scene& scene, const std::string& name, const std::string& type, const char* reason) {
        const auto& lost = shape<Unsupported>(scene, name);
        INFO(lost.reason);
        CHECK(lost.type == type);
        CHECK(lost.reason.find(reason) != std::string::npos);
    };
    is_lost(asc_test::parse(v4_head + "t s 4 1 0 3 1\n" + v4_corners + "\t0: 0 1 2\n"), "s", "bot", "thickness");
    // A face of a spline: curved.
    std::string curved = tetrahedron_nmg() + std::string(52, '\0');
    curved[4 + 8 * 4 + 3] = 1;
    is_lost(parse_g(Body{11, curved}.object()), "s", "nmg", "it has curved faces");
    is_lost(parse_g(Body{27, counted_reals(1, 12) + words({0}) + "none" + zero}.object()), "s", "extrude", "'none'");
    const std::string dsp = words({2, 2}) + counted_reals(1, 16) + number(1, 1) + "oL";
    is_lost(parse_g(Body{25, dsp + "b" + zero}.object() + g_cells), "s", "dsp", "16 bits");
    is_lost(parse_g(Body{25, dsp + "x" + zero}.object() + g_cells), "s", "dsp", "not in the model");
}

TEST_CASE("brlcad solids: any end of a binary body, and any byte in it, gives a solid or findings", "[g][broken]") {
    std::vector<Body> bodies = {g_curves};
    for (const Written& written : all_written())
        if (written.g.type >= 0) bodies.push_back(written.g);
    for (const Body& body : bodies) {
        const auto parse = [&](const std::string& changed) { parse_g(Body{body.type, changed}.object()); };
        const asc_test::Attempts attempts =
            asc_test::changed(body.bytes, std::string("\0\1\2\7\x7F\x80\xFF", 7), parse);
        INFO(body.type);
        CHECK(attempts.read > 0);
        CHECK(attempts.refused > body.bytes.size() / 2);
    }
}
