// Device group: one or several devices. Each has the scene and a pipeline of its own, and takes the next part of a
// frame, or of a list of rays, when it is done with the last. No result of a ray depends on its device.
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

/// The devices that answer a call together. A faster device takes more parts of a frame; the pixels are the same, since
/// each ray is computed alone.
class DeviceGroup {
public:
    /// Makes pipelines on these devices; `settings.device` is not read. The scene and the kernels must outlive the
    /// group.
    DeviceGroup(const std::vector<FoundDevice>& devices, const CompiledScene& scene, const RecordConverter& records,
                const Settings& settings, Readback readback = Readback::by_device);

    /// A number that no other group of the process has, not 0.
    std::uint64_t number() const noexcept { return number_; }

    /// Takes another scene for the next calls. `owner`: keeps it and its kernels alive.
    void set_scene(const CompiledScene& scene, const RecordConverter& records, std::shared_ptr<const void> owner);
    /// Whether the compiled kernels can draw the scene.
    bool can_draw(const CompiledScene& scene) const;
    /// The owner of the last set_scene() or keep(); null: neither was called.
    const std::shared_ptr<const void>& owner() const { return owner_; }
    void keep(std::shared_ptr<const void> owner) { owner_ = std::move(owner); }
    void prepare(bool every_partition);
    /// Registers the memory of a picture that will be drawn into again with those GPUs that have room for it: `pixels`
    /// floats of each channel, one channel after the other. The memory must outlive the result; the group need not.
    std::shared_ptr<RegisteredMemory> register_memory(std::span<const ChannelMemory> channels, std::size_t pixels);
    /// Draws a frame, as Pipeline::render does. Throws Error (interrupted), too, if `watch`, which may be null, says
    /// so.
    void render(const PreparedFrame& prepared, const RenderTarget& target, Watch* watch, PipelineCounts& counts);
    void trace_list(const kernel::Frame& frame, const RayList& rays, RowReceiver& receiver, Watch* watch,
                    PipelineCounts& counts);

    bool uses_driver() const;            ///< some device is not native
    std::string name() const;            ///< "A", or "A + B"
    std::uint64_t device_bytes() const;  ///< of all devices: in buffers, and as much as drivers hold for registered
                                         ///< memory
    double build_ms() const;  ///< to set up the devices, and to compile the kernels of the device that took longest

private:
    using Work = std::function<void(Pipeline&, const TakeRays&, const ReportDone&, PipelineCounts&)>;
    Parts parts_of(std::uint64_t rays, std::uint64_t row, std::size_t devices, bool every_partition) const;
    void share(std::uint64_t rays, std::uint64_t row, bool every_partition, Watch* watch, PipelineCounts& counts,
               const Work& work);

    void start_call();
    void drop_claims();

    /// A claim on a device's memory: a driver holds as much as is registered, as long as it is registered.
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
