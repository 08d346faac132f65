// What was measured, and how it is written: one JSON file a device (bench/chart/README.md names its fields).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "accuracy.hpp"
#include "bench/methods/method.hpp"
#include "interval.hpp"

namespace csgrt::bench {

/// One variant on one workload, in one mode. A variant is a method with one value of its parameter.
struct Row {
    std::string variant, workload, family;
    Mode mode = Mode::every_partition;
    std::string method, knob;  ///< knob: the parameter's name and unit; empty: it has none
    double knob_value = 0;
    bool laboratory = false;  ///< another's method (bench/methods)
    bool exact = true;        ///< it has no error of its own beside rounding
    std::string device;       ///< that answered
    Accuracy accuracy;
    /// Median of warm frames: of all kernels together, by ray, and its interval. 0: not timed.
    double ns_per_ray = 0;
    ConfidenceInterval ns;
    double frame_ms = 0;                          ///< of the whole frame
    std::size_t timed_rays = 0;                   ///< of a frame
    std::map<std::string, std::size_t> refusals;  ///< why scenes were refused, and how many rays they have
    std::map<std::string, double> figures;        ///< of the method: the largest over the scenes
    std::string error;                            ///< why there is no answer; empty: there is one
};

/// Milliseconds that another program needs for 1024 x 1024 pixels of some of the workloads.
struct Anchor {
    std::string name, device_type;  ///< on whose pictures it stands: "cpu" or "gpu"
    std::vector<std::pair<std::string, double>> ms;
};

struct Report {
    std::string device, device_type, version;
    int size = 0, frames = 0;  ///< of the timed pictures; those of the reference and of bench/methods may be smaller
    std::size_t rays = 0;      ///< asked for, of each workload
    double seconds = 0;        ///< that it took in all
    std::vector<Row> rows;
    std::vector<Anchor> anchors;
    std::vector<Method> methods;  ///< of the laboratory, those that were tried
};

/// A variant's rows of one mode together.
struct Total {
    Row row;                   ///< its rays of all workloads
    std::size_t timed_on = 0;  ///< workloads
    /// Its time divided by the first variant's: geometric mean over those of timed_workloads() that both have.
    double of_default = 0;
    std::vector<std::string> failed;  ///< workloads where it has an error
};
/// Every variant and mode, over all workloads (`by_family` false: the row's workload and family are "all") or over each
/// family's. The row's time is the geometric mean over timed_workloads(), or 0 if the variant lacks one of these.
std::vector<Total> totals(const Report& report, bool by_family = false);
/// The workloads that the first variant, the default, was timed on, without those of depth, where one would outweigh
/// all others; of these the ones that every anchor of this device has, if there are such.
std::vector<std::string> timed_workloads(const Report& report);

std::string to_json(const Report& report);

/// Rows with all that they count, so that a measurement goes on where it was, and back. `key`: of how they were
/// measured. Nothing, and why in `fault`, if the text is no such rows or its key is another.
std::string rows_to_json(const std::vector<Row>& rows, const std::string& key);
std::optional<std::vector<Row>> rows_from_json(const std::string& text, const std::string& key, std::string& fault);

/// Writes the file whole, or not at all: throws Error (file).
void write_whole(const std::string& text, const std::string& path);

}  // namespace csgrt::bench
