// csgrt_chart: every variant on every workload, how fast and how exact; one JSON file.
//
//   csgrt_chart [--device CHOICE] [--json FILE] [--rays N] [--size N] [--frames N] [--models FOLDER] [--scenes FOLDER]
//               [--workloads A,B] [--variants A,B] [--device-scenes N]
//
// --rays: judged of each workload, about (300). --size, --frames: of the timed pictures (512, 5).
//
// Timed pictures are shot on the device; the judged rays, too, where the workload is timed. The stress families are
// many small scenes, each of which would need its kernels compiled, so there the reference answers, which has the
// device's very bits; only contraction, which it has not, goes to the device.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <sstream>

#include <csgrt/csgrt.hpp>

#include "bench/workloads.hpp"
#include "cli/cache_folder.hpp"
#include "report.hpp"
#include "tasks.hpp"
#include "truth.hpp"
#include "variants.hpp"

namespace {

using namespace csgrt;
using namespace csgrt::bench;

struct Options {
    std::string device, json = "chart.json";
    Sample sample{"../shared/brlcad", "scenes", 300, {}};
    std::vector<std::string> variants;
    int size = 512, frames = 5;
    std::size_t device_scenes = std::numeric_limits<std::size_t>::max();
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
double kernels_ms(const Statistics& s) { return s.ms.device(); }

/// One variant on one workload: its answers first, then its times.
class Trial {
public:
    Trial(const Variant& variant, const ChartWorkload& workload, const std::vector<std::vector<TrueRay>>& truth,
          const Options& options)
        : workload_(workload), size_(options.size) {
        row_.variant = variant.name;
        row_.workload = workload.name;
        row_.family = workload.family;
        settings_ = variant.settings;
        settings_.device = options.device;
        settings_.wait_for_device = true;
        settings_.reference = settings_.reference || (!workload.timed() && variant.on_reference());
        const std::size_t all = workload.tasks.size();
        const bool few = !workload.timed() && !settings_.reference;
        guard([&] { answer(truth, few ? std::min(all, options.device_scenes) : all); });
    }

    /// The next frame, if there are any: kernels and all of it. The first one takes memory and does not count.
    void frame(bool counts) {
        if (!renderer_) return;
        guard([&] {
            View view;
            view.camera = workload_.tasks.front().scene.camera;
            view.camera.perspective = 0;
            view.width = view.height = size_;
            renderer_->render(view);
            if (!counts) return;
            kernels_.push_back(kernels_ms(renderer_->statistics()));
            frames_.push_back(renderer_->statistics().ms.frame);
        });
    }

    Row result() {
        if (!kernels_.empty()) {
            row_.ns_per_ray = 1e6 * quantile(kernels_, 0.5) / (static_cast<double>(size_) * size_);
            row_.frame_ms = quantile(frames_, 0.5);
        }
        return std::move(row_);
    }

private:
    /// What a method cannot do is its result; that there is no device is nobody's.
    template <class Work>
    void guard(const Work& work) {
        try {
            work();
        } catch (const Error& error) {
            if (error.status() == Status::no_device) throw;
            row_.accuracy = {};
            row_.error = error.what();
            renderer_.reset();
            kernels_.clear();
        }
    }

    void answer(const std::vector<std::vector<TrueRay>>& truth, std::size_t tasks) {
        for (std::size_t i = 0; i < tasks; ++i) {
            const Task& task = workload_.tasks[i];
            auto renderer = std::make_unique<Renderer>(task.scene, task.objects, settings_);
            const std::vector<RayPartitions> found = renderer->shoot(task.rays);
            for (std::size_t k = 0; k < found.size(); ++k) row_.accuracy.add(truth[i][k], found[k]);
            if (!workload_.timed()) continue;
            if (settings_.reference)  // no device that would time its kernels: by the clock
                row_.ns_per_ray = 1e6 * renderer->statistics().ms.frame / static_cast<double>(task.rays.size());
            else
                renderer_ = std::move(renderer);
        }
    }

