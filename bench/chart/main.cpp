// csgrt_chart: every variant and every method of the laboratory on every workload, how fast and how exact; one JSON
// file. bench/chart/README.md lists the options.
//
// Timed pictures are shot on the device; the judged rays, too, where the workload is timed. The stress families are
// many small scenes, each of which would need its kernels compiled, so there the reference answers, which has the
// device's very bits; only contraction, which it has not, goes to the device.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>

#include <csgrt/csgrt.hpp>

#include "base/clock.hpp"
#include "bench/program.hpp"
#include "bench/workloads.hpp"
#include "report.hpp"
#include "tasks.hpp"
#include "trial.hpp"
#include "truth_file.hpp"
#include "variants.hpp"

namespace {

using namespace csgrt;
using namespace csgrt::bench;

struct Options {
    std::string json = "chart.json", truth;
    Sample sample{.models = "../shared/brlcad", .scenes = "scenes", .rays = 300, .only = {}};
    std::vector<std::string> variants, methods;
    bool truth_only = false;
    double minutes = 0;  ///< after which nothing more is begun; 0: as long as it takes
    int frames = 9;
    TrialOptions trial;
};

constexpr int more_is_left = 75;  ///< exit status if --minutes ended the call (EX_TEMPFAIL of sysexits.h)

void print(const Row& row) {
    const Accuracy& a = row.accuracy;
    std::printf("  %-26s %-15s ", row.variant.c_str(), name_of(row.mode));
    if (!row.error.empty())
        std::printf("%s\n", row.error.c_str());
    else
        std::printf(
            "%7zu decided %5zu ties %4zu rule %6zu given up %6zu wrong %6zu misplaced %10.3g ulp (99.9 %%) %10.3g "
            "worst %10.1f ns/ray\n",
            a.decided, a.ties, a.rule, a.unanswered, a.wrong, a.misplaced, a.error_ulp.quantile(0.999),
            a.error_ulp.worst(), row.ns_per_ray);
    std::fflush(stdout);
}

/// BRL-CAD 7.32.6, first hits, as measured beside bench/workloads.hpp.
std::vector<Anchor> anchors() {
    std::vector<Anchor> all = {{"BRL-CAD 7.32.6, CPU (2 cores)", "cpu", {}},
                               {"BRL-CAD 7.32.6, OpenCL (PoCL, 2 cores)", "cpu", {}},
                               {"BRL-CAD 7.32.6, OpenCL (H200)", "gpu", {}}};
    constexpr double Workload::*figures[] = {&Workload::brlcad_cpu_ms, &Workload::brlcad_pocl_ms,
                                             &Workload::brlcad_h200_ms};
    for (std::size_t i = 0; i < all.size(); ++i)
        for (const Workload& workload : workloads())
            if (workload.*figures[i] > 0) all[i].ms.emplace_back(workload.name, workload.*figures[i]);
    return all;
}

std::vector<Mode> modes_of(const std::string& name, const std::string& value) {
    std::vector<Mode> modes;
    for (const std::string& part : split_list(value)) {
        if (part == name_of(Mode::first_hits))
            modes.push_back(Mode::first_hits);
        else if (part == name_of(Mode::every_partition))
            modes.push_back(Mode::every_partition);
        else
            throw Error(Status::usage, name + ": there is no " + part + "; \"first hits\" or \"every partition\"");
    }
    return modes;
}

Options parse(int argc, char** argv) {
    Options o;
    OptionReader options;
    options.flag("--truth-only", o.truth_only);
    options.text("--device", o.trial.device);
    options.text("--json", o.json);
    options.number("--rays", o.sample.rays, 1, 10'000'000);
    options.text("--truth", o.truth);
    options.number("--minutes", o.minutes, 0.001, 1e6);
    options.number("--size", o.trial.size, 1, 32768);
    options.number("--deep-size", o.trial.deep_size, 1, 32768);
    options.number("--frames", o.frames, 1, 10'000'000);
    options.number("--device-scenes", o.trial.device_scenes, 1, 10'000'000);
    options.number("--method-seconds", o.trial.method_seconds, 0, 1e6);
    options.number("--method-frame", o.trial.method_frame, 0, 1e6);
    options.value("--modes", [&](const std::string& value) { o.trial.modes = modes_of("--modes", value); });
    options.value("--deep", [&](const std::string& value) {
        o.sample.deep.clear();
        for (const std::string& size : split_list(value))
            o.sample.deep.push_back(parse_number<std::uint32_t>("--deep", size, 2, 1'000'000));
    });
    options.text("--models", o.sample.models);
    options.text("--scenes", o.sample.scenes);
    options.list("--workloads", o.sample.only);
    options.list("--variants", o.variants);
    options.list("--methods", o.methods);
    options.read(argc, argv);
    if (o.truth_only && o.truth.empty())
        throw Error(Status::usage, "--truth-only: needs --truth FOLDER, where the truth goes");
    return o;
}

/// Those of the names, in their order; all if there are none, none if the only name is "none".
template <class T>
std::vector<T> choose(const std::vector<T>& all, const std::vector<std::string>& names, const char* option) {
    if (names.empty()) return all;
    if (names == std::vector<std::string>{"none"}) return {};
    std::vector<T> chosen;
    for (const std::string& name : names) {
        const auto at = std::find_if(all.begin(), all.end(), [&](const T& one) { return one.name == name; });
        if (at == all.end()) throw Error(Status::usage, std::string(option) + ": there is no " + name);
        chosen.push_back(*at);
    }
    return chosen;
}

DeviceInfo device_of(const Options& options) {
    // What a renderer with these settings says it runs on.
    Scene scene;
    Settings settings;
    settings.device = options.trial.device;
    settings.wait_for_device = true;
    scene = load_scene(options.sample.scenes + "/operators.json");
    const std::string name = Renderer(scene, {}, settings).statistics().device;
    for (const DeviceInfo& info : devices())
        if (info.name == name) return info;
    return {};
}

/// Everything that is tried on a workload.
std::vector<std::unique_ptr<Trial>> trials_of(const std::vector<Variant>& variants, const std::vector<Method>& methods,
                                              const ChartWorkload& workload, const Truth& truth,
                                              const TrialOptions& options) {
    std::vector<std::unique_ptr<Trial>> trials;
    for (const Variant& variant : variants) trials.push_back(try_variant(variant, workload, truth, options));
    for (const Method& method : methods)
        for (const Mode mode : options.modes) {
            if (!(mode == Mode::first_hits ? method.first_hits : method.every_partition)) continue;
            const std::vector<double> none{0};
            for (const double knob : method.knob.empty() ? none : method.knob_values)
                trials.push_back(try_method(method, knob, mode, workload, truth, options));
        }
    return trials;
}

/// Makes what there is not yet, until the time is over.
int make_truth(const Options& options) {
    const auto start = Clock::now();
    const auto end =
        options.minutes > 0
            ? start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(60 * options.minutes))
            : Clock::time_point::max();
    Progress sum;
    for (const WorkloadMaker& maker : chart_workloads(options.sample)) {
        const auto begun = Clock::now();
        const ChartWorkload workload = maker.make();
        const Progress progress = TruthMaker(workload, options.truth).make(end);
        std::printf("%s: %zu of %zu rays, %.1f s\n", workload.name.c_str(), progress.done, progress.all,
                    seconds_since(begun));
        std::fflush(stdout);
        sum.done += progress.done;
        sum.all += progress.all;
    }
    if (sum.done == sum.all) {
        std::printf("the truth of all %zu rays is in %s\n", sum.all, options.truth.c_str());
        return 0;
    }
    std::printf("%zu of %zu rays (%.1f %%) are in %s; the same call goes on\n", sum.done, sum.all,
                100.0 * static_cast<double>(sum.done) / static_cast<double>(sum.all), options.truth.c_str());
    return more_is_left;
}

