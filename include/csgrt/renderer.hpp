// From a scene to pictures and partitions, on an OpenCL device or on the CPU reference.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <csgrt/image.hpp>
#include <csgrt/method.hpp>
#include <csgrt/scene.hpp>

namespace csgrt {

struct DeviceInfo {
    std::string name, platform, version, driver;
    std::string type;  ///< "cpu", "gpu", "accelerator"
    std::uint64_t memory = 0, max_allocation = 0;
    unsigned compute_units = 0;
    bool fp64 = false;
};
/// Every device, in the order of their numbers: those of OpenCL, and the native ones (platform "csgrt"), which are this machine's
/// processors with kernels that csgrt brings itself. Empty if there is none. `notes`: takes a sentence on each driver that cannot be
/// used. Any thread.
///
/// PoCL, the driver for processors, has no device, compiles no kernel or ends the process where it cannot write its cache:
/// POCL_CACHE_DIR, else XDG_CACHE_HOME/pocl/kcache, else HOME/.cache/pocl/kcache. The library leaves the environment alone: a
/// program without a home (a service, a container) sets POCL_CACHE_DIR to a folder before its first devices(),
/// prepare_devices() or Renderer, and before it starts threads. csgrt's command does so.
CSGRT_API std::vector<DeviceInfo> devices(std::vector<std::string>* notes = nullptr);

struct Settings {
    bool reference = false;       ///< the CPU reference in place of a device
    /// "" (a GPU if there is one, else a native device, else any, else the reference, with a warning), "cpu", "gpu", a
    /// number, or part of a name; several share the work of a call: "gpus", all there are, or such choices with commas
    /// between them, "0,1".
    std::string device;
    /// Where a GPU is meant, a native device draws the same bits until the GPU's driver has compiled the kernels, which
    /// takes up to half a minute. True: calls wait for the GPU instead, as figures of it need.
    bool wait_for_device = false;
    std::uint64_t max_memory = 0; ///< bytes of device memory; 0: what the device can give
    Precision precision = Precision::double_;
    Quartic quartic = Quartic::bracketed;
    bool contraction = false;     ///< on a device: it may make one operation of a product and a sum; results differ
    Tolerance tolerance_rule = Tolerance::length;
    double tolerance = -1;        ///< millimetres, for Tolerance::length; negative: the scene's
    bool air = false;             ///< keep air regions
    bool skip_unsupported = false;///< leave out solids of types that csgrt does not know, as in lenient scenes
    unsigned threads = 0;         ///< of the reference and of the native device; 0: all
    /// Called now and then with the done fraction 0..1; returning false stops (Status::interrupted).
    std::function<bool(double)> progress;
};

/// Begins to look for the devices that a Renderer with such settings will need, on a thread of its own, once in a
/// process; later calls do nothing, nor does one where no driver need be loaded: the reference, native devices, and the
/// default choice on a machine without a GPU. A driver takes some 30 ms to start: called before a scene is loaded, this
/// spares its Renderer the wait. Renderer calls it before it compiles.
CSGRT_API void prepare_devices(const Settings& settings = {});

/// Groups of a picture's channels.
namespace channel {
inline constexpr std::uint32_t color = 1;     ///< R G B A
inline constexpr std::uint32_t distance = 2;  ///< Z
inline constexpr std::uint32_t normal = 4;    ///< N.X N.Y N.Z
inline constexpr std::uint32_t ids = 8;       ///< region, solid
inline constexpr std::uint32_t counts = 16;   ///< depth, partitions, overlap: only with every partition
inline constexpr std::uint32_t all = 31;
}  // namespace channel

/// What to draw.
struct View {
    int width = 1024, height = 1024;
    Camera camera;
    bool every_partition = true;  ///< false: only the first hits, several times faster, without channel::counts
    std::uint32_t channels = channel::all;  ///< the picture's, in the order of their bits
};

struct Ray {
    /// Distances are in units of the direction, which may have any length (see Limits) but 0.
    Vec3 origin, direction;
};

struct Partition {
    double in = 0, out = 0;         ///< along the ray; may be negative or infinite
    Vec3 in_normal, out_normal;     ///< unit, outward from the region (flips applied)
    std::uint32_t region = 0;       ///< index into Renderer::regions()
    std::uint32_t in_solid = 0, out_solid = 0;  ///< index into Renderer::solids()
};
/// What several regions claim of one rank: solids before FASTGEN's plates, these before its volumes, air last. The first of
/// them in the model has it; regions of later ranks yield to earlier ones, and do not overlap them.
struct Overlap {
    double in = 0, out = 0;
    std::vector<std::uint32_t> regions;
};
/// Everything along one ray from its start on, front to back; neighbours of one region are joined. A ray that starts inside
/// a region has a first partition with a negative `in`: where the region truly begins.
struct RayPartitions {
    std::vector<Partition> partitions;
    std::vector<Overlap> overlaps;
};

struct RegionInfo {
    std::string path;  ///< "/top/.../region"
    Fastgen fastgen = Fastgen::none;
    int region_id = 0, air = 0, material_id = 0, los = 0;
    Vec3 color{1, 1, 1};
    Finish finish;
    Box bounds;
};
struct SolidInfo {
    std::string name, type;
    std::uint32_t piece = 0;  ///< a pipe is several solids: 0 is the first
};

/// Figures of the last call. Times in milliseconds; those of the kernels are the device's own, of several devices their sum. Of first
/// hits in several tiles a kernel's time is from its begin to its end, though another tile's may run beside it.
/// Segments and partitions are not counted where only first hits were wanted, but for rays that needed the exact way.
struct Statistics {
    std::string device;  ///< who drew
    /// Made ready now, when Renderer::statistics() is called, to take over from it: a name; "gpu" as long as none is
    /// found; empty: nobody.
    std::string awaited_device;
    std::string precision, method;
    std::string quartic;   ///< as in quartic_names
    double tolerance = 0;  ///< millimetres
    bool contraction = false;
    int width = 0, height = 0;
    std::uint64_t rays = 0, hits = 0, segments = 0, partitions_used = 0, partitions_allocated = 0, overlaps = 0;
    std::uint64_t device_bytes = 0, segment_bytes = 0, partition_bytes = 0;
    std::uint32_t tiles = 0;
    struct {
        /// `build`: of the device and all kernels so far, which the calls that wait for them do not count as `frame`.
        double load = 0, compile = 0, build = 0, count_hits = 0, scan = 0, store_segments = 0, weave = 0, evaluate = 0,
               shade = 0, cull_blocks = 0, first_hits = 0, frame = 0, write = 0;
        /// All that the device did for the frame.
        double device() const {
            return count_hits + scan + store_segments + weave + evaluate + shade + cull_blocks + first_hits;
        }
    } ms;
};

class RegisteredMemory;

/// A picture that is drawn again and again, as a viewer does. Of a frame like the last one (size, channels, background) only
/// the blocks of pixels are written that show something, or did before: what no solid is near costs nothing. From the second
/// such frame of one Renderer on its GPUs copy straight into the picture's memory, which is registered with their drivers. That takes
/// a tenth of a second a gigabyte, and as much of the GPU's memory as the picture has. A copy of a Framebuffer is not registered.
class CSGRT_API Framebuffer {
public:
    Framebuffer();
    ~Framebuffer();
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;
    Framebuffer(const Framebuffer& other);
    Framebuffer& operator=(const Framebuffer& other);

