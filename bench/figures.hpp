// What was measured of one workload on one device, and how it is kept: a file of JSON holds an array of these.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt::bench {

using Times = decltype(Statistics::ms);
struct Stage {
    const char* name;
    double Times::*time;
};
/// Of the device.
inline constexpr Stage stages[] = {{"count_segments", &Times::count_segments},
                                   {"scan", &Times::scan},
                                   {"store", &Times::store_segments},
                                   {"weave", &Times::weave},
                                   {"evaluate", &Times::evaluate},
                                   {"shade", &Times::shade},
                                   {"rows", &Times::rows},
                                   {"cull", &Times::cull_tiles},
                                   {"first_hits", &Times::first_hits}};

struct Figures {
    std::string workload, device, mode;  ///< mode: "first hits", "every partition" or "lists"
    int size = 0, frames = 0;
    int orbit = 0;  ///< frames around the model, 0: all from one side
    std::uint64_t solids = 0, regions = 0, segments = 0, partitions_used = 0, partitions_allocated = 0;
    std::uint64_t segment_and_partition_bytes = 0, device_bytes = 0;
    /// Milliseconds: load, compile, build and the first picture once; medians of the stages, of "kernels" (in which any
    /// of them runs) and of "frame" (wall, from camera to pixels on the host); of an orbit also "worst" frame.
    std::vector<std::pair<std::string, double>> ms;

    /// Negative: there is none of that name.
    double time(const std::string& name) const;
    double bytes_per_ray() const { return static_cast<double>(device_bytes) / (static_cast<double>(size) * size); }
};

/// Throws Error (file).
void save(const std::vector<Figures>& all, const std::string& path);
std::vector<Figures> load(const std::string& path);

void print(const std::vector<Figures>& all);
/// Per workload and stage: A, B and A / B, which is above 1 where B is the faster one.
void print_comparison(const std::vector<Figures>& a, const std::vector<Figures>& b);

double median(std::vector<double> values);

}  // namespace csgrt::bench