/// How rows were measured: those of another key do not go together with ours.
std::string key_of(const Report& report, const Options& options, const std::vector<Variant>& variants) {
    std::string key = report.device + ", csgrt " + report.version + ", truth " + std::to_string(truth_version);
    for (const std::size_t number :
         {report.rays, static_cast<std::size_t>(report.size), static_cast<std::size_t>(report.frames),
          options.trial.device_scenes, static_cast<std::size_t>(options.trial.deep_size)})
        key += ", " + std::to_string(number);
    for (const double number : {options.trial.method_seconds, options.trial.method_frame})
        key += ", " + std::to_string(number);
    for (const Mode mode : options.trial.modes) key += std::string(", ") + name_of(mode);
    for (const Variant& variant : variants) key += ", " + variant.name;
    for (const Method& method : report.methods) key += ", " + method.name;
    return key;
}

/// What an earlier call that ended has measured.
std::vector<Row> earlier_rows(const std::string& path, const std::string& key) {
    std::ifstream in(path, std::ios::binary);
    if (!in) return {};
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    std::string fault;
    std::optional<std::vector<Row>> rows = rows_from_json(text, key, fault);
    if (rows) return std::move(*rows);
    std::fprintf(stderr, "%s: %s; all is measured anew\n", path.c_str(), fault.c_str());
    return {};
}

