// The laboratory of methods, whatever methods it has: those that call themselves exact find the reference's regions,
// and a wrong operator in any of them shows.
#include <algorithm>
#include <map>
#include <set>

#include <csgrt/csgrt.hpp>

#include "bench/chart/truth.hpp"
#include "bench/methods/list.hpp"
#include "catch.hpp"
#include "device/compiling_device.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::bench;

namespace {

/// A scene, its rays, and what the judge holds against an answer. `truth` is the reference's, but for the verdict.
struct Judged {
    std::string name;
    Scene scene;
    std::vector<std::string> objects;
    bool air = false;
    std::vector<Ray> rays;
    std::vector<TrueRay> truth;
    CompiledScene compiled;
};

/// `has_ties`: false if all rays count as decided, which saves asking in 113 bits.
Judged judged(std::string name, Scene scene, std::vector<std::string> objects, bool air, std::vector<Ray> rays,
              bool has_ties = true) {
    Settings settings;
    settings.reference = true;
    settings.air = air;
    Judged made{std::move(name), std::move(scene), std::move(objects), air, std::move(rays), {}, {}};
    made.truth.resize(made.rays.size());
    if (has_ties) made.truth = true_rays(made.scene, made.objects, made.rays);
    Renderer reference(made.scene, made.objects, settings);
    const std::vector<RayPartitions> found = reference.shoot(made.rays);
    for (std::size_t i = 0; i < found.size(); ++i) {
        TrueRay& truth = made.truth[i];
        truth.sequence = sequence_of(found[i]);
        truth.in_unit.assign(truth.sequence.size(), 1);
        truth.out_unit = truth.in_unit;
    }
    made.compiled = compile(made.scene, made.objects, {.air = air});
    // All solids for every scene: a device then compiles one program for all.
    made.compiled.solid_types = (1u << SOLID_TYPES) - 1;
    made.compiled.has_large_terms = true;
    return made;
}

Judged from_family(const std::string& family, std::uint64_t seed, std::size_t count, bool has_ties = true) {
    stress::StressScene made = stress::make(family, seed);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < std::min(count, made.rays.size()); ++i)
        rays.push_back(made.rays[i * made.rays.size() / std::min(count, made.rays.size())]);
    return judged(family + " " + std::to_string(seed), std::move(made.scene), std::move(made.objects), made.air,
                  std::move(rays), has_ties);
}

Judged from_file(const std::string& name, int size) {
    const char* folder = std::getenv("CSGRT_SCENES");
    REQUIRE(folder != nullptr);
    Scene scene = load_scene(std::string(folder) + "/" + name);
    View view;
    view.camera = scene.camera;
    view.width = view.height = size;
    Settings settings;
    settings.reference = true;
    std::vector<Ray> rays = Renderer(scene, {}, settings).model().grid_of(view).rays();
    return judged(name, std::move(scene), {}, false, std::move(rays));
}

/// Where words of bits end: trees of 31 leaves, 32, 33 ..., each of boxes along a line of its own; balanced, or combs
/// to the left or to the right, of one operator or of several in turn.
Judged where_words_end() {
    stress::Builder to("words", 1, 1);
    stress::Random& random = to.random();
    int line = 0;
    for (const std::uint32_t leaves : {1u, 2u, 31u, 32u, 33u, 64u, 65u, 1000u})
        for (const bool differing : {false, true})
            for (int form = 0; form < 4; ++form) {
                const double y = 3 * line++;
                std::vector<Tree> trees;
                for (std::uint32_t i = 0; i < leaves; ++i) {
                    const double low = random.whole(0, 1000);
                    const double length = differing ? random.whole(1, 400) : form == 1 ? 900 : random.whole(1, 20);
                    trees.push_back(stress::leaf(to.solid(stress::box({low, y, 0}, {low + length, y + 1, 1}))));
                }
                const Operator same[] = {Operator::union_, Operator::intersection, Operator::xor_,
                                         Operator::difference};
                std::uint32_t depth = 0;
                const auto join = [&](const Tree& a, const Tree& b) {
                    constexpr Operator turns[] = {Operator::difference, Operator::union_, Operator::xor_};
                    return stress::operate(differing ? turns[depth++ % 3] : same[form], {a, b});
                };
                while (trees.size() > 1) {
                    std::vector<Tree> joined;
                    if (!differing || form == 0) {
                        for (std::size_t i = 0; i + 1 < trees.size(); i += 2)
                            joined.push_back(join(trees[i], trees[i + 1]));
                        if (trees.size() % 2) joined.push_back(trees.back());
                    } else {
                        const bool to_the_right = form == 2 || (form == 3 && depth % 2);
                        joined.push_back(to_the_right ? join(trees[1], trees[0]) : join(trees[0], trees[1]));
                        joined.insert(joined.end(), trees.begin() + 2, trees.end());
                    }
                    trees = std::move(joined);
                }
                to.region(trees.front());
                to.ray({-1, y + 0.5, 0.5}, {1, 0, 0});
                to.ray({500.5, y + 0.25, 0.5}, {-1, 0, 0});
            }
    stress::StressScene made = to.take();
    return judged("words", std::move(made.scene), std::move(made.objects), false, std::move(made.rays), false);
}

