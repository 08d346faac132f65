// What becomes of faults in bots, and what is said of them.
#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/solids/meshes/mesh_repair.hpp"
#include "compile/model.hpp"
#include "scene/faults/check_faults.hpp"
#include "scene/warning_texts.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

/// From 0 to 1 and from `from` to 2 along x; both have the side between them if they touch.
Bot two_boxes(double from) {
    Bot bot;
    for (const auto& [low, high] : {std::pair{0.0, 1.0}, std::pair{from, 2.0}}) {
        const auto first = static_cast<std::uint32_t>(bot.vertices.size());
        for (int i = 0; i < 8; ++i)
            bot.vertices.push_back({(i & 1) != 0 ? high : low, double(i >> 1 & 1), double(i >> 2 & 1)});
        for (const std::array<std::uint32_t, 4>& q : {std::array<std::uint32_t, 4>{0, 4, 6, 2},
                                                      {1, 3, 7, 5},
                                                      {0, 1, 5, 4},
                                                      {2, 6, 7, 3},
                                                      {0, 2, 3, 1},
                                                      {4, 5, 7, 6}}) {
            bot.faces.push_back({first + q[0], first + q[1], first + q[2]});
            bot.faces.push_back({first + q[0], first + q[2], first + q[3]});
        }
    }
    return bot;
}

using Notes = std::vector<std::string>;

}  // namespace

TEST_CASE("a sound bot stays as it is, without a word") {
    for (const auto orientation : {Bot::Orientation::unoriented, Bot::Orientation::counterclockwise}) {
        Bot bot = tetrahedron();
        bot.orientation = orientation;
        const RepairedMesh repaired = repair(bot);
        CHECK(repaired.notes.empty());
        CHECK(repaired.is_closed);
        CHECK(repaired.mesh.faces == bot.faces);
        CHECK(repaired.mesh.vertices == bot.vertices);
    }
}

TEST_CASE("faces given before do not count again, whatever their vertices' numbers and their winding",
          "[promise:databases]") {
    Bot bot = tetrahedron();
    bot.faces.push_back({2, 1, 3});
    bot.vertices.push_back({0, -0.0, 0});
    bot.faces.push_back({4, 1, 2});
    RepairedMesh repaired = repair(bot);
    CHECK(repaired.notes == Notes{"2 faces that were given before do not count again"});
    CHECK(repaired.mesh.faces == tetrahedron().faces);
    CHECK(repaired.from == std::vector<std::uint32_t>{0, 1, 2, 3});
    bot = tetrahedron();
    bot.faces.insert(bot.faces.end(), {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    repaired = repair(bot);
    CHECK(repaired.notes == Notes{"4 faces that were given before do not count again"});
    CHECK(repaired.is_closed);
}

TEST_CASE("a side that two parts have in common is inside") {
    const RepairedMesh repaired = repair(two_boxes(1));
    CHECK(repaired.is_closed);
    CHECK(repaired.mesh.faces.size() == 20);
    CHECK(repaired.notes == Notes{"4 faces between parts of it count for nothing: they are inside"});
    CHECK(repair(two_boxes(1.5)).notes.empty());
}

TEST_CASE("both sides of a sheet enclose nothing") {
    Bot bot = tetrahedron();
    const auto first = static_cast<std::uint32_t>(bot.vertices.size());
    bot.vertices.insert(bot.vertices.end(), {{9, 0, 0}, {9, 1, 0}, {9, 0, 1}});
    bot.faces.insert(bot.faces.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 1}});
    const RepairedMesh repaired = repair(bot);
    CHECK(repaired.is_closed);
    CHECK(repaired.mesh.faces == tetrahedron().faces);
}

TEST_CASE("faces without an area do not count; the one that closes a gap stays", "[promise:databases]") {
    Bot bot = tetrahedron();
    bot.faces.insert(bot.faces.end(), {{1, 1, 2}, {3, 3, 3}});
    CHECK(repair(bot).notes == Notes{"2 faces have no area and count for nothing"});
    bot.vertices.push_back({2, 0, 0});
    bot.faces.push_back({0, 1, 4});  // vertex 4 is in the middle of edge 0 1
    CHECK(repair(bot).notes == Notes{"3 faces have no area and count for nothing"});
    CHECK(repair(bot).mesh.faces == tetrahedron().faces);
    bot.faces[1] = {0, 4, 3};
    bot.faces.push_back({4, 1, 3});
    const RepairedMesh repaired = repair(bot);  // now 0 1 4 is between 0 4 3, 4 1 3 and 0 2 1
    CHECK(repaired.is_closed);
    CHECK(repaired.mesh.faces.size() == 6);
}

