// Who draws: at once the devices that need no compiler, and others as soon as they are ready. These are found, set up
// and given their kernels by a job on a thread, which has them to itself meanwhile; a call takes them over between two
// frames. Either draws the same bits.
//
//     first:   frame   frame   frame   frame
//     job:     find, set up, compile ........|
//     next:                                   frame   frame
#pragma once

#include <array>
#include <atomic>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "device/device_plan.hpp"
#include "pipeline/scheduling/device_group.hpp"

namespace csgrt {

/// One thread at a time. The job is over when this is gone: what it refers to must outlive this.
class DeviceTakeover {
public:
    /// Sets devices up; the job calls it too.
    using SetUp = std::function<std::unique_ptr<DeviceGroup>(const std::vector<FoundDevice>&)>;
    /// Gives devices the scene that the next kernels are compiled for; the job calls it, too.
    using Adapt = std::function<void(DeviceGroup&)>;

    /// Sets the plan's first devices up and begins to look for the next. `waits`: these draw from the first call on, if
    /// there are any. Throws Error (out_of_memory, device_fault).
    DeviceTakeover(DevicePlan plan, SetUp set_up, Adapt adapt, bool waits);
    DeviceTakeover(const DeviceTakeover&) = delete;
    DeviceTakeover& operator=(const DeviceTakeover&) = delete;
    /// Waits for what the job is about, at most until one mode's kernels are compiled.
    ~DeviceTakeover();

    /// Who draws such a call, every partition or first hits, with its kernels compiled. Valid until the next call. Next
    /// devices that lack the mode's kernels, or whose kernels cannot draw the scene, get them from the job, and the
    /// first ones draw meanwhile. Throws what kept named devices from becoming ready, at this call and all later ones.
    DeviceGroup& drawer(bool every_partition, const CompiledScene& scene);
    /// Who would draw, were there a call now that all kernels are compiled for.
    const DeviceGroup& present() const { return next_ ? *next_ : *first_; }

    /// The name of the devices that the job makes ready; "gpu" until one is found; empty: there is no job.
    std::string awaited() const;
    /// What kept devices that nobody named from taking over, once.
    std::optional<std::string> take_fault();

private:
    using Ready = std::array<bool, 2>;  ///< by every_partition
    struct Made {
        std::unique_ptr<DeviceGroup> pipelines;  ///< null: there are no such devices
        Ready ready{};
    };

    Made work(Made made);
    bool has_ended() const;
    void begin();
    void collect();
    void await(bool every_partition);
    DeviceGroup& first();

    DevicePlan plan_;
    SetUp set_up_;
    Adapt adapt_;
    bool waits_;
    std::unique_ptr<DeviceGroup> first_, next_;
    Ready ready_{};  ///< modes that next_ draws
    bool is_over_;   ///< nobody takes over any more
    std::exception_ptr fault_;
    bool is_told_ = false;

    // What the job sees, too.
    std::array<std::atomic<bool>, 2> wanted_{};
    std::atomic<bool> is_left_{false};
    mutable std::mutex name_mutex_;
    std::string name_;
    std::future<Made> job_;  // goes first, and with it the job
};

}  // namespace csgrt
