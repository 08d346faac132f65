// What was measured, and how it is written: one JSON file a device (bench/chart/README.md names its fields).
#pragma once

#include <string>
#include <vector>

#include "accuracy.hpp"

namespace csgrt::bench {

/// One variant on one workload.
struct Row {
    std::string variant, workload, family;
    Accuracy accuracy;
    /// Medians of warm frames: of all kernels together, by ray; of the whole frame. 0: not timed.
    double ns_per_ray = 0, frame_ms = 0;
    std::string error;  ///< why there is no answer; empty: there is one
};

/// Milliseconds that another program needs for 1024 x 1024 pixels of some of the workloads.
struct Anchor {
    std::string name, device_type;  ///< on whose pictures it stands: "cpu" or "gpu"
    std::vector<std::pair<std::string, double>> ms;
};

struct Report {
    std::string device, device_type, version;
    int size = 0, frames = 0;  ///< of the timed pictures
    std::size_t rays = 0;      ///< asked for, of each workload
    double seconds = 0;        ///< that it took in all
    std::vector<Row> rows;
    std::vector<Anchor> anchors;
};

/// For every variant a row "all": its rays of all workloads together, and the geometric mean of its times over those
/// workloads that every variant was timed on and that every anchor of this device has, or, where there is none such,
/// that every variant was timed on.
std::vector<Row> totals(const Report& report);
/// Those workloads.
std::vector<std::string> timed_workloads(const Report& report);

std::string to_json(const Report& report);

/// Writes the file whole, or not at all: throws Error (file).
void write_whole(const std::string& text, const std::string& path);

}  // namespace csgrt::bench