/// All rows of one workload.
std::vector<Row> rows_of(const ChartWorkload& workload, const std::vector<Variant>& variants,
                         const std::vector<Method>& methods, const Options& options) {
    const auto begun = std::chrono::steady_clock::now();
    TruthMaker truth_maker(workload, options.truth);
    truth_maker.make();
    const Truth truth = truth_maker.take();
    std::printf("%s: truth in %.1f s\n", workload.name.c_str(), seconds_since(begun));
    const std::vector<std::unique_ptr<Trial>> trials = trials_of(variants, methods, workload, truth, options.trial);
    // In turn, so that whatever else the machine does slows all of them down; in another order each time, so that none
    // always comes behind the same one. What came first was 5 % slower on a GPU.
    std::vector<Trial*> order;
    for (const std::unique_ptr<Trial>& trial : trials) order.push_back(trial.get());
    std::minstd_rand random;
    for (int i = 0; i <= options.frames; ++i) {
        for (Trial* trial : order) trial->frame(i > 0);
        std::shuffle(order.begin(), order.end(), random);
    }
    std::vector<Row> rows;
    for (const std::unique_ptr<Trial>& trial : trials)
        for (Row& row : trial->rows()) {
            print(row);
            rows.push_back(std::move(row));
        }
    return rows;
}

int measure(Options options) {
    const auto start = std::chrono::steady_clock::now();
    const DeviceInfo device = device_of(options);
    const bool is_gpu = device.type == "gpu";
    const std::vector<Variant> variants_chosen = choose(variants(), options.variants, "--variants");
    std::vector<Method> methods_chosen = choose(methods(), options.methods, "--methods");
    std::erase_if(methods_chosen, [](const Method& method) { return !method.on_chart; });
    if (options.trial.size == 0) options.trial.size = is_gpu ? 4096 : 512;
    if (options.trial.deep_size == 0) options.trial.deep_size = std::max(1, options.trial.size / 32);
    // Every variant keeps its memory while the others draw.
    if (is_gpu) options.trial.max_memory = device.memory / (variants_chosen.size() + 2);
    Report report{device.name,         device.type, version(), options.trial.size, options.frames,
                  options.sample.rays, 0,           {},        anchors(),          methods_chosen};
    const std::string key = key_of(report, options, variants_chosen), unfinished = options.json + ".unfinished";
    const std::vector<Row> earlier = earlier_rows(unfinished, key);
    std::size_t made = 0, left = 0;
    for (const WorkloadMaker& maker : chart_workloads(options.sample)) {
        std::vector<Row> rows;
        std::copy_if(earlier.begin(), earlier.end(), std::back_inserter(rows),
                     [&](const Row& row) { return row.workload == maker.name; });
        if (rows.empty() && made > 0 && options.minutes > 0 && seconds_since(start) >= 60 * options.minutes) {
            ++left;
            continue;
        }
        const bool is_new = rows.empty();
        if (is_new) rows = rows_of(maker.make(), variants_chosen, methods_chosen, options);
        std::move(rows.begin(), rows.end(), std::back_inserter(report.rows));
        if (is_new) write_whole(rows_to_json(report.rows, key), unfinished);
        made += is_new;
    }
    if (left > 0) {
        std::printf("%zu workloads are left; the same call goes on\n", left);
        return more_is_left;
    }
    report.seconds = seconds_since(start);
    if (report.rows.empty()) throw Error(Status::usage, "there is nothing to measure");
    std::printf("all, in %.0f s\n", report.seconds);
    for (const Total& total : totals(report)) print(total.row);
    write_whole(to_json(report), options.json);
    std::remove(unfinished.c_str());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("csgrt_chart", [&] {
        const Options options = parse(argc, argv);
        return options.truth_only ? make_truth(options) : measure(options);
    });
}
