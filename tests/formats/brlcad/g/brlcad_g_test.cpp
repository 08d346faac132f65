// Binary databases that the tests write themselves: objects of every kind, every type, every width.
#include <map>

#include "formats/brlcad/brlcad_asc_text.hpp"
#include "formats/brlcad/g/reader.hpp"
#include "formats/brlcad/g/bytes.hpp"
#include "formats/brlcad/g/brlcad_g_writer.hpp"

using namespace csgrt;
using namespace csgrt::g_test;
using asc_test::comb;
using asc_test::unsupported_type;
using asc_test::written;

namespace {

Scene parse(const std::string& objects) { return parse_brlcad_g(ByteSource("model.g", header + objects)); }

std::string tree_of(const Members& members) { return written(comb(parse(combination("c", members)), "c").tree); }

}  // namespace

TEST_CASE("g: a header alone is an empty scene", "[g]") {
    const Scene scene = parse("");
    CHECK(scene.objects.empty());
    CHECK(scene.units == "mm");
}

TEST_CASE("g: solids that csgrt does not know keep BRL-CAD's names", "[g]") {
    const std::map<int, std::string> types = {
        {0, "type 0"},    {8, "poly"},     {9, "bspline"}, {24, "hf"},
        {28, "submodel"}, {32, "type 32"}, {37, "brep"},   {200, "type 200"},
    };
    std::string objects;
    for (const auto& [type, name] : types) {
        objects += WrittenObject{.minor = type, .name = "s" + std::to_string(type), .body = "any bytes"}.bytes();
    }
    const Scene scene = parse(objects);
    REQUIRE(scene.objects.size() == types.size());
    for (const auto& [type, name] : types) CHECK(unsupported_type(scene, "s" + std::to_string(type)) == name);
    // Their bodies are not looked at, so it does not matter that they are compressed.
    const std::string packed = WrittenObject{.minor = 37, .name = "b", .body = "zz", .compression = 1}.bytes();
    CHECK(unsupported_type(parse(packed), "b") == "brep");
}

TEST_CASE("g: objects without an inside are the empty set where they are used, and else left out", "[g]") {
    const std::map<int, std::string> types = {{22, "grip"},  {23, "joint"},  {39, "constrnt"}, {42, "annot"},
                                              {44, "datum"}, {45, "script"}, {46, "material"}};
    std::string objects = sphere("ball");
    for (const auto& [type, name] : types) {
        objects += WrittenObject{.minor = type, .name = name, .body = "any bytes"}.bytes();
    }
    CHECK(parse(objects).objects.size() == 1);
    const Scene scene = parse(objects + combination("c", {.leaves = {{"grip"}, {"ball"}}, .expression = "\1\1\2"}));
    CHECK(scene.objects.size() == 3);
    CHECK(comb(scene, "grip").tree.nodes.empty());
    CHECK(validate(scene).empty());
}

TEST_CASE("g: lengths of every width", "[g]") {
    for (unsigned width = 0; width < 4; ++width) {
        INFO(width);
        const Members members{.leaves = {{"a", 0}, {"b"}},
                              .expression = "\1\1\4",
                              .matrices = {{1, 0, 0, 7, 0, 1, 0, 8, 0, 0, 1, 9, 0, 0, 0, 1}},
                              .width = width};
        const Scene scene = parse(WrittenObject{.minor = 31,
                                                .name = "c",
                                                .body = members.bytes(),
                                                .attributes = attributes({"region", "R"}),
                                                .width = width}
                                      .bytes());
        CHECK(written(comb(scene, "c").tree) == "-(a b)");
        CHECK(comb(scene, "c").region);
        CHECK(comb(scene, "c").tree.nodes[0].matrix[7] == 8);
        CHECK(comb(scene, "c").tree.nodes[1].matrix == identity);
    }
    // Long enough that a length needs more than a byte.
    const std::string name(300, 'n');
    CHECK(parse(WrittenObject{.minor = 3, .name = name, .body = counted_reals(1, 12), .width = 1}.bytes()).find(name));
}

TEST_CASE("g: trees", "[g]") {
    CHECK(tree_of({}) == "");
    CHECK(tree_of({.leaves = {{"a"}}}) == "a");
    CHECK(tree_of({.leaves = {{"a"}, {"b"}, {"c"}}}) == "u(a b c)");
    CHECK(tree_of({.leaves = {{"a"}}, .expression = "\1"}) == "a");
    CHECK(tree_of({.leaves = {{"a"}, {"b"}, {"c"}}, .expression = "\1\1\2\1\4"}) == "-(u(a b) c)");
    CHECK(tree_of({.leaves = {{"a"}, {"b"}, {"c"}}, .expression = "\1\1\1\3\5"}) == "^(a +(b c))");
    CHECK(tree_of({.leaves = {{"a"}, {"b"}}, .expression = "\1\1\6\3"}) == "+(a !(b))");
    CHECK(tree_of({.leaves = {{"a"}, {"a"}}, .expression = "\1\1\2"}) == "u(a a)");

    // Depth costs no stack.
    constexpr std::size_t depth = 100'000;
    Members deep{.expression = std::string(depth, '\1') + std::string(depth - 1, '\4'), .width = 2};
    deep.leaves.assign(depth, {"a"});
    const Scene scene = parse(WrittenObject{.minor = 31, .name = "deep", .body = deep.bytes(), .width = 2}.bytes());
    CHECK(comb(scene, "deep").tree.nodes.size() == 2 * depth - 1);
}

