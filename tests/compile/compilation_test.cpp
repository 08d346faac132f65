// Compilations of edited scenes: what a part makes again has the bits of the whole made anew.
#include "compile/compilation.hpp"

#include <cstring>

#include "base/identical.hpp"
#include "catch.hpp"
#include "compile/random_parts.hpp"
#include "sanitized.hpp"
#include "scene/warning_texts.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

template <class T>
bool same_table(const SharedVector<T>& a, const SharedVector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_materials(const Appearance& a, const Appearance& b) {
    return a.materials_hash == b.materials_hash &&
           std::ranges::equal(a.materials, b.materials, [](const auto& x, const auto& y) { return same_bits(x, y); });
}

void require_same(const CompiledScene& a, const CompiledScene& b) {
    REQUIRE(same_table(a.nodes, b.nodes));
    REQUIRE(same_bits(a.center, b.center));
    REQUIRE(same_bits(a.radius, b.radius));
    REQUIRE(same_table(a.trees, b.trees));
    REQUIRE(same_table(a.starts, b.starts));
    REQUIRE(same_table(a.regions, b.regions));
    REQUIRE(same_table(a.solids, b.solids));
    REQUIRE(same_table(a.reals, b.reals));
    REQUIRE(same_table(a.planes, b.planes));
    REQUIRE(same_table(a.words, b.words));
    REQUIRE(same_table(a.inner_nodes, b.inner_nodes));
    REQUIRE(same_table(a.solid_boxes, b.solid_boxes));
    REQUIRE(same_materials(a, b));
    REQUIRE(same_bits(a.bounds, b.bounds));
    REQUIRE(a.starting_node == b.starting_node);
    REQUIRE(a.solid_types == b.solid_types);
    REQUIRE(a.solid_info.size() == b.solid_info.size());
    for (std::size_t i = 0; i < a.solid_info.size(); ++i) {
        REQUIRE(a.solid_info[i].name == b.solid_info[i].name);
        REQUIRE(a.solid_info[i].piece == b.solid_info[i].piece);
    }
    REQUIRE(a.region_info.size() == b.region_info.size());
    for (std::size_t i = 0; i < a.region_info.size(); ++i) {
        REQUIRE(a.region_info[i].path == b.region_info[i].path);
        REQUIRE(same_bits(a.region_info[i].bounds, b.region_info[i].bounds));
        REQUIRE(std::ranges::equal(a.flat_trees[i].nodes, b.flat_trees[i].nodes, [](const auto& x, const auto& y) {
            return x.op == y.op && x.arity == y.arity && x.solid == y.solid;
        }));
    }
    REQUIRE(texts(a.warnings) == texts(b.warnings));
    REQUIRE(a.geometry_hash == b.geometry_hash);
    REQUIRE(a.hash == b.hash);
}

class Chain : RandomParts {
public:
    using RandomParts::RandomParts;

    /// Moves members, one step after the other, and compares each with a whole compilation.
    void go(int steps, int& local, int& whole, int& taken_out) {
        auto scene = std::make_shared<const Scene>(RandomParts::scene());
        std::unique_ptr<Compilation> compilation;
        SceneChanges now, before_now;
        CompiledScene before;
        const auto begin = [&] {
            compilation = std::make_unique<Compilation>(scene, std::vector<std::string>(), CompileOptions(), 1000);
            before = compilation->compiled();
            now = before_now = {};
        };
        begin();
        for (int i = 0; i < steps; ++i) {
            for (unsigned n = 0; n <= below(2); ++n) edit_some(*scene, now);
            const Scene placed = changed_scene(*scene, now);
            std::optional<CompiledScene> anew;
            try {
                anew = compile(placed);
            } catch (const Error&) {  // nothing is left of the scene, or a matrix is none
                now = before_now;
                continue;
            }
            const std::optional<CompiledScene> made = compilation->with(now, before, before_now);
            if (made) {
                ++local;
                taken_out += now.removed != before_now.removed;
                require_same(*made, *anew);
                if (below(4) == 0) continue;  // the next step begins where this one began
                before = *made;
                before_now = now;
            } else if (!compilation->is_spent() && below(2) == 0) {
                ++whole;
                now = before_now;
            } else {
                ++whole;
                scene = std::make_shared<const Scene>(placed);
                begin();
            }
        }
    }

    int has_alone = 0;

private:
    void edit_some(const Scene& scene, SceneChanges& changes) {
        const unsigned kind = below(6);
        if (kind == 0) remove_some(scene, changes);
        if (kind == 1) move_one(scene, changes);
        if (kind > 1) move_some(scene, changes);
    }

    /// Moves one instance of a region that may have several.
    void move_one(const Scene& scene, SceneChanges& changes) {
        const Names names(scene);
        const std::vector<std::string> top = names.top_objects();
        std::string path = top[below(top.size())];
        for (std::uint32_t object = names.find(path); names.kind(object) == Names::Kind::combination;) {
            const std::uint32_t leaf = below(std::max<std::size_t>(names.children(object).size() - 1, 1));
            path += "/" + names.member_name(object, leaf);
            object = names.child(object, leaf);
        }
        if (place_beside(names, top, path, some_matrix(), true, changes)) has_alone += !changes.matrices.alone.empty();
    }

    void remove_some(const Scene& scene, SceneChanges& changes) {
        const Names names(scene);
        for (int i = 0; i < 10; ++i) {
            const auto* combination = std::get_if<Combination>(&scene.objects[below(scene.objects.size())]);
            if (combination == nullptr || combination->tree.nodes.size() < 3) continue;
            const std::uint32_t object = names.find(combination->name);
            const std::size_t leaf = below(combination->tree.nodes.size() - 1);
            if (combination->tree.nodes[leaf].op != Operator::leaf) continue;
            const std::string path = combination->name + "/" + names.member_name(object, leaf);
            if (remove_beside(names, {}, path, changes)) return;
        }
    }

    void move_some(const Scene& scene, SceneChanges& changes) {
        std::map<Member, Matrix>& matrices = changes.matrices.all;
        std::vector<Member> members;
        for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
            if (const auto* combination = std::get_if<Combination>(&scene.objects[i]))
                for (std::uint32_t k = 0; k < combination->tree.nodes.size(); ++k)
                    if (combination->tree.nodes[k].op == Operator::leaf) members.emplace_back(i, k);
        const Names names(scene);
        for (const std::string& top : names.top_objects())
            for (int i = 0; i < 2; ++i) members.emplace_back(names.find(top), Names::none);
        matrices[members[below(members.size())]] = below(60) == 0 ? Matrix{} : some_matrix();
        if (below(10) == 0 && !matrices.empty()) matrices.erase(matrices.begin());
    }
};

void go(int chains, int steps) {
    int local = 0, whole = 0, taken_out = 0, alone = 0;
    for (int seed = 0; seed < chains; ++seed) {
        INFO("chain " << seed);
        Chain chain(static_cast<unsigned>(seed));
        chain.go(steps, local, whole, taken_out);
        alone += chain.has_alone;
    }
    CAPTURE(local, whole, taken_out, alone);
    if (sanitized) return;  // too few chains to count
    CHECK(3 * local > whole);
    CHECK(whole > 0);
    CHECK(20 * taken_out > local);
    CHECK(20 * alone > local);
}

}  // namespace

TEST_CASE("parts that move have the bits of a scene compiled anew", "[promise:edits]") { go(tries(40), 12); }

TEST_CASE("a solid that is left out comes back when a matrix changes", "[promise:edits]") {
    const double far = 0.75 * Limits::length;
    Scene made;
    made.lenient = true;
    made.objects = {ball("ball", {0, 0, 0}), ball("other", {9, 0, 0}), group("inner", {leg("ball", moved(far, 0, 0))}),
                    group("outer", {leg("inner", moved(far, 0, 0))}), group("rest", {leg("other")})};
    const auto scene = std::make_shared<const Scene>(made);
    Compilation compilation(scene, {}, CompileOptions(), 1000);
    const CompiledScene before = compilation.compiled();
    REQUIRE(before.region_info.size() == 1);
    SceneChanges changes;
    changes.matrices.all[{3, 0}] = moved(-far, 0, 0);
    const std::optional<CompiledScene> made_local = compilation.with(changes, before, {});
    if (made_local) require_same(*made_local, compile(changed_scene(*scene, changes)));
    CHECK(compile(changed_scene(*scene, changes)).region_info.size() == 2);
}

TEST_CASE("parts that move have the bits of a scene compiled anew: 1,000 chains", "[.long]") { go(1000, 30); }