    const ChartWorkload& workload_;
    int size_;
    Settings settings_;
    Row row_;
    std::unique_ptr<Renderer> renderer_;
    std::vector<double> kernels_, frames_;
};

void print(const Row& row) {
    const Accuracy& a = row.accuracy;
    if (!row.error.empty()) {
        std::printf("  %-20s %s\n", row.variant.c_str(), row.error.c_str());
        return;
    }
    std::printf("  %-20s %7zu decided %5zu ties %4zu rule %6zu wrong %10.3g ulp (99.9 %%) %10.3g worst %10.1f ns/ray\n",
                row.variant.c_str(), a.decided, a.ties, a.rule, a.wrong, quantile(a.error_ulp, 0.999),
                quantile(a.error_ulp, 1), row.ns_per_ray);
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

std::vector<std::string> split(const std::string& list) {
    std::vector<std::string> parts;
    std::istringstream in(list);
    for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
    return parts;
}

int whole(const std::string& name, const std::string& value) {
    char* end = nullptr;
    const long number = std::strtol(value.c_str(), &end, 10);
    if (end == value.c_str() || *end != 0 || number < 1 || number > 1000000)
        throw Error(Status::usage, name + ": needs a whole number from 1 to 1000000, not " + value);
    return static_cast<int>(number);
}

Options parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (i + 1 == argc) throw Error(Status::usage, name + ": unknown, or lacks its value");
        const std::string value = argv[++i];
        if (name == "--device") {
            options.device = value;
        } else if (name == "--json") {
            options.json = value;
        } else if (name == "--rays") {
            options.sample.rays = static_cast<std::size_t>(whole(name, value));
        } else if (name == "--size") {
            options.size = whole(name, value);
        } else if (name == "--frames") {
            options.frames = whole(name, value);
        } else if (name == "--device-scenes") {
            options.device_scenes = static_cast<std::size_t>(whole(name, value));
        } else if (name == "--models") {
            options.sample.models = value;
        } else if (name == "--scenes") {
            options.sample.scenes = value;
        } else if (name == "--workloads") {
            options.sample.only = split(value);
        } else if (name == "--variants") {
            options.variants = split(value);
        } else {
            throw Error(Status::usage, name + ": unknown option");
        }
    }
    return options;
}

/// Those of the names; all if there are none.
std::vector<Variant> choose(const std::vector<std::string>& names) {
    if (names.empty()) return variants();
    std::vector<Variant> chosen;
    for (const std::string& name : names) {
        const std::vector<Variant> all = variants();
        const auto at = std::find_if(all.begin(), all.end(), [&](const Variant& v) { return v.name == name; });
        if (at == all.end())
            throw Error(Status::usage, "--variants: there is no " + name + " (bench/chart/variants.hpp)");
        chosen.push_back(*at);
    }
    return chosen;
}

DeviceInfo device_of(const Options& options) {
    // What a renderer with these settings says it runs on.
    Scene scene;
    Settings settings;
    settings.device = options.device;
    settings.wait_for_device = true;
    scene = load_scene(options.sample.scenes + "/operators.json");
    const std::string name = Renderer(scene, {}, settings).statistics().device;
    for (const DeviceInfo& info : devices())
        if (info.name == name) return info;
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    cli::ensure_cache_folder();
    try {
        const auto start = std::chrono::steady_clock::now();
        const Options options = parse(argc, argv);
        const std::vector<Variant> chosen = choose(options.variants);
        const DeviceInfo device = device_of(options);
        Report report{device.name,         device.type, version(), options.size, options.frames,
                      options.sample.rays, 0,           {},        anchors()};
        for (const ChartWorkload& workload : chart_workloads(options.sample)) {
            const auto begun = std::chrono::steady_clock::now();
            std::vector<std::vector<TrueRay>> truth;
            for (const Task& task : workload.tasks) truth.push_back(true_rays(task.scene, task.objects, task.rays));
            std::printf("%s: truth in %.1f s\n", workload.name.c_str(), seconds_since(begun));
            std::vector<Trial> trials;
            for (const Variant& variant : chosen) trials.emplace_back(variant, workload, truth, options);
            // In turn, so that whatever else the machine does slows all of them down.
            for (int i = 0; i <= options.frames; ++i)
                for (Trial& trial : trials) trial.frame(i > 0);
            for (Trial& trial : trials) {
                report.rows.push_back(trial.result());
                print(report.rows.back());
            }
        }
        report.seconds = seconds_since(start);
        if (report.rows.empty()) throw Error(Status::usage, "there is no workload to measure");
        std::printf("all, in %.0f s\n", report.seconds);
        for (const Row& row : totals(report)) print(row);
        write_whole(to_json(report), options.json);
    } catch (const Error& error) {
        std::fprintf(stderr, "csgrt_chart: %s\n", error.what());
        return static_cast<int>(error.status());
    }
    return 0;
}
