// What the chart of speed against accuracy counts, and what it writes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <csgrt/csgrt.hpp>
#include <nlohmann/json.hpp>

#include "bench/chart/trial.hpp"
#include "catch.hpp"

using namespace csgrt;
using namespace csgrt::bench;

namespace {

RayPartitions answer(std::initializer_list<Partition> partitions) { return {partitions, {}}; }
Partition part(std::uint32_t region, double in, double out) {
    Partition p;
    p.region = region;
    p.in = in;
    p.out = out;
    return p;
}
TrueRay meets(std::initializer_list<Partition> partitions, double unit) {
    TrueRay truth;
    truth.sequence = sequence_of(answer(partitions));
    truth.in_unit.assign(truth.sequence.size(), unit);
    truth.out_unit = truth.in_unit;
    return truth;
}

/// Two boxes that touch at x = 0, each a region, and a ball at x = 10 of radius 1.
Scene some_scene(double tolerance) {
    const auto region = [](const char* name, const char* solid) {
        return std::string("\"") + name + R"(": {"region": true, "tree": {"union": [")" + solid + "\"]}}";
    };
    const std::string text = std::string(R"({"csgrt": 1, "units": "mm", "tolerance": )") + std::to_string(tolerance) +
                             R"(, "solids": {"a": {"type": "box", "low": [-4, -1, -1], "high": [0, 1, 1]},
        "b": {"type": "box", "low": [0, -1, -1], "high": [4, 1, 1]},
        "c": {"type": "box", "low": [0.25, 2, -1], "high": [4, 3, 1]},
        "d": {"type": "box", "low": [-4, 2, -1], "high": [0, 3, 1]},
        "ball": {"type": "sphere", "center": [10, 0, 0], "radius": 1}}, "combinations": {)" +
                             region("left", "a") + "," + region("right", "b") + "," + region("far", "c") + "," +
                             region("near", "d") + "," + region("round", "ball") + "}}";
    const char* path = "chart_test_scene.json";
    std::ofstream(path) << text;
    const Scene scene = load_scene(path);
    std::remove(path);
    return scene;
}

}  // namespace

TEST_CASE("a ray's regions and gaps are held against the truth; ties are not judged") {
    Accuracy a;
    TrueRay truth = meets({part(0, 1, 2), part(1, 2, 5)}, 1e-3);
    truth.speed = 2;
    a.add(truth, answer({part(0, 1, 2), part(1, 2, 5.001)}));
    CHECK(a.decided == 1);
    CHECK(a.wrong == 0);
    REQUIRE(a.error_mm.count() == 4);
    CHECK(a.error_mm.worst() == Approx(0.002));
    CHECK(a.error_ulp.worst() == Approx(2));
    CHECK(a.error_ulp.quantile(0.75) == 0);
    CHECK(a.error_ulp.quantile(1) == Approx(2).epsilon(0.016));

    a.add(truth, answer({part(0, 1, 1.9), part(1, 2, 5)}));  // a gap that is not there
    a.add(truth, answer({part(0, 1, 5)}));
    a.add(truth, answer({}));
    CHECK(a.wrong == 3);
    CHECK(a.error_mm.count() == 4);

    truth.out_unit[1] = 0;  // moved by the file's rule
    a.add(truth, answer({part(0, 1, 2), part(1, 2, 7)}));
    CHECK(a.rule_ends == 1);
    CHECK(a.error_ulp.worst() == Approx(2));

    truth.verdict = TrueRay::Verdict::tie;
    a.add(truth, answer({}));
    truth.verdict = TrueRay::Verdict::rule;
    a.add(truth, answer({}));
    CHECK(a.rays == 7);
    CHECK(a.decided == 5);
    CHECK(a.ties == 1);
    CHECK(a.rule == 1);
    CHECK(a.wrong == 3);
}

TEST_CASE("what lies behind a ray's start is no part of its sequence") {
    const Sequence s = sequence_of(answer({part(3, -5, -1), part(0, -1, 2), part(1, 4, 5)}));
    REQUIRE(s.size() == 3);
    CHECK(s[0].region == 0);
    CHECK(s[1] == Stretch{Stretch::gap, 2, 4});
}

TEST_CASE("the truth knows what is decided, what is a tie and what a file's tolerance makes of it") {
    const std::vector<Ray> rays = {
        {{-9, 0.3, 0.2}, {2, 0, 0}},  // through both boxes and the ball
        {{10, 1, -5}, {0, 0, 1}},     // beside the ball: rounding decides
        {{-9, 2.5, 0}, {1, 0, 0}},    // through a gap of 0.25
    };
    const std::vector<TrueRay> plain = true_rays(some_scene(0), {}, rays);
    CHECK(plain[0].verdict == TrueRay::Verdict::decided);
    REQUIRE(plain[0].sequence.size() == 4);
    CHECK(plain[0].sequence[1].in == 4.5);
    CHECK(plain[0].speed == 2);
    // One unit in the last place of some 10 to 20 mm, not more than a few times that head-on.
    CHECK(plain[0].in_unit[0] > 1e-16);
    CHECK(plain[0].in_unit[0] < 1e-13);
    CHECK(plain[0].in_unit[3] >= plain[0].in_unit[0]);  // the ball is met at a slant
    CHECK(plain[1].verdict == TrueRay::Verdict::tie);
    CHECK(plain[2].verdict == TrueRay::Verdict::decided);

    const std::vector<TrueRay> coarse = true_rays(some_scene(0.5), {}, rays);
    CHECK(coarse[0].verdict == TrueRay::Verdict::decided);
    CHECK(coarse[2].verdict == TrueRay::Verdict::rule);
}

TEST_CASE("where rounding decides between two balls of one region, a ray is a tie") {
    // A ball far away makes the moves 10^-9 long; the two overlap by 10^-11, so that between them every ray meets one.
    const char* path = "chart_test_balls.json";
    std::ofstream(path) << R"({"csgrt": 1, "units": "mm", "solids": {
        "left": {"type": "sphere", "center": [-0.99999999999, 0, 0], "radius": 1},
        "right": {"type": "sphere", "center": [0.99999999999, 0, 0], "radius": 1},
        "far": {"type": "sphere", "center": [1e6, 0, 0], "radius": 1}},
        "combinations": {"both": {"region": true, "tree": {"union": ["left", "right", "far"]}}}})";
    const Scene scene = load_scene(path);
    std::remove(path);
    const std::vector<TrueRay> truth = true_rays(scene, {}, {{{0, 0, -5}, {0, 0, 1}}, {{0.25, 0, -5}, {0, 0, 1}}});
    REQUIRE(truth[0].sequence.size() == 1);
    CHECK(truth[0].verdict == TrueRay::Verdict::tie);
    CHECK(truth[0].first_verdict == TrueRay::Verdict::tie);
    CHECK(truth[1].verdict == TrueRay::Verdict::decided);
}

