// csgrt_bench: warm frames of every workload on one device; a table on standard output, JSON on demand.
//
//   csgrt_bench [--device CHOICE] [--size N] [--frames N] [--first-hit] [--models FOLDER] [--scenes FOLDER] [--json FILE]
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "workloads.hpp"

namespace {

using namespace csgrt;

struct Options {
    std::string device, models = "../shared/brlcad", scenes = "scenes", json;
    int size = 1024, frames = 20;
    bool first_hit = false;
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

struct Result {
    const bench::Workload* workload = nullptr;
    std::size_t solids = 0, regions = 0;
    Statistics median;  ///< times: medians over the frames
};

Result measure(const bench::Workload& workload, const std::string& path, const Options& options) {
    const Scene scene = load_scene(path);
    Settings settings;
    settings.device = options.device;
    Renderer renderer(scene, workload.objects, settings);
    View view;
    view.width = view.height = options.size;
    view.every_partition = !options.first_hit;
    renderer.render(view);  // the first frame compiles kernels and takes memory
    std::vector<Statistics> frames;
    for (int i = 0; i < options.frames; ++i) {
        renderer.render(view);
        frames.push_back(renderer.statistics());
    }
    Result result;
    result.workload = &workload;
    result.solids = renderer.solids().size();
    result.regions = renderer.regions().size();
    result.median = frames.front();
    const auto take = [&](auto member) {
        std::vector<double> values;
        for (Statistics& f : frames) values.push_back(f.ms.*member);
        result.median.ms.*member = median(values);
    };
    using Times = decltype(Statistics::ms);
    for (double Times::*member : {&Times::count_hits, &Times::scan, &Times::store_segments, &Times::weave, &Times::evaluate,
                                  &Times::shade, &Times::cull_blocks, &Times::first_hits, &Times::frame})
        take(member);
    return result;
}

double device_time(const Statistics& s) {
    return s.ms.device();
}
double bytes_each(const Statistics& s) {
    return s.segments ? static_cast<double>(s.segment_bytes + s.partition_bytes) / static_cast<double>(s.segments) : 0;
}

void print(const std::vector<Result>& results, const Options& options) {
    std::printf("%s, double, %d x %d, %s, medians of %d warm frames, milliseconds of device time\n\n",
                results.empty() ? "" : results.front().median.device.c_str(), options.size, options.size,
                options.first_hit ? "first hits" : "every partition", options.frames);
    std::printf("%-16s %7s %7s %9s %9s %6s %6s %7s | %7s %6s %7s %7s %8s %6s %8s %8s | %7s %8s %8s %8s\n", "scene", "solids",
                "regions", "segments", "used", "of all", "B/seg", "MB", "count", "scan", "store", "weave", "evaluate", "shade",
                "kernels", "frame", "thesis", "BRL cpu2", "BRL pocl", "BRL H200");
    for (const Result& r : results) {
        const Statistics& s = r.median;
        std::printf("%-16s %7zu %7zu %9llu %9llu %5.1f%% %6.1f %7.1f | %7.3f %6.3f %7.3f %7.3f %8.3f %6.3f %8.3f %8.2f |",
                    r.workload->name.c_str(), r.solids, r.regions, static_cast<unsigned long long>(s.segments),
                    static_cast<unsigned long long>(s.partitions_used),
                    s.partitions_allocated ? 100.0 * static_cast<double>(s.partitions_used) / static_cast<double>(s.partitions_allocated) : 0.0,
                    bytes_each(s), static_cast<double>(s.device_bytes) / 1e6, s.ms.count_hits, s.ms.scan, s.ms.store_segments,
                    s.ms.weave, s.ms.evaluate, s.ms.shade, device_time(s), s.ms.frame);
        for (const double ms : {r.workload->thesis_ms, r.workload->brlcad_cpu_ms, r.workload->brlcad_pocl_ms, r.workload->brlcad_h200_ms}) {
            if (ms > 0) {
                std::printf(" %7.0f ", ms);
            } else {
                std::printf(" %7s ", "-");
            }
        }
        std::printf("\n");
    }
}

void write_json(const std::vector<Result>& results, const Options& options) {
    std::ofstream out(options.json);
    out << "{\"size\": " << options.size << ", \"frames\": " << options.frames << ", \"first_hit\": "
        << (options.first_hit ? "true" : "false") << ", \"workloads\": [";
    const char* separator = "\n";
    for (const Result& r : results) {
        const Statistics& s = r.median;
        out << separator << "  {\"name\": \"" << r.workload->name << "\", \"device\": \"" << s.device << "\", \"solids\": " << r.solids
            << ", \"regions\": " << r.regions << ", \"segments\": " << s.segments << ", \"partitions\": {\"used\": "
            << s.partitions_used << ", \"allocated\": " << s.partitions_allocated << "}, \"bytes_per_segment\": " << bytes_each(s)
            << ", \"device_bytes\": " << s.device_bytes << ", \"ms\": {\"count_hits\": " << s.ms.count_hits
            << ", \"scan\": " << s.ms.scan << ", \"store_segments\": " << s.ms.store_segments << ", \"weave\": " << s.ms.weave
            << ", \"evaluate\": " << s.ms.evaluate << ", \"shade\": " << s.ms.shade << ", \"frame\": " << s.ms.frame << "}}";
        separator = ",\n";
    }
    out << "\n]}\n";
    if (!out.flush()) throw Error(Status::file, options.json + ": cannot be written");
}

Options parse(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (name == "--first-hit") {
            options.first_hit = true;
            continue;
        }
        if (i + 1 == argc) throw Error(Status::usage, name + ": unknown, or lacks its value");
        const std::string value = argv[++i];
        if (name == "--device") {
            options.device = value;
        } else if (name == "--models") {
            options.models = value;
        } else if (name == "--scenes") {
            options.scenes = value;
        } else if (name == "--json") {
            options.json = value;
        } else if (name == "--size") {
            options.size = std::atoi(value.c_str());
        } else if (name == "--frames") {
            options.frames = std::max(1, std::atoi(value.c_str()));
        } else {
            throw Error(Status::usage, name + ": unknown option");
        }
    }
    return options;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Options options = parse(argc, argv);
        std::vector<Result> results;
        for (const bench::Workload& workload : bench::workloads()) {
            const bool ours = workload.file.ends_with(".json");
            const std::string path = (ours ? options.scenes : options.models) + "/" + workload.file;
            if (!std::filesystem::exists(path)) {
                std::fprintf(stderr, "%s: left out, there is no %s\n", workload.name.c_str(), path.c_str());
                continue;
            }
            results.push_back(measure(workload, path, options));
        }
        print(results, options);
        if (!options.json.empty()) write_json(results, options);
    } catch (const Error& error) {
        std::fprintf(stderr, "csgrt_bench: %s\n", error.what());
        return static_cast<int>(error.status());
    }
    return 0;
}
