// Device takeover: at first devices draw that need no compiler, and the next devices draw as soon as they are ready. A
// job on another thread finds the next devices, sets them up and compiles their kernels; meanwhile only the job uses
// them. Between two frames a call takes them over. All devices draw the same bits.
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

/// The takeover chooses the devices of each call. One thread at a time. The destructor ends the job: objects to which
/// the job refers must outlive the takeover.
class DeviceTakeover {
public:
    /// Sets devices up; the job calls it, too.
    using SetUp = std::function<std::unique_ptr<DeviceGroup>(const std::vector<FoundDevice>&)>;
    /// Gives a group the scene for which its next kernels are compiled; the job calls it, too.
    using Adapt = std::function<void(DeviceGroup&)>;

    /// Sets up the plan's first devices and begins to search for the next devices. `waits`: the next devices draw from
    /// the first call on, if there are any. Throws Error (out_of_memory, device_fault).
    DeviceTakeover(DevicePlan plan, SetUp set_up, Adapt adapt, bool waits);
    DeviceTakeover(const DeviceTakeover&) = delete;
    DeviceTakeover& operator=(const DeviceTakeover&) = delete;
    /// Waits until the current step of the job has ended; the longest step compiles the kernels of one mode.
    ~DeviceTakeover();

    /// The devices for a call of every partition, or of first hits, with compiled kernels. Valid until the next call.
    /// If the next devices lack kernels for this mode or scene, the job compiles them, and the first devices draw
    /// meanwhile. If a fault kept named devices from becoming ready, this call and all later calls throw it.
    DeviceGroup& drawer(bool every_partition, const CompiledScene& scene);
    /// The devices that would draw a call if all kernels were compiled.
    const DeviceGroup& present() const { return next_ ? *next_ : *first_; }

    /// The names of the devices that the job makes ready; "gpu" until a device is found; empty: there is no job.
    std::string awaited() const;
    /// The fault that kept devices, which the user did not name, from taking over; returned once.
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