TEST_CASE("first hits are held against the first region and where it begins, and what meets nothing counts, too") {
    Accuracy a;
    TrueRay truth = meets({part(2, 1, 2), part(1, 2, 5)}, 1e-3);
    a.add(truth, answer({part(2, 1.001, 9)}), Mode::first_hits);  // where it ends is not asked
    CHECK(a.decided == 1);
    CHECK(a.wrong == 0);
    REQUIRE(a.error_mm.count() == 1);
    CHECK(a.error_mm.worst() == Approx(0.001));
    a.add(truth, answer({part(1, 1, 2)}), Mode::first_hits);
    a.add(truth, answer({}), Mode::first_hits);
    CHECK(a.wrong == 2);

    const TrueRay nothing = meets({}, 1e-3);
    a.add(nothing, answer({}), Mode::first_hits);
    a.add(nothing, answer({part(1, -3, -2)}), Mode::first_hits);  // behind the start
    CHECK(a.wrong == 2);
    a.add(nothing, answer({part(0, 1, 2)}), Mode::first_hits);
    CHECK(a.wrong == 3);
    CHECK(a.decided == 6);

    const TrueRay within = meets({part(0, -1, 4)}, 1e-3);  // the ray starts in it: where it began is not asked
    a.add(within, answer({part(0, 0, 4)}), Mode::first_hits);
    CHECK(a.wrong == 3);
    CHECK(a.error_mm.count() == 1);

    // What rounding decides behind the first region is no matter of first hits.
    truth.verdict = TrueRay::Verdict::tie;
    a.add(truth, answer({part(2, 1, 2)}), Mode::first_hits);
    CHECK(a.ties == 0);
    truth.first_verdict = TrueRay::Verdict::tie;
    a.add(truth, answer({part(2, 1, 2)}), Mode::first_hits);
    CHECK(a.ties == 1);

    a.add_unanswered(5);
    CHECK(a.unanswered == 5);
    CHECK(a.rays == 14);
    CHECK(a.decided == 8);
}

