#include <cmath>
#include <cstdio>

#include "figures.hpp"
#include "workloads.hpp"

namespace csgrt::bench {

namespace {

const Workload* workload_of(const Figures& f) {
    for (const Workload& workload : workloads())
        if (workload.name == f.workload) return &workload;
    return nullptr;
}

void print_head(const Figures& f) {
    std::printf("\n%s, double, %d x %d, %s, medians of %d warm frames%s, ms\n", f.device.c_str(), f.size, f.size,
                f.mode.c_str(), f.frames, f.orbit ? " around the model" : "");
    std::printf("%-16s %8s %8s %9s %6s %6s %8s %6s |", "scene", "solids", "regions", "segments", "used", "B/seg", "MB",
                "B/ray");
    for (const Stage& stage : stages) std::printf(" %10s", stage.name);
    std::printf(" %8s %8s", "kernels", "frame");
    if (f.orbit) std::printf(" %8s", "worst");
    std::printf(" | %8s %8s %8s", "compile", "build", "first");
    // BRL-CAD 7.32.6: see workloads.hpp.
    std::printf(" | %8s %8s %8s\n", "BRL cpu2", "BRL pocl", "BRL H200");
}

void print_figure(double ms) {
    if (ms > 0) {
        std::printf(" %8.0f", ms);
    } else {
        std::printf(" %8s", "-");
    }
}

double share(std::uint64_t part, std::uint64_t whole) {
    return whole ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

bool same_run(const Figures& a, const Figures& b) {
    return a.device == b.device && a.mode == b.mode && a.size == b.size && a.frames == b.frames && a.orbit == b.orbit;
}

}  // namespace

void print(const std::vector<Figures>& all) {
    const Figures* before = nullptr;
    for (const Figures& f : all) {
        if (before == nullptr || !same_run(*before, f)) print_head(f);
        before = &f;
        std::printf("%-16s %8llu %8llu %9llu %5.1f%% %6.1f %8.1f %6.1f |", f.workload.c_str(),
                    static_cast<unsigned long long>(f.solids), static_cast<unsigned long long>(f.regions),
                    static_cast<unsigned long long>(f.segments), 100 * share(f.partitions_used, f.partitions_allocated),
                    share(f.segment_and_partition_bytes, f.segments), static_cast<double>(f.device_bytes) / 1e6,
                    f.bytes_per_ray());
        for (const Stage& stage : stages) std::printf(" %10.3f", f.time(stage.name));
        std::printf(" %8.3f %8.2f", f.time("kernels"), f.time("frame"));
        if (f.orbit) std::printf(" %8.2f", f.time("worst"));
        std::printf(" | %8.1f %8.1f %8.1f |", f.time("compile"), f.time("build"), f.time("first"));
        const Workload* workload = workload_of(f);
        for (double Workload::*figure :
             {&Workload::brlcad_cpu_ms, &Workload::brlcad_pocl_ms, &Workload::brlcad_h200_ms})
            print_figure(workload != nullptr && f.size == 1024 ? workload->*figure : 0);
        std::printf("\n");
    }
}

void print_comparison(const std::vector<Figures>& a, const std::vector<Figures>& b) {
    std::printf("A / B: above 1 where B is faster\n%-16s %-16s %-11s %10s %10s %8s\n", "scene", "mode", "stage", "A",
                "B", "A / B");
    double logarithms = 0;
    int count = 0;
    std::vector<bool> used(b.size());
    for (const Figures& one : a) {
        // Of several devices in one file the first that is left is its partner: files of two machines compare, too.
        const Figures* other = nullptr;
        for (const bool same_device : {true, false}) {
            for (std::size_t i = 0; i < b.size() && other == nullptr; ++i) {
                if (used[i] || b[i].workload != one.workload || b[i].mode != one.mode || b[i].size != one.size ||
                    b[i].orbit != one.orbit || (same_device && b[i].device != one.device))
                    continue;
                other = &b[i];
                used[i] = true;
            }
        }
        if (other == nullptr) {
            std::printf("%-16s %-16s only in A\n", one.workload.c_str(), one.mode.c_str());
            continue;
        }
        for (const auto& [stage, ms] : one.ms) {
            const double theirs = other->time(stage);
            if (ms <= 0 && theirs <= 0) continue;
            std::printf("%-16s %-16s %-11s %10.3f %10.3f %8.2f\n", one.workload.c_str(), one.mode.c_str(),
                        stage.c_str(), ms, theirs, theirs > 0 ? ms / theirs : 0.0);
            if (stage == "kernels" && ms > 0 && theirs > 0) {
                logarithms += std::log(ms / theirs);
                ++count;
            }
        }
    }
    for (std::size_t i = 0; i < b.size(); ++i)
        if (!used[i]) std::printf("%-16s %-16s only in B\n", b[i].workload.c_str(), b[i].mode.c_str());
    if (count > 0) std::printf("kernels, geometric mean of %d: %.2f\n", count, std::exp(logarithms / count));
}

}  // namespace csgrt::bench