TEST_CASE("g: matrices are divided by their scale", "[g]") {
    const Members members{.leaves = {{"a", 1}, {"b", 0}},
                          .matrices = {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0, 1},
                                       {1, 0, 0, 4, 0, 1, 0, 6, 0, 0, 1, 8, 0, 0, 0, 0.5}}};
    const Scene scene = parse(WrittenObject{.minor = 31, .name = "c", .body = members.bytes(), .width = 1}.bytes());
    const auto& nodes = comb(scene, "c").tree.nodes;
    REQUIRE(nodes.size() == 3);
    CHECK(nodes[0].matrix == Matrix{2, 0, 0, 8, 0, 2, 0, 12, 0, 0, 2, 16, 0, 0, 0, 1});
    CHECK(nodes[1].matrix == Matrix{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0, 1});
}

TEST_CASE("g: attributes", "[g]") {
    const std::string global = attributes({"title", "A {model}", "units", "2.54000000000000000e+01", "note", "",
                                           "regionid_colortable", "{1 2 0 0 255} {3 4 0 255 0} "});
    const std::string keys =
        attributes({"region", "R", "region_id", "1001", "material_id", "7", "los", "50", "aircode", "3", "color",
                    "255/0/51", "shader", "glass {tr .85}", "inherit", "1", "own", ""});
    const Scene scene =
        parse(WrittenObject{.major = 2, .name = "_GLOBAL", .attributes = global}.bytes() +
              combination("r", {.leaves = {{"a"}}}, keys) +
              combination("c", {.leaves = {{"a"}}}, attributes({"rgb", "0/0/255", "oshader", "glass"})) +
              combination("v", {.leaves = {{"a"}}}, attributes({}) + "\2binary") +
              combination("w", {.leaves = {{"a"}}}, "air" + zero + "5" + zero) +
              combination("f", {.leaves = {{"a"}}}, attributes({"region", "V"})));
    CHECK(scene.title == "A {model}");
    CHECK(scene.units == "in");
    CHECK(scene.unit_length == 25.4);
    REQUIRE(scene.region_colors.size() == 2);
    CHECK(scene.region_colors[1].high == 4);
    CHECK(scene.region_colors[1].color == Vec3{0, 1, 0});
    CHECK(same_attributes(comb(scene, "r"), asc_test::glass_region));
    CHECK_FALSE(comb(scene, "c").region);
    CHECK(comb(scene, "c").color == Vec3{0, 0, 1});
    CHECK(comb(scene, "c").finish->shader == "glass");
    CHECK_FALSE(comb(scene, "v").color);
    CHECK(comb(scene, "w").air == 5);
    CHECK(comb(scene, "f").region);
    CHECK(comb(scene, "f").fastgen == Fastgen::volume);
}

TEST_CASE("g: what is no geometry is passed over", "[g]") {
    std::string free = WrittenObject{.kind = 2}.bytes();
    free.insert(free.size() - 1, "left over bytes.");  // three units now
    free[5] = '\0';
    free[6] = '\3';
    const Scene scene = parse(
        free + sphere("a") + WrittenObject{.major = 2, .name = "notes", .attributes = attributes({"k", "v"})}.bytes() +
        WrittenObject{.major = 9, .minor = 4, .name = "bytes", .body = "12345678"}.bytes() +
        WrittenObject{.major = 9, .name = "packed", .body = "zz", .compression = 2}.bytes() + sphere("b") + free);
    REQUIRE(scene.objects.size() == 2);
    CHECK(name_of(scene.objects[1]) == "b");
}

TEST_CASE("g: places are bytes and objects", "[g]") {
    const std::string first = sphere("first");
    const Scene scene = parse(first + combination("second", {.leaves = {{"a"}, {"first"}}, .expression = "\1\1\4"}));
    CHECK(place_of(scene.objects[0]).file == "model.g");
    CHECK(place_of(scene.objects[0]).offset == 8);
    CHECK(place_of(scene.objects[0]).line == 0);
    CHECK(place_of(scene.objects[0]).pointer == "first");
    const auto second = static_cast<std::int64_t>(8 + first.size());
    CHECK(place_of(scene.objects[1]).offset == second);
    // The head has 7 bytes, the name 8 and the body 1 before it, and 6 before the leaves; a leaf has 3 and 7.
    const auto& nodes = comb(scene, "second").tree.nodes;
    CHECK(nodes[0].place.offset == second + 7 + 8 + 1 + 6);
    CHECK(nodes[1].place.offset == nodes[0].place.offset + 3);
    CHECK(nodes[2].place.offset == nodes[1].place.offset + 7 + 2);
    CHECK(nodes[1].place.pointer == "second");
}
