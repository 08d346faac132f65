// One or several devices: each has the scene and a pipeline of its own, and takes the next part of a frame, or of a list of
// rays, when it is done with the last. Nothing a ray computes depends on its device.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "device/discovery.hpp"
#include "pipeline/readback/registered_memory.hpp"
#include "pipeline/scheduling/pipeline.hpp"

namespace csgrt {

/// Is told which part of the work is done, 0 to 1, and says whether to go on.
using Progress = std::function<bool(double)>;

class Pipelines {
public:
    /// On these devices; `settings` do not say which. The scene and the kernels must outlive this.
    Pipelines(const std::vector<FoundDevice>& devices, const CompiledScene& scene, const HostKernels& kernels,
              const Settings& settings, Readback readback = Readback::by_device);

    /// No two in a process have the same, which is not 0.
    std::uint64_t number() const noexcept { return number_; }

    void prepare(bool every_partition);
    /// Makes the memory of a picture that will be drawn into again known to those of its GPUs that have room for it: `pixels` floats of
    /// each plane, which follow each other. It must outlast what is returned, which this need not.
    std::shared_ptr<KnownPicture> make_known(std::span<const ChannelPlane> planes, std::size_t pixels);
    /// As Pipeline's. Progress is told by one thread at a time. Throws Error (interrupted) if it says not to go on, too.
    void render(const PreparedFrame& prepared, const RenderTarget& target, const Progress& progress,
                PipelineCounts& counts);
    std::vector<RayPartitions> shoot(const PreparedFrame& prepared, const std::vector<Ray>& rays, const Progress& progress,
                                     PipelineCounts& counts);

    std::string name() const;             ///< "A", or "A + B"
    std::uint64_t device_bytes() const;   ///< in buffers and what drivers hold of known pictures, of all devices
    double build_ms() const;  ///< to set up the devices, and of the one that took longest to compile its kernels

private:
    using Work = std::function<void(Pipeline&, const TakeRays&, const Pipeline::Told&, PipelineCounts&)>;
    std::uint64_t parts_of(const RayCosts& costs, bool every_partition) const;
    void share(const RayCosts& costs, bool every_partition, const Progress& progress, PipelineCounts& counts, const Work& work);

    void forget();

    /// What the drivers hold of a picture's, which counts as the devices' memory as long as there is the picture.
    struct Claim {
        std::weak_ptr<const KnownPicture> picture;
        Device* device;
        std::uint64_t bytes;
    };
    std::uint64_t number_;
    double setup_ms_ = 0;
    std::vector<Claim> claims_;
    std::vector<std::unique_ptr<Device>> devices_;
    std::vector<std::unique_ptr<Pipeline>> pipelines_;
};

}  // namespace csgrt