/// Where a segment is shorter than the tolerance: before, within, behind and without others.
Judged short_segments() {
    stress::Builder to("short", 1, 1);
    to.region(stress::leaf(to.solid(stress::box({0, 0, 0}, {0.5, 9, 9}))));
    to.region(stress::leaf(to.solid(stress::box({10, 0, 0}, {20, 9, 5}))));
    to.region(stress::leaf(to.solid(stress::box({15, 0, 0}, {15.5, 9, 9}))));
    for (const double z : {1.0, 7.0})
        for (const double way : {1.0, -1.0}) to.ray({10 - 30 * way, 1, z}, {way, 0, 0});
    stress::StressScene made = to.take();
    made.scene.tolerance = 1;
    return judged("short segments", std::move(made.scene), std::move(made.objects), false, std::move(made.rays), false);
}

/// Unions and differences of solids that stand once in a tree, no two surfaces in one place, and rays from outside:
/// what methods that give rays up hold.
Judged drilled() {
    stress::Builder to("drilled", 1, 1);
    stress::Random& random = to.random();
    const auto ball = [&](double radius) {
        const auto at = [&] { return 0.01 * random.whole(-500, 500); };
        const double x = at(), y = at(), z = at();
        return stress::leaf(to.solid(stress::ball({x, y, z}, radius)));
    };
    for (int i = 0; i < 4; ++i) {
        const Tree whole = i % 2 ? stress::operate(Operator::union_, {ball(3), ball(2.5)}) : ball(4);
        to.region(stress::operate(Operator::difference, {whole, ball(2), ball(1.5)}));
    }
    for (int i = 0; i < 60; ++i) {
        const Vec3 through{0.1 * random.whole(-50, 50), 0.1 * random.whole(-50, 50), 0.1 * random.whole(-50, 50)};
        to.ray_through(through, {0.1 * random.whole(1, 9), 0.1 * random.whole(1, 9), 0.1 * random.whole(1, 9)}, 100);
    }
    stress::StressScene made = to.take();
    return judged("drilled", std::move(made.scene), std::move(made.objects), false, std::move(made.rays));
}

TrueRay first_of(TrueRay truth) {
    truth.sequence.resize(std::min<std::size_t>(truth.sequence.size(), 1));
    return truth;
}

struct Verdict {
    std::size_t answered = 0, decided = 0, wrong = 0;
};

/// Nothing if the method cannot trace the scene, and says why; or if there is no device for it.
std::optional<Verdict> judge(const Method& method, const Judged& on, double knob, bool first_hits, bool planted) {
    TraceOptions options;
    options.knob = knob;
    options.first_hits = first_hits;
    options.planted = planted;
    options.threads = 2;
    std::vector<Answer> answers;
    try {
        if (method.on_device) options.device = test::compiling_device();
        answers = method.prepare({on.scene, on.objects, on.compiled}, options)->trace(on.rays);
    } catch (const Error& error) {
        if (error.status() != Status::usage && error.status() != Status::no_device) throw;
        CHECK_FALSE(std::string(error.what()).empty());
        return {};
    }
    REQUIRE(answers.size() == on.rays.size());
    Verdict verdict;
    Accuracy accuracy;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        if (!answers[i].answered) continue;
        ++verdict.answered;
        Sequence found = joined(answers[i].stretches);
        if (first_hits) found.resize(std::min<std::size_t>(found.size(), 1));
        accuracy.add(first_hits ? first_of(on.truth[i]) : on.truth[i], found);
    }
    verdict.decided = accuracy.decided;
    verdict.wrong = accuracy.wrong;
    return verdict;
}

