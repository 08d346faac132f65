// What the chart of speed against accuracy counts, and what it writes.
#include <cmath>
#include <cstdio>
#include <fstream>

#include <csgrt/csgrt.hpp>
#include <nlohmann/json.hpp>

#include "bench/chart/report.hpp"
#include "bench/chart/truth.hpp"
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
    REQUIRE(a.error_mm.size() == 4);
    CHECK(quantile(a.error_mm, 1) == Approx(0.002));
    CHECK(quantile(a.error_ulp, 1) == Approx(2));
    CHECK(quantile(a.error_ulp, 0.75) == 0);

    a.add(truth, answer({part(0, 1, 1.9), part(1, 2, 5)}));  // a gap that is not there
    a.add(truth, answer({part(0, 1, 5)}));
    a.add(truth, answer({}));
    CHECK(a.wrong == 3);
    CHECK(a.error_mm.size() == 4);

    truth.out_unit[1] = 0;  // moved by the file's rule
    a.add(truth, answer({part(0, 1, 2), part(1, 2, 7)}));
    CHECK(a.rule_ends == 1);
    CHECK(quantile(a.error_ulp, 1) == Approx(2));

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

TEST_CASE("totals take all rays together, and times where every method has one") {
    Report report;
    report.device_type = "cpu";
    const auto row = [&](const char* variant, const char* workload, std::size_t wrong, double ns) {
        Row r;
        r.variant = variant;
        r.workload = workload;
        r.accuracy.rays = r.accuracy.decided = 100;
        r.accuracy.wrong = wrong;
        r.accuracy.error_mm = r.accuracy.error_ulp = {static_cast<double>(wrong)};
        r.ns_per_ray = ns;
        report.rows.push_back(r);
    };
    row("one", "a", 0, 10);
    row("one", "b", 1, 40);
    row("one", "c", 0, 1);
    row("two", "a", 0, 5);
    row("two", "b", 2, 5);
    row("two", "c", 0, 0);  // not timed
    std::vector<Row> all = totals(report);
    REQUIRE(all.size() == 2);
    CHECK(all[0].ns_per_ray == Approx(20));
    CHECK(all[0].accuracy.decided == 300);
    CHECK(all[1].accuracy.wrong == 2);
    CHECK(quantile(all[1].accuracy.error_ulp, 1) == 2);

    // Beside another program's times only where that has some, too; those of other devices do not matter.
    report.anchors = {{"other", "cpu", {{"b", 3.0}}}, {"elsewhere", "gpu", {}}};
    CHECK(timed_workloads(report) == std::vector<std::string>{"b"});
    CHECK(totals(report)[0].ns_per_ray == Approx(40));
    report.anchors[0].ms.clear();
    CHECK(totals(report)[0].ns_per_ray == Approx(20));
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
    row.accuracy.error_mm = {0.5, HUGE_VAL};
    row.accuracy.error_ulp = {1, 2};
    row.ns_per_ray = 12.5;
    row.frame_ms = 3;
    report.rows = {row, {"broken", "w", "stress", {}, 0, 0, "no \n memory"}};
    const nlohmann::json json = nlohmann::json::parse(to_json(report));
    CHECK(json["device"] == report.device);
    CHECK(json["rays"] == 7);
    const nlohmann::json& first = json["results"][0];
    CHECK(first["variant"] == "default");
    CHECK(first["workload"] == "w");
    CHECK(first["family"] == "stress");
    CHECK(first["decided"] == 8);
    CHECK(first["ties"] == 3);
    CHECK(first["wrong_ppm"] == 250000);
    CHECK(first["error_mm"]["worst"].is_null());
    CHECK(first["error_ulp"]["worst"] == 2);
    CHECK(first["ns_per_ray"] == 12.5);
    CHECK(first["frame_ms"] == 3);
    CHECK(json["results"][1]["error"] == "no \n memory");
    CHECK(json["totals"][1]["wrong_ppm"].is_null());  // nothing was decided

    CHECK_THROWS_AS(write_whole("text", "no/such/folder/chart.json"), Error);
    write_whole("text", "chart_test.json");
    std::string text;
    std::ifstream("chart_test.json") >> text;
    CHECK(text == "text");
    std::remove("chart_test.json");
}
