// Device group: one or several devices that share the work of a call. Each device has the scene and its own pipeline.
// It takes the next part of a frame or of a list when its last part is done. The result of a ray does not depend on the
// device.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/watch.hpp"
#include "device/discovery.hpp"
#include "pipeline/readback/registered_memory.hpp"
#include "pipeline/scheduling/pipeline.hpp"

namespace csgrt {

/// The devices that answer a call together. A faster device takes more parts of a frame. The pixels are the same, since
/// each ray is computed independently.
class DeviceGroup {
public:
    /// Makes pipelines on these devices; `settings.device` is not read. The scene and the kernels must outlive the
    /// group.
    DeviceGroup(const std::vector<FoundDevice>& devices, const CompiledScene& scene, const RecordConverter& records,
                const Settings& settings, Readback readback = Readback::by_device);

    /// A number that no other group of the process has, not 0.
    std::uint64_t number() const noexcept { return number_; }

    /// Sets another scene for the next calls. `owner` keeps the scene and its records alive.
    void set_scene(const CompiledScene& scene, const RecordConverter& records, std::shared_ptr<const void> owner);
    /// Whether the compiled kernels can draw the scene.
    bool can_draw(const CompiledScene& scene) const;
    /// The owner that the last set_scene() or keep() was given; null: no call yet.
    const std::shared_ptr<const void>& owner() const { return owner_; }
    void keep(std::shared_ptr<const void> owner) { owner_ = std::move(owner); }
    void prepare(bool every_partition);
    /// Registers a picture's memory with each GPU that has enough memory for this. It pays for pictures that will be
    /// drawn again. The memory is `pixels` floats for each channel, one channel after the other. The memory must
    /// outlive the result; the group need not.
    std::shared_ptr<RegisteredMemory> register_memory(std::span<const ChannelMemory> channels, std::size_t pixels);
    /// Draws a frame, as Pipeline::render does. Also throws Error (interrupted), if `watch`, which may be null, ends
    /// the work.
    void render(const PreparedFrame& prepared, const RenderTarget& target, Watch* watch, PipelineCounts& counts);
    /// Whether render() can draw the edges of such a frame: one device draws the whole picture.
    bool draws_edges(const PreparedFrame& prepared) const {
        return pipelines_.size() == 1 && pipelines_.front()->draws_edges(prepared);
    }
    void trace_list(const kernel::Frame& frame, const RayList& rays, RowReceiver& receiver, Watch* watch,
                    PipelineCounts& counts);

    bool uses_driver() const;            ///< at least one device is not native
    std::string name() const;            ///< "A", or "A + B"
    std::uint64_t device_bytes() const;  ///< of all devices: buffers, and what drivers hold for registered memory
    double build_ms() const;  ///< to set up the devices, and to compile the kernels of the device that took longest

private:
    using Work = std::function<void(Pipeline&, const TakeRays&, const ReportDone&, PipelineCounts&)>;
    Parts parts_of(std::uint64_t rays, std::uint64_t row, std::size_t devices, bool every_partition) const;
    void share(std::uint64_t rays, std::uint64_t row, bool every_partition, Watch* watch, PipelineCounts& counts,
               const Work& work);

    void start_call();
    void drop_claims();

    /// The device memory that a driver holds for registered memory: the same number of bytes, until the registration
    /// ends.
    struct Claim {
        std::weak_ptr<const RegisteredMemory> registered;
        Device* device;
        std::uint64_t bytes;
    };
    std::shared_ptr<const void> owner_;  ///< of the scene
    std::uint64_t number_;
    double setup_ms_ = 0;
    std::vector<Claim> claims_;
    std::vector<std::unique_ptr<Device>> devices_;
    std::vector<std::unique_ptr<Pipeline>> pipelines_;
};

}  // namespace csgrt