/// How many of the scenes an exact method could trace; it must do so without a wrong ray, in each mode.
std::size_t require_right(const Method& method, const std::vector<Judged>& scenes) {
    std::size_t traced = 0;
    std::vector<double> knobs = method.knob_values;
    if (knobs.empty()) knobs = {0};
    for (const Judged& on : scenes)
        for (const double knob : knobs)
            for (const bool first_hits : {false, true}) {
                if (first_hits ? !method.first_hits : !method.every_partition) continue;
                INFO(method.name << ", knob " << knob << ", " << on.name << (first_hits ? ", first hits" : ""));
                const std::optional<Verdict> verdict = judge(method, on, knob, first_hits, false);
                if (!verdict) continue;
                ++traced;
                CHECK(verdict->wrong == 0);
                CHECK((method.gives_up || 2 * verdict->answered > on.rays.size()));
            }
    return traced;
}

}  // namespace

TEST_CASE("methods of the laboratory have names of their own, say what breaks them, and have a mode", "[methods]") {
    std::set<std::string> names;
    for (const Method& method : methods()) {
        INFO(method.name);
        CHECK(names.insert(method.name).second);
        CHECK_FALSE(method.source.empty());
        CHECK_FALSE(method.about.empty());
        CHECK_FALSE(method.breaks.empty());
        CHECK((method.first_hits || method.every_partition));
        CHECK(method.knob.empty() == method.knob_values.empty());
    }
    CHECK(names.count("Roth") == 1);
}

static void require_exact_methods(bool on_device) {
    std::vector<Judged> scenes, few;  // few for devices, which take a while for each
    for (const char* family : {"coplanar", "deep_trees", "nested"}) few.push_back(from_family(family, 8, 24));
    few.push_back(short_segments());
    few.push_back(where_words_end());
    for (const std::string& family : stress::families()) scenes.push_back(from_family(family, 0, 12));
    for (const char* name : {"operators.json", "coplanar.json", "xor.json"}) scenes.push_back(from_file(name, 10));
    std::size_t decided = 0, rays = 0;
    for (const Judged& on : scenes)
        for (const TrueRay& truth : on.truth) {
            ++rays;
            decided += truth.verdict == TrueRay::Verdict::decided;
        }
    REQUIRE(2 * decided > rays);
    const std::vector<TrueRay>& words = few.back().truth;
    REQUIRE(4 * std::count_if(words.begin(), words.end(), [](const TrueRay& t) { return t.sequence.size() > 2; }) >
            std::ptrdiff_t(words.size()));
    for (const Method& method : methods()) {
        if (!method.exact || method.on_device != on_device) continue;
        INFO(method.name);
        const std::size_t traced = require_right(method, few) + (method.on_device ? 0 : require_right(method, scenes));
        if (traced == 0) WARN(method.name << " was not run: there is no device for it");
    }
}

TEST_CASE("exact methods of the laboratory find the reference's regions", "[methods]") { require_exact_methods(false); }

TEST_CASE("exact methods of the laboratory find the reference's regions on a device", "[.pocl][methods]") {
    require_exact_methods(true);
}

TEST_CASE("methods that give rays up answer all of a scene that they hold", "[methods]") {
    const Judged on = drilled();
    for (const Method& method : methods()) {
        if (!method.gives_up) continue;
        INFO(method.name);
        for (const bool first_hits : {false, true}) {
            const std::optional<Verdict> verdict = judge(method, on, 0, first_hits, false);
            REQUIRE(verdict);
            CHECK(verdict->answered == on.rays.size());
            CHECK(verdict->decided > 50);
            CHECK(verdict->wrong == 0);
        }
    }
}

TEST_CASE("a difference that a method takes for a union shows in the judge's count", "[methods]") {
    const Judged nested = from_family("nested", 3, 60), holds = drilled();
    for (const Method& method : methods()) {
        INFO(method.name);
        const Judged& on = method.gives_up ? holds : nested;
        const double knob = method.knob_values.empty() ? 0 : method.knob_values.back();
        const bool first_hits = !method.every_partition;
        const std::optional<Verdict> right = judge(method, on, knob, first_hits, false);
        const std::optional<Verdict> wrong = judge(method, on, knob, first_hits, true);
        if (!right || !wrong) {
            WARN(method.name << " was not run");
            continue;
        }
        CHECK(wrong->decided > 30);
        CHECK(wrong->wrong > right->wrong);
    }
}

