// Device takeover: at first the devices that need no compiler draw, and others as soon as they are ready. A job on a
// thread finds these, sets them up and gives them their kernels, and has them to itself meanwhile. A call takes them
// over between two frames. Both draw the same bits.
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

/// Chooses the devices of each call. One thread at a time. The job is over when this is destroyed: objects that the job
/// refers to must outlive this.
class DeviceTakeover {
public:
    /// Sets devices up; the job calls it, too.
    using SetUp = std::function<std::unique_ptr<DeviceGroup>(const std::vector<FoundDevice>&)>;
    /// Gives devices the scene for which the next kernels are compiled; the job calls it, too.
    using Adapt = std::function<void(DeviceGroup&)>;

    /// Sets up the plan's first devices and begins to look for the next. `waits`: the next devices draw from the first
    /// call on, if there are any. Throws Error (out_of_memory, device_fault).
    DeviceTakeover(DevicePlan plan, SetUp set_up, Adapt adapt, bool waits);
    DeviceTakeover(const DeviceTakeover&) = delete;
    DeviceTakeover& operator=(const DeviceTakeover&) = delete;
    /// Waits for the current step of the job, at most until one mode's kernels are compiled.
    ~DeviceTakeover();

    /// The devices that draw such a call, every partition or first hits, with their kernels compiled. Valid until the
    /// next call. Next devices that lack the mode's kernels, or whose kernels cannot draw the scene, get them from the
    /// job, and the first devices draw meanwhile. Throws the fault that kept named devices from becoming ready, at this
    /// call and all later ones.
    DeviceGroup& drawer(bool every_partition, const CompiledScene& scene);
    /// The devices that would draw a call whose kernels are all compiled.
    const DeviceGroup& present() const { return next_ ? *next_ : *first_; }

    /// The name of the devices that the job makes ready; "gpu" until one is found; empty: there is no job.
    std::string awaited() const;
    /// The fault that kept devices that nobody named from taking over; returned once.
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
    bool is_over_;   ///< no device takes over any more
    std::exception_ptr fault_;
    bool is_told_ = false;

    // The job reads these members, too.
    std::array<std::atomic<bool>, 2> wanted_{};
    std::atomic<bool> is_left_{false};
    mutable std::mutex name_mutex_;
    std::string name_;
    std::future<Made> job_;  // destroyed first, and with it the job
};

}  // namespace csgrt
