// The stress suite: where methods of ray tracing fail.
#include <chrono>
#include <map>
#include <set>

#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "integration/tree_value.hpp"
#include "sanitized.hpp"
#include "integration/stress/known_failures.hpp"

using namespace csgrt;
using namespace csgrt::test;
using stress::Rewriting;

namespace {

bool pictured(const std::string& family) { return family == "coplanar" || family == "coincident"; }

template <std::size_t count>
Bounds bounds_of(const Bounds (&table)[count], const std::string& family) {
    for (const Bounds& bounds : table)
        if (family == bounds.family) return bounds;
    return {};
}

void print_head() {
    std::printf("%-11s %6s %6s %5s %6s %9s %5s %5s %9s", "family", "scenes", "rays", "ties", "wrong", "ppm", "lists",
                "far", "worst end");
    for (const Change& change : changes) std::printf(" %10s", change.name);
    std::printf(" %8s %6s %8s\n", "speckles", "others", "seconds");
}

/// One line of the table. Wrong regions in parts of a million decided rays; the worst end in units of what is
/// documented.
void print(const std::string& family, const Counts& counts, const Speckles& speckles, double seconds) {
    const double decided = static_cast<double>(counts.rays - counts.ties);
    std::printf("%-11s %6zu %6zu %5zu %6zu %9.0f %5zu %5zu %9.3g", family.c_str(), counts.scenes, counts.rays,
                counts.ties, counts.wrong, 1e6 * static_cast<double>(counts.wrong) / decided, counts.overlaps,
                counts.far, counts.worst);
    for (const std::size_t count : counts.disagreements) std::printf(" %10zu", count);
    if (speckles.pictures > 0)
        std::printf(" %8zu %6zu", speckles.speckles, speckles.others);
    else
        std::printf(" %8s %6s", "-", "-");
    std::printf(" %8.1f\n", seconds);
    std::fflush(stdout);
}

/// Every `stride`th of a family's scenes, and pictures of the first few; the result is held against the bounds.
struct Part {
    std::uint64_t scenes = 0, stride = 1, pictures = 0;
};
void run(const std::string& family, const Part& part, const Bounds& bounds) {
    const auto start = std::chrono::steady_clock::now();
    Counts counts;
    Speckles speckles;
    for (std::uint64_t i = 0; i < part.scenes; ++i) {
        const std::uint64_t seed = i * part.stride;
        INFO(family << " " << seed);
        const stress::StressScene made = stress::make(family, seed);
        REQUIRE(validate(made.scene, made.objects).empty());
        counts += check(made, on_reference());
        if (pictured(family) && i < part.pictures) speckles += look(made, on_reference());
    }
    print(family, counts, speckles, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    CHECK(2 * counts.ties < counts.rays);  // or too little was asked
    CHECK(counts.wrong <= bounds.wrong);
    CHECK(counts.overlaps == 0);
    CHECK(counts.far == 0);
    for (std::size_t c = 0; c < changes.size(); ++c) {
        INFO(changes[c].name);
        CHECK(counts.disagreements[c] <= bounds.disagreements[c]);
    }
    CHECK(speckles.speckles == 0);
    CHECK(speckles.others == 0);
}

void run_sample(const std::string& family) {
    // The large ones have a test of their own.
    // The sanitizers need no more scenes than show that not most rays are ties.
    const std::uint64_t scenes = family == "deep_trees" ? test::tries(4) : test::sanitized ? 3 : 12;
    const Part part =
        family == "deep_trees" || family == "depth" ? Part{scenes} : Part{scenes, 5, test::sanitized ? 1u : 2u};
    print_head();
    run(family, part, bounds_of(sample_bounds, family));
}

Tree tree_of(std::initializer_list<TreeNode> nodes) { return {nodes}; }
TreeNode leaf(const char* name) { return {Operator::leaf, 0, name, identity, {}}; }
TreeNode op(Operator o, std::uint32_t arity) { return {o, arity, {}, identity, {}}; }

}  // namespace

// One each, so that a failure has a name. tests/CMakeLists.txt registers them.
TEST_CASE("stress coplanar", "[.stress][promise:coincidence]") { run_sample("coplanar"); }
TEST_CASE("stress coincident", "[.stress][promise:coincidence]") { run_sample("coincident"); }
TEST_CASE("stress tangent", "[.stress]") { run_sample("tangent"); }
TEST_CASE("stress edges", "[.stress][promise:contact]") { run_sample("edges"); }
TEST_CASE("stress far_origin", "[.stress][promise:rounding][promise:coincidence]") { run_sample("far_origin"); }
TEST_CASE("stress scale", "[.stress]") { run_sample("scale"); }
TEST_CASE("stress slivers", "[.stress]") { run_sample("slivers"); }
TEST_CASE("stress degenerate", "[.stress]") { run_sample("degenerate"); }
TEST_CASE("stress deep_trees", "[.stress][promise:booleans]") { run_sample("deep_trees"); }
TEST_CASE("stress depth", "[.stress]") { run_sample("depth"); }
TEST_CASE("stress overlaps", "[.stress][promise:overlap]") { run_sample("overlaps"); }
TEST_CASE("stress nested", "[.stress]") { run_sample("nested"); }
TEST_CASE("stress pinch", "[.stress]") { run_sample("pinch"); }

TEST_CASE("the whole stress suite, 1,092 scenes", "[.long]") {
    print_head();
    for (const std::string& family : stress::families()) run(family, {84, 1, 84}, bounds_of(long_bounds, family));
}

// With those of the whole suite, 1,000 scenes and 3,000 pictures.
TEST_CASE("832 more coplanar and coincident scenes have no speckles", "[.long][speckles][promise:coincidence]") {
    for (const char* family : {"coplanar", "coincident"}) {
        Speckles sum;
        for (std::uint64_t seed = 84; seed < 500; ++seed) sum += look(stress::make(family, seed), on_reference());
        std::printf("%s: %zu pictures, %zu speckles, %zu others\n", family, sum.pictures, sum.speckles, sum.others);
        CHECK(sum.speckles == 0);
        CHECK(sum.others == 0);
    }
}

TEST_CASE("a tree of 100,000 nodes, and 10,000 segments on a ray", "[stress]") {
    const auto require_right = [](const stress::StressScene& made, std::size_t nodes, std::size_t stretches) {
        INFO(made.family << " " << made.seed);
        std::size_t found_nodes = 0;
        for (const Object& object : made.scene.objects)
            if (const auto* combination = std::get_if<Combination>(&object))
                found_nodes += combination->tree.nodes.size();
        CHECK(found_nodes >= nodes);
        CHECK(made.known.front().size() >= stretches);
        const std::vector<Expected> expected = expected_of(made);
        const std::vector<RayPartitions> found =
            shoot(made.scene, made.objects, made.objects, made.rays, on_reference()).found;
        for (std::size_t i = 0; i < found.size(); ++i) {
            INFO("ray " << i);
            const Sequence sequence = sequence_of(found[i]);
            REQUIRE(same_regions(sequence, expected[i].sequence));
            CHECK(worst_end(sequence, expected[i].sequence, 0) <= 1);
        }
    };
    if (test::sanitized)
        return require_right(stress::make("depth", 28), 0, 10'000);  // the deep trees have their sample
    require_right(stress::make("deep_trees", 6), 99'999, 1);         // all on the left
    require_right(stress::make("deep_trees", 13), 99'999, 1);        // all on the right
    require_right(stress::make("deep_trees", 27), 99'999, 1);        // combinations in combinations
    require_right(stress::make("depth", 25), 0, 10'000);             // sheets, each its own region
    require_right(stress::make("depth", 28), 0, 10'000);             // a comb, one solid
}

TEST_CASE("a device answers rays of up to 100,000 segments rightly", "[stress][promise:booleans]") {
    for (std::uint64_t seed = 84; seed < 104; ++seed) {
        if ((seed - 84) % 5 == 4 && (seed > 90 || test::sanitized)) continue;  // 10^5 sheets: once will do
        if (test::sanitized && seed >= 94) break;
        const stress::StressScene made = stress::make("depth", seed);
        INFO("seed " << made.seed);
        const std::vector<Expected> expected = expected_of(made);
        const std::vector<RayPartitions> found =
            shoot(made.scene, made.objects, made.objects, made.rays, on_device()).found;
        for (std::size_t i = 0; i < found.size(); ++i) {
            INFO("ray " << i);
            const Sequence sequence = sequence_of(found[i]);
            REQUIRE(same_regions(sequence, expected[i].sequence));
            CHECK(worst_end(sequence, expected[i].sequence, 0) <= 1);
        }
    }
}

TEST_CASE("the device and the reference agree on stress scenes", "[.long]") {
    for (const std::string& family : stress::families())
        for (const std::uint64_t seed : {1u, 8u, 24u}) {
            INFO(family << " " << seed);
            const stress::StressScene made = stress::make(family, seed);
            Renderer device(made.scene, made.objects, on_device());
            Renderer reference(made.scene, made.objects, on_reference());
            require_same(device.shoot(made.rays), reference.shoot(made.rays));
            test::require_same_lists(reference, {&device}, made.rays);
        }
}

TEST_CASE("stress scenes are the same everywhere, and differ by family and seed", "[stress]") {
    CHECK(stress::families().size() == 13);
    CHECK_THROWS_AS(stress::make("no such family", 0), Error);
    std::map<double, std::string> seen;
    // FNV-1a over the bits of all rays of all families' first scenes.
    std::uint64_t hash = 14695981039346656037u;
    for (const std::string& family : stress::families())
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            INFO(family << " " << seed);
            const stress::StressScene made = stress::make(family, seed);
            CHECK(made.rays.size() >= 3);
            CHECK((made.known.empty() || made.known.size() == made.rays.size()));
            CHECK(seen.emplace(made.rays.front().origin.y, family).second);
            for (const Ray& ray : made.rays)
                for (const double x :
                     {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z}) {
                    std::uint64_t bits;
                    std::memcpy(&bits, &x, sizeof bits);
                    hash = (hash ^ bits) * 1099511628211u;
                }
        }
    CHECK(hash == 11925068644283166969u);
}

TEST_CASE("a stress scene with more rays begins with its usual ones", "[stress]") {
    for (const std::string& family : stress::families()) {
        INFO(family);
        const stress::StressScene usual = stress::make(family, 1), more = stress::make(family, 1, 3);
        REQUIRE(more.rays.size() == 3 * usual.rays.size());
        CHECK(more.known.size() == 3 * usual.known.size());
        for (std::size_t i = 0; i < usual.rays.size(); ++i)
            REQUIRE(std::memcmp(&usual.rays[i], &more.rays[i], sizeof(Ray)) == 0);
        CHECK(std::memcmp(&more.rays[usual.rays.size()], &usual.rays[0], sizeof(Ray)) != 0);
    }
}

TEST_CASE("trees in other words have the same value", "[stress]") {
    const Tree tree = tree_of({leaf("a"), leaf("b"), leaf("c"), op(Operator::difference, 3), leaf("d"),
                               op(Operator::not_, 1), leaf("e"), op(Operator::intersection, 2), leaf("a"),
                               op(Operator::xor_, 2), op(Operator::union_, 2), leaf("c"), op(Operator::difference, 2)});
    const std::vector<std::string> names{"a", "b", "c", "d", "e"};
    for (const Rewriting how :
         {Rewriting::differences, Rewriting::de_morgan, Rewriting::double_complements, Rewriting::commuted}) {
        const Tree other = stress::rewritten(tree, how);
        CHECK(other.nodes.size() != 0);
        for (std::size_t bits = 0; bits < 32; ++bits) {
            std::set<std::string> leaves;
            for (std::size_t i = 0; i < names.size(); ++i)
                if (bits >> i & 1) leaves.insert(names[i]);
            const auto is_true = [&](const std::string& name) { return leaves.count(name) > 0; };
            CHECK(value_of(other, is_true) == value_of(tree, is_true));
        }
        const auto count = [&](Operator wanted) {
            return std::count_if(other.nodes.begin(), other.nodes.end(),
                                 [&](const TreeNode& node) { return node.op == wanted; });
        };
        if (how == Rewriting::differences || how == Rewriting::de_morgan) CHECK(count(Operator::difference) == 0);
        if (how == Rewriting::double_complements) CHECK(count(Operator::not_) == 1 + 2 * 13);
        if (how == Rewriting::commuted) CHECK(other.nodes[1].object == "e");
    }
}