TEST_CASE("a wrong operator shows in the count of wrong rays, in both modes") {
    const auto scene_with = [](const char* op) {
        const std::string text = std::string(R"({"csgrt": 1, "units": "mm", "solids": {
            "a": {"type": "box", "low": [-4, -2, -2], "high": [4, 2, 2]},
            "b": {"type": "box", "low": [-8, -1, -2], "high": [0, 1, 2]}}, "combinations": {
            "r": {"region": true, "tree": {")") +
                                 op + R"(": ["a", "b"]}}}})";
        const char* path = "chart_test_planted.json";
        std::ofstream(path) << text;
        const Scene scene = load_scene(path);
        std::remove(path);
        return scene;
    };
    std::vector<Ray> rays;  // 10 beside the second box, 10 through it, 5 that meet nothing
    for (int i = 0; i < 25; ++i) rays.push_back({{-20, (i < 10 ? 1.5 : i < 20 ? 0.5 : 3), 0.01 * i}, {1, 0, 0}});
    const std::vector<TrueRay> truth = true_rays(scene_with("difference"), {}, rays);
    Settings settings;
    settings.reference = true;
    for (const Mode mode : {Mode::first_hits, Mode::every_partition}) {
        Accuracy right, planted;
        const std::vector<RayPartitions> as_it_is = Renderer(scene_with("difference"), {}, settings).shoot(rays);
        const std::vector<RayPartitions> as_union = Renderer(scene_with("union"), {}, settings).shoot(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            right.add(truth[i], as_it_is[i], mode);
            planted.add(truth[i], as_union[i], mode);
        }
        CHECK(right.wrong == 0);
        CHECK(right.decided == 25);
        // One region either way, which begins 8 mm before where it should.
        CHECK(planted.wrong == 0);
        CHECK(planted.misplaced == 10);
        CHECK(planted.error_mm.worst() == 8);
        CHECK(right.misplaced == 0);
        CHECK(right.error_mm.worst() == 0);
    }
}

TEST_CASE("errors are counted by size, and their quantiles are rounded up by 1.6 % at most") {
    Errors errors;
    CHECK(errors.quantile(0.5) == 0);
    std::vector<double> all = {0, 0, 1e-300, 3e-17, 1, 1.5, 1.999, 2, 7e5, 0x1p-1074};
    for (const double e : all) errors.add(e);
    for (const double share : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
        const double exact = quantile(all, share);
        CHECK(errors.quantile(share) >= exact);
        CHECK(errors.quantile(share) <= std::max(1.016 * exact, 0x1p-1073));
    }
    CHECK(errors.worst() == 7e5);
    Errors more;
    more.add(HUGE_VAL);
    more += errors;
    CHECK(more.count() == 11);
    CHECK(more.quantile(1) == HUGE_VAL);
    CHECK(more.quantile(10.0 / 11) == Approx(7e5).epsilon(0.016));
}

TEST_CASE("intervals have the values of their formulas") {
    // Wilson: 0 of n is up to z^2 / (n + z^2); 5 of 10 and 1 of 20 as the tables have them.
    CHECK(share_interval(0, 1000).low == 0);
    CHECK(share_interval(0, 1000).high == Approx(3.841459 / 1003.841459));
    CHECK(share_interval(10, 10).high == 1);
    CHECK(share_interval(5, 10).low == Approx(0.236593).epsilon(1e-5));
    CHECK(share_interval(5, 10).high == Approx(0.763407).epsilon(1e-5));
    CHECK(share_interval(1, 20).low == Approx(0.008881).epsilon(1e-3));
    CHECK(share_interval(1, 20).high == Approx(0.236131).epsilon(1e-4));
    CHECK(share_interval(0, 0).high == 1);

    const auto first = [](int n) {
        std::vector<double> values;
        for (int i = n; i > 0; --i) values.push_back(i);
        return median_interval(values);
    };
    CHECK(first(0).high == 0);
    CHECK(first(5).low == 1);  // 5 cannot tell: all of them
    CHECK(first(5).high == 5);
    CHECK(first(8).low == 1);  // tables of order statistics: 8: 1 and 8; 9: 2 and 8; 20: 6 and 15; 101: 41 and 61
    CHECK(first(9).low == 2);
    CHECK(first(9).high == 8);
    CHECK(first(20).low == 6);
    CHECK(first(20).high == 15);
    CHECK(first(101).low == 41);
    CHECK(first(101).high == 61);
}