TEST_CASE("Ulyanov's trees are equivalent, and no higher than chains", "[methods]") {
    std::vector<Judged> scenes{drilled()};
    for (std::uint64_t seed = 0; seed < 6; ++seed) scenes.push_back(from_family("nested", seed, 30));
    scenes.push_back(from_family("deep_trees", 8, 6));
    std::size_t lower = 0;
    for (const Judged& on : scenes) {
        INFO(on.name);
        std::map<double, std::vector<Answer>> answers;
        std::map<double, double> heights;
        for (const double trees : {0, 1, 2}) {
            TraceOptions options;
            options.knob = trees;
            const auto tracer = ulyanov().prepare({on.scene, on.objects, on.compiled}, options);
            answers[trees] = tracer->trace(on.rays);
            heights[trees] = tracer->figures().at("largest height");
        }
        CHECK(heights[2] <= heights[0]);
        lower += heights[2] < heights[0];
        for (std::size_t i = 0; i < on.rays.size(); ++i)
            for (const double trees : {0, 2})
                CHECK(same_regions(joined(answers[trees][i].stretches), joined(answers[1][i].stretches)));
    }
    CHECK(lower > 3);
}

TEST_CASE("methods with kernels say so where a device has its kernels compiled ahead", "[methods]") {
    const std::vector<FoundDevice> native = find_native_devices();
    if (native.empty()) {
        WARN("there is no native device");
        return;
    }
    const Judged on = from_family("nested", 3, 1);
    for (const Method& method : methods()) {
        if (!method.on_device) continue;
        INFO(method.name);
        TraceOptions options;
        options.device = native.front().info.name;
        if (!method.knob_values.empty()) options.knob = method.knob_values.front();
        CHECK_THROWS_WITH(method.prepare({on.scene, on.objects, on.compiled}, options),
                          ContainsSubstring(method.name) && ContainsSubstring("compiled ahead"));
    }
}

TEST_CASE("Yang's lists are the segments of kernels 1 and 2, in whatever order they come", "[.pocl][methods]") {
    TraceOptions options;
    try {
        options.device = test::compiling_device();
    } catch (const Error& error) {
        if (error.status() != Status::no_device) throw;
        WARN("there is no device");
        return;
    }
    std::vector<Judged> scenes{from_family("depth", 8, 12, false), from_family("edges", 3, 60, false)};
    for (const Judged& on : scenes)
        for (const double items : {1, 4, 7}) {
            INFO(on.name << ", " << items << " work-items a ray");
            options.knob = items;
            const auto tracer = yang_lists().prepare({on.scene, on.objects, on.compiled}, options);
            const std::vector<Answer> answers = tracer->trace(on.rays);
            const std::map<std::string, double> figures = tracer->figures();
            CHECK(figures.at("rays whose bits differ from kernels 1 and 2") == 0);
            if (&on == &scenes[0]) CHECK(figures.at("runs") == 2);  // the first buffer was too small
            for (std::size_t i = 0; i < on.rays.size(); ++i)
                REQUIRE(same_regions(joined(answers[i].stretches), on.truth[i].sequence));
        }
}

namespace {

void require_exact(const std::string& family, std::uint64_t first_seed, std::uint64_t scenes) {
    // Pruning goes through a tree at every end: seconds a ray, where trees are deep.
    const std::size_t rays = family == "depth" ? 4 : family == "deep_trees" ? 12 : 60;
    std::map<std::string, std::size_t> traced;  // scenes, in each mode that the method has
    for (std::uint64_t i = 0; i < scenes; ++i) {
        // An exact method has the reference's regions on ties, too.
        const std::vector<Judged> one = {from_family(family, first_seed + i, rays, false)};
        for (const Method& method : methods())
            if (method.exact) traced[method.name] += require_right(method, one);
    }
    for (const auto& [name, count] : traced)
        if (count == 0) WARN(name << " traced no scene of " << family);
}

}  // namespace

// All 1,092 scenes. `csgrt_tests "every exact method*" -c "depth 1"` runs the second quarter of a family.
TEST_CASE("every exact method on the stress suite", "[.long][methods]") {
    constexpr std::uint64_t quarters = 4, scenes = 84 / quarters;
    for (const std::string& family : stress::families())
        for (std::uint64_t quarter = 0; quarter < quarters; ++quarter) {
            DYNAMIC_SECTION(family << " " << quarter) { require_exact(family, quarter * scenes, scenes); }
        }
}