    /// What was drawn last; a call that threw may have left parts of two frames.
    const Image& image() const { return image_; }
    /// The same to keep; the next frame takes memory of its own.
    Image take();

private:
    friend class Renderer;
    void fit(int width, int height, std::vector<std::string> names, std::vector<float> background);

    Image image_;
    std::vector<float> background_;    ///< a channel
    std::vector<std::uint8_t> covered_;  ///< of each tile of 8 x 8 pixels: 0 if it holds nothing but the background
    std::uint64_t drawn_by_ = 0;       ///< Renderer of the last frame
    std::shared_ptr<RegisteredMemory> registered_;  ///< with its devices; must not outlive the image
};

/// A compiled scene on one device, or on several that share the work. Not copyable; one thread at a time. A GPU is made
/// ready on a thread of the Renderer's own while a native device draws (Settings::wait_for_device), and takes over
/// between two calls.
class CSGRT_API Renderer {
public:
    /// Validates, compiles and uploads `objects` of `scene` (empty: its top objects): names, or paths like
    /// "all.g/tor.r", which give an object the place and the attributes that it has there. Throws Error: scene,
    /// no_device, out_of_memory, device_fault. A GPU that was asked for and fails as it is made ready is told of by the
    /// next call (device_fault, out_of_memory); one that nobody asked for, by a warning.
    explicit Renderer(const Scene& scene, const std::vector<std::string>& objects = {}, const Settings& settings = {});
    /// Waits for kernels that a driver is compiling, since no driver can be stopped: up to half a minute, once for a
    /// driver that keeps them. Statistics::awaited_device tells whether it would.
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    Image render(const View& view);
    /// The same into memory that is used again; any Renderer may draw into it.
    void render(const View& view, Framebuffer& framebuffer);
    std::vector<RayPartitions> shoot(const std::vector<Ray>& rays);

    /// The rays of a picture, by row from the top left.
    std::vector<Ray> rays_of(const View& view) const;

    /// Adds to a picture's header what the numbers in its channels `region` and `solid` mean: the attributes csgrt:regions and
    /// csgrt:solids, JSON texts such as {"17": "/all.g/x.r"}, of the numbers that occur in it and no others.
    void name_pixels(Image& image) const;

    const Box& bounds() const;  ///< of the model: its regions' boxes; low > high if none is bounded
    const std::vector<RegionInfo>& regions() const;
    const std::vector<SolidInfo>& solids() const;
    const Statistics& statistics() const;
    /// What the scene's reader bore, what was left out and what else is worth telling: air regions, open meshes, ...
    /// Each object and reason once. The first of them stand in a picture's attribute csgrt:warnings. Then, of devices:
    /// that the reference draws for want of one, or that a GPU cannot be used, which a call may add.
    const std::vector<Warning>& warnings() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

CSGRT_API const char* version();

}  // namespace csgrt