namespace {

/// Two scenes: one judged in pieces of 2,048 rays, and some of few rays that share a piece.
ChartWorkload some_workload() {
    ChartWorkload workload{"a workload", "scenes", {}};
    const auto rays = [](int count) {
        std::vector<Ray> all;
        for (int i = 0; i < count; ++i) all.push_back({{-9, -2.0 + 6.0 * i / count, 0.2}, {2, 0, 0}});
        return all;
    };
    workload.tasks.push_back({some_scene(0), {}, rays(3000)});
    workload.tasks.push_back({some_scene(0.5), {}, rays(5)});
    workload.tasks.push_back({some_scene(0), {}, rays(7)});
    return workload;
}

std::string contents(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool same(const TrueRay& a, const TrueRay& b) {
    return a.verdict == b.verdict && a.first_verdict == b.first_verdict && a.sequence == b.sequence &&
           a.speed == b.speed && a.in_unit == b.in_unit && a.out_unit == b.out_unit;
}

}  // namespace

TEST_CASE("the truth on disk is the truth, is made in parts, and is made anew where it is not sound") {
    namespace fs = std::filesystem;
    const fs::path folder = "chart_test_truth";
    fs::remove_all(folder);
    const ChartWorkload workload = some_workload();
    const auto now = [] { return TruthMaker::Clock::now(); };

    // No time: nothing is made. Then all of it.
    Progress progress = TruthMaker(workload, folder.string()).make(now());
    CHECK(progress.done == 0);
    CHECK(progress.all == 3012);
    TruthMaker maker(workload, folder.string());
    progress = maker.make();
    CHECK(progress.done == 3012);
    const Truth truth = maker.take();
    REQUIRE(truth.size() == 3);
    std::vector<fs::path> pieces;
    for (const auto& entry : fs::directory_iterator(folder)) pieces.push_back(entry.path());
    std::sort(pieces.begin(), pieces.end());
    REQUIRE(pieces.size() == 3);

    const auto require_truth = [&](TruthMaker& other) {
        const Truth read = other.take();
        for (std::size_t task = 0; task < truth.size(); ++task) {
            const std::vector<TrueRay> made = true_rays(workload.tasks[task].scene, {}, workload.tasks[task].rays);
            REQUIRE(read[task].size() == made.size());
            for (std::size_t i = 0; i < made.size(); ++i) REQUIRE(same(read[task][i], made[i]));
        }
    };
    TruthMaker reader(workload, folder.string());
    CHECK(reader.make(now()).done == 3012);  // all is read, and nothing made
    require_truth(reader);

    // Goes on where it was: with one piece gone, that one is left.
    fs::remove(pieces[1]);
    CHECK(TruthMaker(workload, folder.string()).make(now()).done == 3012 - 952);
    TruthMaker next(workload, folder.string());
    CHECK(next.make().done == 3012);
    require_truth(next);

    const std::string whole = contents(pieces[1]);
    const auto spoil = [&](const std::string& bytes) { std::ofstream(pieces[1], std::ios::binary) << bytes; };
    std::string damaged = whole;
    damaged[whole.size() / 2] ^= 1;
    for (const std::string& bytes : {whole.substr(0, whole.size() - 1), whole.substr(0, 10), std::string(), damaged,
                                     std::string("something else altogether"), contents(pieces[0])}) {
        spoil(bytes);
        CHECK(TruthMaker(workload, folder.string()).make(now()).done == 3012 - 952);
        CHECK(TruthMaker(workload, folder.string()).make().done == 3012);
        CHECK(contents(pieces[1]) == whole);
    }

    // Another scene and other rays have another truth.
    ChartWorkload other = some_workload();
    other.tasks[1].rays[2].origin.y += 1e-9;
    CHECK(TruthMaker(other, folder.string()).make(now()).done == 3000);
    other = some_workload();
    other.tasks[0].scene = some_scene(0.25);
    CHECK(TruthMaker(other, folder.string()).make(now()).done == 12);
    fs::remove_all(folder);
}

TEST_CASE("what is wrong with a file of the truth is told") {
    const std::vector<TrueRay> rays = {meets({part(0, 1, 2), part(1, 2, 5)}, 1e-3), meets({}, 1)};
    const std::string bytes = to_bytes(rays, 77);
    std::string fault;
    const auto read = from_bytes(bytes, 77, fault);
    REQUIRE(read);
    CHECK(same(read->front(), rays.front()));
    CHECK(read->back().sequence.empty());
    CHECK_FALSE(from_bytes(bytes, 78, fault));
    CHECK(fault == "it was made of other scenes or rays");
    CHECK_FALSE(from_bytes(bytes.substr(0, bytes.size() - 3), 77, fault));
    CHECK(fault == "it is cut off or damaged");
    CHECK_FALSE(from_bytes(bytes.substr(0, 12), 77, fault));
    CHECK(fault == "it is cut off");
    CHECK_FALSE(from_bytes("{}", 77, fault));
    CHECK(fault == "it is no file of the chart's truth");
    std::string older = bytes;
    older[8] ^= 0x40;
    CHECK_FALSE(from_bytes(older, 77, fault));
    CHECK(fault == "another version of csgrt_chart made it");
}

namespace {

/// Answers as the reference does, with faults that can be seen. Its knob leaves out what is thinner.
class FakeTracer : public Tracer {
public:
    FakeTracer(const Subject& subject, const TraceOptions& options)
        : renderer_(subject.scene, subject.objects, on_reference()), options_(options) {}
    std::vector<Answer> trace(const std::vector<Ray>& rays) override {
        std::vector<Answer> answers;
        for (const RayPartitions& found : renderer_.shoot(rays)) {
            Answer answer;
            for (const Partition& p : found.partitions)
                if (p.out - p.in > options_.knob) answer.stretches.push_back({p.region, p.in, p.out});
            if (options_.first_hits && answer.stretches.size() > 1) answer.stretches.resize(1);
            answer.answered = answer.stretches.size() < 3;
            answers.push_back(answer);
        }
        return answers;
    }
    double seconds() const override { return 1e-3; }
    std::map<std::string, double> figures() const override { return {{"mesh MB", 3}}; }

private:
    static Settings on_reference() {
        Settings settings;
        settings.reference = true;
        return settings;
    }
    Renderer renderer_;
    TraceOptions options_;
};

Method fake_method() {
    Method method;
    method.name = "fake";
    method.knob = "thickness";
    method.exact = false;
    method.prepare = [](const Subject& subject, const TraceOptions& options) -> std::unique_ptr<Tracer> {
        if (subject.scene.tolerance > 0) throw Error(Status::usage, "it bears no tolerance");
        return std::make_unique<FakeTracer>(subject, options);
    };
    return method;
}

}  // namespace

TEST_CASE("a method of the laboratory: its faults are counted, and what it gives up or refuses is not judged") {
    const ChartWorkload workload = some_workload();
    TruthMaker maker(workload, "");
    maker.make();
    const Truth truth = maker.take();
    std::size_t three = 0, met = 0, rule = 0;
    for (const std::size_t task : {0u, 2u})
        for (const TrueRay& ray : truth[task]) {
            three += ray.sequence.size() == 4;  // both boxes, the gap and the ball
            met += ray.verdict == TrueRay::Verdict::decided && !ray.sequence.empty() && ray.sequence.size() < 4;
        }
    for (const TrueRay& ray : truth[1]) rule += ray.verdict == TrueRay::Verdict::rule;
    CHECK(three > 100);
    CHECK(met > 100);
    CHECK(rule == 1);
    TrialOptions options;
    options.size = 16;
    const Method method = fake_method();
    const auto row_of = [&](double knob, Mode mode) {
        const std::unique_ptr<Trial> trial = try_method(method, knob, mode, workload, truth, options);
        for (int i = 0; i < 4; ++i) trial->frame(i > 0);
        return trial->rows().front();
    };
    const Row right = row_of(0, Mode::every_partition);
    CHECK(right.error.empty());
    CHECK(right.accuracy.rays == 3012);
    CHECK(right.accuracy.unanswered == three + 5);
    CHECK(right.accuracy.wrong == 0);
    CHECK(right.accuracy.decided > 1000);
    REQUIRE(right.refusals.size() == 1);
    CHECK(right.refusals.at("it bears no tolerance") == 5);
    CHECK(right.figures.at("mesh MB") == 3);
    CHECK(right.timed_rays == 16 * 16);
    CHECK(right.ns_per_ray == Approx(1e6 / 256));
    CHECK(right.variant == "fake 0");

    // Nothing is as thick as that: all that meets something is wrong. All rays are answered, with nothing.
    const Row coarse = row_of(100, Mode::every_partition);
    CHECK(coarse.accuracy.unanswered == 5);
    CHECK(coarse.accuracy.wrong > met);
    const Row first = row_of(0, Mode::first_hits);
    CHECK(first.accuracy.unanswered == 5);
    CHECK(first.accuracy.wrong == 0);
    CHECK(first.mode == Mode::first_hits);
}

TEST_CASE("a variant: first hits and every partition, its times, and its faults") {
    const ChartWorkload workload = some_workload();
    TruthMaker maker(workload, "");
    maker.make();
    const Truth truth = maker.take();
    TrialOptions options;
    options.size = 16;
    Variant variant{"reference", {}};
    variant.settings.reference = true;
    const auto rows_of = [&] {
        const std::unique_ptr<Trial> trial = try_variant(variant, workload, truth, options);
        for (int i = 0; i < 4; ++i) trial->frame(i > 0);
        return trial->rows();
    };
    std::vector<Row> rows = rows_of();
    REQUIRE(rows.size() == 2);
    for (const Row& row : rows) {
        CHECK(row.accuracy.wrong == 0);
        CHECK(row.accuracy.rays == 3012);
        CHECK(row.device == "reference");
    }
    // A tolerance as thick as the gap: wrong on the rays through it where the file has none.
    variant.settings.tolerance_rule = Tolerance::length;
    variant.settings.tolerance = 0.5;
    rows = rows_of();
    CHECK(rows[0].accuracy.wrong == 0);
    CHECK(rows[1].accuracy.wrong > 100);
    variant.settings = with_methods({.contraction = true}, variant.settings);  // which the reference has not
    rows = rows_of();
    CHECK(rows[0].error.find("contraction") != std::string::npos);
    CHECK(rows[0].accuracy.rays == 0);
}

TEST_CASE("totals take all rays together, and times where every method has one") {
    Report report;
    report.device_type = "cpu";
    const auto row = [&](const char* variant, const char* workload, std::size_t wrong, double ns) {
        Row r;
        r.variant = variant;
        r.workload = workload;
        r.family = workload == std::string("c") ? "stress" : "models";
        r.accuracy.rays = r.accuracy.decided = 100;
        r.accuracy.wrong = wrong;
        r.accuracy.error_mm.add(static_cast<double>(wrong));
        r.accuracy.error_ulp.add(static_cast<double>(wrong));
        r.ns_per_ray = ns;
        r.ns = {0.5 * ns, 2 * ns};
        report.rows.push_back(r);
    };
    row("one", "a", 0, 10);
    row("one", "b", 1, 40);
    row("one", "c", 0, 0);
    row("two", "a", 0, 5);
    row("two", "b", 2, 5);
    row("two", "c", 0, 0);
    row("three", "b", 0, 80);
    report.rows.push_back(report.rows.front());
    report.rows.back().mode = Mode::first_hits;
    std::vector<Total> all = totals(report);
    REQUIRE(all.size() == 4);
    CHECK(all[0].row.ns_per_ray == Approx(20));
    CHECK(all[0].row.ns.low == Approx(10));
    CHECK(all[0].row.ns.high == Approx(40));
    CHECK(all[0].of_default == Approx(1));
    CHECK(all[0].timed_on == 2);
    CHECK(all[0].row.accuracy.decided == 300);
    CHECK(all[1].row.accuracy.wrong == 2);
    CHECK(all[1].row.accuracy.error_ulp.worst() == 2);
    CHECK(all[1].of_default == Approx(0.25));
    CHECK(all[2].row.ns_per_ray == 0);  // it lacks a workload: beside the default on the one that it has
    CHECK(all[2].of_default == Approx(2));
    CHECK(all[3].row.mode == Mode::first_hits);

    const std::vector<Total> families = totals(report, true);
    REQUIRE(families.size() == 6);
    CHECK(families[0].row.family == "models");
    CHECK(families[0].row.accuracy.decided == 200);
    CHECK(families[1].row.family == "stress");
    CHECK(families[1].row.accuracy.decided == 100);
    CHECK(families[1].row.ns_per_ray == 0);

    // Beside another program's times only where that has some, too; those of other devices do not matter.
    report.anchors = {{"other", "cpu", {{"b", 3.0}}}, {"elsewhere", "gpu", {}}};
    CHECK(timed_workloads(report) == std::vector<std::string>{"b"});
    CHECK(totals(report)[0].row.ns_per_ray == Approx(40));
    report.anchors[0].ms.clear();
    CHECK(totals(report)[0].row.ns_per_ray == Approx(20));
}

TEST_CASE("the chart's file has every figure, is JSON whatever was measured, and is written whole or not at all") {
    Report report;
    report.device = "a \"device\"";
    report.rays = 7;
    Row row;
    row.variant = "default";
    row.workload = "w";
    row.family = "stress";
    row.accuracy.rays = 11;
    row.accuracy.decided = 8;
    row.accuracy.ties = 3;
    row.accuracy.wrong = 2;
    row.accuracy.misplaced = 1;
    for (const double error : {0.5, HUGE_VAL}) row.accuracy.error_mm.add(error);
    for (const double error : {1.0, 2.0}) row.accuracy.error_ulp.add(error);
    row.ns_per_ray = 12.5;
    row.frame_ms = 3;
    row.ns = {12, 13};
    row.knob = "steps";
    row.knob_value = 16;
    row.accuracy.rays = 13;
    row.accuracy.unanswered = 2;
    row.refusals["too \"deep\""] = 2;
    Row broken;
    broken.variant = "broken";
    broken.workload = "w";
    broken.error = "no \n memory";
    report.rows = {row, broken};
    const nlohmann::json json = nlohmann::json::parse(to_json(report));
    CHECK(json["device"] == report.device);
    CHECK(json["rays"] == 7);
    const nlohmann::json& first = json["results"][0];
    CHECK(first["variant"] == "default");
    CHECK(first["workload"] == "w");
    CHECK(first["family"] == "stress");
    CHECK(first["decided"] == 8);
    CHECK(first["ties"] == 3);
    CHECK(first["mode"] == "every partition");
    CHECK(first["knob_value"] == 16);
    CHECK(first["answered_share"] == Approx(11.0 / 13));
    CHECK(first["refusals"][0]["why"] == "too \"deep\"");
    CHECK(first["wrong_ppm"] == 250000);
    CHECK(first["wrong_ppm_interval"][1] == Approx(1e6 * share_interval(2, 8).high));
    CHECK(first["ns_per_ray_interval"][0] == 12);
    CHECK(first["misplaced_ppm"] == 125000);
    CHECK(first["error_mm"]["worst"].is_null());
    CHECK(first["error_ulp"]["worst"] == 2);
    CHECK(first["ns_per_ray"] == 12.5);
    CHECK(first["frame_ms"] == 3);
    CHECK(json["results"][1]["error"] == "no \n memory");
    CHECK(json["totals"][1]["wrong_ppm"].is_null());  // nothing was decided

    // Of an unfinished measurement: the same rows, whole; nothing of another one's, or of what is damaged.
    std::string fault;
    const std::string kept = rows_to_json(report.rows, "key");
    const auto rows = rows_from_json(kept, "key", fault);
    REQUIRE(rows);
    Report again = report;
    again.rows = *rows;
    CHECK(to_json(again) == to_json(report));
    CHECK(rows_to_json(*rows, "key") == kept);
    CHECK_FALSE(rows_from_json(kept, "another", fault));
    CHECK(fault == "it was measured otherwise");
    CHECK_FALSE(rows_from_json(kept.substr(0, kept.size() / 2), "key", fault));
    CHECK_FALSE(rows_from_json(R"({"key": "key", "rows": [{"names": []}]})", "key", fault));
    CHECK(fault == "it is damaged");

    CHECK_THROWS_AS(write_whole("text", "no/such/folder/chart.json"), Error);
    write_whole("text", "chart_test.json");
    std::string text;
    std::ifstream("chart_test.json") >> text;
    CHECK(text == "text");
    std::remove("chart_test.json");
}
