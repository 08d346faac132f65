// One method on one workload, with its answers and its times.
#pragma once

#include <memory>
#include <vector>

#include "bench/methods/method.hpp"
#include "report.hpp"
#include "tasks.hpp"
#include "truth_file.hpp"
#include "variants.hpp"

namespace csgrt::bench {

struct TrialOptions {
    std::string device;             ///< as of csgrt
    int size = 0;                   ///< of the timed pictures, pixels
    int deep_size = 0;              ///< of those of the family "deep"
    std::size_t device_scenes = 1;  ///< of a stress family, for what only the device has
    double method_seconds = 3;      ///< for the answers of one of the laboratory's methods on one workload
    double method_frame = 0.2;      ///< seconds of a timed picture of one of these, about
    std::uint64_t max_memory = 0;   ///< as in Settings
    std::vector<Mode> modes{Mode::first_hits, Mode::every_partition};
};

class Trial {
public:
    virtual ~Trial() = default;
    /// The next timed frames, one a mode, if there are any. The first ones take memory and do not count.
    virtual void frame(bool counts) = 0;
    /// What was measured, one a mode.
    virtual std::vector<Row> rows() = 0;
};

/// All arguments must outlive it. The answers are judged at once. What a method cannot do is its result; if there is no
/// device, that is thrown (Error, no_device).
std::unique_ptr<Trial> try_variant(const Variant& variant, const ChartWorkload& workload, const Truth& truth,
                                   const TrialOptions& options);
/// `knob`: of method.knob_values; 0: it has none.
std::unique_ptr<Trial> try_method(const Method& method, double knob, Mode mode, const ChartWorkload& workload,
                                  const Truth& truth, const TrialOptions& options);

}  // namespace csgrt::bench
