// Repainting: other appearances on the tables of the scene before, which are shared; regions found by their paths.
#include "compile/repaint.hpp"

#include <algorithm>
#include <map>

#include "catch.hpp"
#include "compile/model.hpp"
#include "compile/regions/claimed_by.hpp"
#include "thrown.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

/// 3000 regions of one ball each, the last of which emits light, below "/all" and "/all/some".
Scene balls() {
    std::vector<Object> objects;
    std::vector<TreeNode> all{leg("some")}, some;
    for (int i = 0; i < 3000; ++i) {
        const std::string name = "b" + std::to_string(i);
        objects.push_back(ball(name, {10.0 * (i % 50), 10.0 * (i / 50), 0}, 4));
        objects.push_back(region(name + ".r", {leg(name)}, i + 1));
        (i < 1000 ? some : all).push_back(leg(name + ".r"));
    }
    std::get<Combination>(objects.back()).finish = Finish{.shader = "light", .light = Emission{}};
    some.push_back(op(Operator::union_, 1000));
    objects.push_back(group("some", some));
    all.push_back(op(Operator::union_, 2001));
    objects.push_back(group("all", all));
    return {.objects = std::move(objects)};
}

SceneAppearance appearance(const Scene& scene) { return {scene.lights, scene.ambient, scene.background}; }

template <class T>
std::size_t chunks_that_differ(const SharedList<T>& a, const SharedList<T>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.chunk_count(); ++i) count += a.chunk(i).data() != b.chunk(i).data();
    return count;
}

}  // namespace

TEST_CASE("an edit of appearance makes anew what it changes, and shares the rest", "[promise:edits]") {
    const Scene scene = balls();
    const CompiledScene before = compile(scene);
    REQUIRE(before.region_info.chunk_count() == 12);
    const auto repaint = [&](const std::vector<Look>& looks) {
        const CompiledScene made = repainted(before, looks, appearance(scene));
        Scene edited = scene;
        edited.looks = looks;
        const CompiledScene anew = compile(edited);
        CHECK(made.hash == anew.hash);
        CHECK(made.lights.size() == anew.lights.size());
        for (std::size_t i = 0; i < anew.region_info.size(); ++i) {
            REQUIRE(made.region_info[i].color == anew.region_info[i].color);
            REQUIRE(made.region_info[i].state == anew.region_info[i].state);
        }
        for (const State state : {State::shown, State::ghost}) {
            if (anew.states.empty()) continue;
            const CompiledScene one = claimed_by(made, state), other = claimed_by(anew, state);
            CHECK(one.hash == other.hash);
            CHECK(one.reals.shares(before.reals));
            CHECK(one.trees.shares(before.trees));
        }
        for (const bool shares :
             {made.solids.shares(before.solids), made.starts.shares(before.starts), made.nodes.shares(before.nodes),
              made.flat_trees.shares(before.flat_trees), made.paths == before.paths})
            CHECK(shares);
        return made;
    };
    const auto changed = [&](const std::vector<Look>& looks) {
        const CompiledScene made = repaint(looks);
        return std::pair{chunks_that_differ(made.region_info, before.region_info),
                         chunks_that_differ(made.materials, before.materials)};
    };
    using Counts = std::pair<std::size_t, std::size_t>;
    const Vec3 red{1, 0, 0};
    CHECK(changed({{.path = "/all/b1500.r", .color = red}}) == Counts(1, 1));
    CHECK(changed({{.path = "/all/b1500.r", .state = State::hidden}}) == Counts(1, 0));
    CHECK(changed({{.path = "/all/b1500.r", .state = State::shown}}) == Counts(0, 0));
    CHECK(changed({{.path = "/all/b2999.r", .color = red}}) == Counts(1, 1));
    CHECK(changed({{.path = "/all", .state = State::hidden}, {.path = "/all/some", .state = State::ghost}}) ==
          Counts(12, 0));
    CHECK(changed({{.path = "/all/some", .color = red}, {.path = "/all/some/b7.r", .finish = Finish{.shine = 3}}}) ==
          Counts(4, 4));
    // Of states only the records of the regions' solids differ.
    const CompiledScene hidden = claimed_by(repaint({{.path = "/all/b1500.r", .state = State::hidden}}), State::shown);
    std::size_t records = 0;
    for (std::size_t i = 0; i < before.solids.size(); ++i)
        records += before.solids[i].start_count != hidden.solids[i].start_count;
    CHECK(records == 1);
}

TEST_CASE("31 scenes that differ by a region each share their chunks", "[promise:edits]") {
    const Scene scene = balls();
    std::vector<CompiledScene> kept{compile(scene)};
    std::map<const void*, int> infos, materials;
    for (int i = 0; i < 31; ++i)
        kept.push_back(repainted(kept.back(),
                                 {{.path = "/all/b" + std::to_string(1000 + 50 * i) + ".r", .color = Vec3{0, 0, 1}}},
                                 appearance(scene)));
    for (const CompiledScene& of : kept)
        for (std::size_t i = 0; i < of.region_info.chunk_count(); ++i) {
            ++infos[of.region_info.chunk(i).data()];
            ++materials[of.materials.chunk(i).data()];
        }
    CHECK(infos.size() == 12 + 31);
    CHECK(materials.size() == 12 + 31);
}

TEST_CASE("regions are found by the path of any leg, whatever characters names have") {
    std::vector<TreeNode> legs;
    std::vector<Object> objects{ball("ball", {0, 0, 0}, 1)};
    for (const std::string name : {"a", "a-b", "a.c", "a b", "a0", "b", "B", "\xc3\xa9"}) {
        objects.push_back(region(name + "r", {leg("ball")}, 1));
        objects.push_back(group(name, {leg(name + "r"), leg(name + "r"), op(Operator::union_, 2)}));
        legs.push_back(leg(name));
    }
    legs.push_back(op(Operator::union_, 8));
    objects.push_back(group("all", legs));
    const CompiledScene c = compile(Scene{.objects = objects});
    REQUIRE(c.region_info.size() == 16);
    for (const std::string path : {"/", "/all", "/all/a", "/all/a-b", "/all/a/ar", "/all/a/ar@2", "/all/\xc3\xa9"}) {
        std::vector<std::uint32_t> expected, found = regions_at(c, path);
        for (std::uint32_t i = 0; i < 16; ++i) {
            const std::string& own = c.region_info[i].path;
            if (path == "/" || own == path || own.starts_with(path + "/")) expected.push_back(i);
        }
        std::ranges::sort(found);
        CHECK(found == expected);
        CHECK_FALSE(found.empty());
    }
    CHECK(says(failure(Status::usage, [&] { regions_at(c, "/all/a/a"); }), "no region at '/all/a/a'"));
    CHECK(says(failure(Status::usage, [&] { regions_at(c, "/al"); }), "'/all"));
}

TEST_CASE("a shared list is a range like a vector") {
    SharedList<int> list(1000);
    for (std::size_t i = 0; i < list.size(); ++i) list.own(i) = static_cast<int>(i);
    static_assert(std::ranges::random_access_range<const SharedList<int>>);
    CHECK(std::vector<int>(list)[999] == 999);
    CHECK(list.end() - list.begin() == 1000);
    CHECK(*std::ranges::lower_bound(list, 700) == 700);
    SharedList<int> copy = list;
    copy.own(300) = -1;
    CHECK(list[300] == 300);
    CHECK(chunks_that_differ(copy, list) == 1);
    CHECK(copy.back() == 999);
    CHECK(SharedList<int>().empty());
}