TEST_CASE("a face is cut at a vertex in the middle of its edge, where that closes the surface", "[promise:databases]") {
    Bot bot = tetrahedron();
    bot.vertices.push_back({1, 0, 0});
    bot.vertices.push_back({3, 0, 0});
    bot.faces[1] = {0, 4, 3};
    bot.faces.insert(bot.faces.end(), {{4, 5, 3}, {5, 1, 3}});
    RepairedMesh repaired = repair(bot);
    CHECK(repaired.is_closed);
    CHECK(repaired.mesh.faces.size() == 8);
    CHECK(repaired.from == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 0, 0});
    CHECK(repaired.notes == Notes{"1 face is cut at vertices in the middle of their edges"});
    // As single precision leaves it.
    bot.vertices[4].y = 1e-7;
    CHECK(repair(bot).is_closed);
    bot.vertices[4].y = 1e-3;
    CHECK_FALSE(repair(bot).is_closed);
    // Both faces of an edge in parts, each at another place.
    bot = tetrahedron();
    bot.vertices.insert(bot.vertices.end(), {{1, 0, 0}, {3, 0, 0}});
    bot.faces = {{0, 2, 4}, {4, 2, 1}, {0, 5, 3}, {5, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    repaired = repair(bot);
    CHECK(repaired.is_closed);
    CHECK(repaired.notes == Notes{"2 faces are cut at vertices in the middle of their edges"});
}

TEST_CASE("winding, gaps and crowded edges are told with counts", "[promise:databases]") {
    Bot bot = tetrahedron();
    std::swap(bot.faces[2][0], bot.faces[2][1]);
    CHECK(repair(bot).notes == Notes{"1 face winds against the others; what is inside is told by parity"});
    bot = tetrahedron();
    bot.orientation = Bot::Orientation::clockwise;
    CHECK(repair(bot).notes ==
          Notes{"its faces wind the other way than its orientation says; what is inside is told by parity"});

    bot = tetrahedron();
    bot.faces.pop_back();
    CHECK(repair(bot).notes ==
          Notes{"3 edges are open; where a ray comes through a gap, crossings are paired from the first on"});
    bot.orientation = Bot::Orientation::counterclockwise;
    CHECK(repair(bot).notes ==
          Notes{"3 edges are open; where a ray comes through a gap, a way in and the next way out are a pair"});
    std::swap(bot.faces[2][0], bot.faces[2][1]);
    const RepairedMesh turned = repair(bot);
    REQUIRE(turned.notes.size() == 2);
    CHECK(turned.notes[0] == "1 face winds against the others and counts turned over");
    CHECK(turned.mesh.faces[2] == std::array<std::uint32_t, 3>{2, 3, 1});

    bot = tetrahedron();  // and one at its edge 0 1
    bot.vertices.insert(bot.vertices.end(), {{0, -4, 0}, {0, 0, -4}});
    bot.faces.insert(bot.faces.end(), {{0, 1, 4}, {0, 5, 1}, {1, 5, 4}, {4, 5, 0}});
    CHECK(repair(bot).notes == Notes{"1 edge has more than two faces; what is inside is told by parity"});
    CHECK(repair(bot).is_closed);
}

TEST_CASE("plates given before with the same thickness do not count again") {
    Bot bot = tetrahedron();
    bot.mode = Bot::Mode::plate;
    bot.faces.insert(bot.faces.end(), {{2, 1, 0}, {0, 3, 1}, {1, 1, 3}});
    bot.thickness = {1, 1, 1, 1, 1, 2, 1};
    const RepairedMesh repaired = repair(bot);
    CHECK(repaired.from == std::vector<std::uint32_t>{0, 1, 2, 3, 5});
    CHECK(repaired.notes ==
          Notes{"1 face that was given before does not count again", "1 face has no area and counts for nothing"});
}

TEST_CASE("notes carry the bot's name, once for all its places") {
    Bot bot = tetrahedron();
    bot.faces.push_back({2, 1, 3});
    const Matrix aside{1, 0, 0, 9, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const CompiledScene c = compile(scene({solid("b", bot), region("r", {leg("b"), leg("b", aside), either})}));
    CHECK(test::texts(c.warnings) == Notes{"scene.json:1:1: b: 1 face that was given before does not count again"});
}
