// Renderer: makes pictures and partitions of a scene, on a device or on the CPU reference.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <csgrt/device.hpp>
#include <csgrt/framebuffer.hpp>
#include <csgrt/image.hpp>
#include <csgrt/method.hpp>
#include <csgrt/model.hpp>
#include <csgrt/partitions.hpp>
#include <csgrt/scene.hpp>
#include <csgrt/settings.hpp>
#include <csgrt/statistics.hpp>
#include <csgrt/version.hpp>
#include <csgrt/view.hpp>

namespace csgrt {

/// Draws Models and traces rays through them, on one device or on several that share the work. If the device is a GPU,
/// its kernels are compiled on another thread while a native device computes (see Settings::wait_for_device); the GPU
/// replaces the native device between two calls. Not copyable. One thread at a time; different Renderers may be used by
/// different threads at the same time. In a child of fork() a Renderer of the parent throws Error (usage) at every
/// call, and its destructor does nothing.
class CSGRT_API Renderer {
public:
    /// Opens devices and copies the model to them. Settings of the scene have no effect here (see Model::Model). Throws
    /// Error: usage (settings out of their ranges), no_device, out_of_memory, device_fault. If a GPU that was named
    /// fails while it is made ready, the next call throws (device_fault, out_of_memory); if it was chosen by default,
    /// device_warnings() reports it.
    explicit Renderer(Model model, const Settings& settings = {});
    /// Makes a Model of the scene, while it finds devices. Throws the errors of Model and of the other constructor.
    explicit Renderer(Scene scene, const std::vector<std::string>& objects = {}, const Settings& settings = {});
    /// Waits up to half a minute for a driver that is compiling kernels, because no driver can be stopped.
    /// Statistics::awaited_device tells whether a driver is compiling. A driver that caches its programs compiles them
    /// once.
    ~Renderer();
    /// Functions of a Renderer that was moved from throw Error (usage).
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    // The next two functions may be called by any thread, also while the Renderer works for another thread.

    /// The Model of the last set_model(), or of the constructor.
    Model model() const;
    /// Sets the Model of the next calls. The first of these calls copies the Model to the devices, except tables that
    /// the last Model has, too. A running call keeps its Model. Buffers are reused, and so are programs that support
    /// the Model's types of solids. If a GPU's programs do not, a native device computes until they are compiled anew.
    /// If a call throws because the Model does not fit (out_of_memory), the Renderer can still draw other Models.
    /// Throws Error (usage).
    void set_model(Model model);

    /// Draws a picture. Throws Error: usage (the view), out_of_memory, device_fault, interrupted.
    Image render(const View& view);
    /// Draws into the memory of an earlier picture, which is faster (see Framebuffer). Several Renderers may draw into
    /// one Framebuffer. With a function `coarse`, the picture is drawn in four steps: every 8th pixel in both
    /// directions, every 4th, every 2nd and all, each pixel once. `coarse` is called after the first three steps with
    /// 8, 4 and 2, the size in pixels of the squares of one colour that the framebuffer then shows. If `coarse` returns
    /// false, the call stops there. Throws as the other function does.
    void render(const View& view, Framebuffer& framebuffer, const std::function<bool(int)>& coarse = {});

    // Lists of rays. The memory of the answers' arrays is reused. All functions throw Error: usage (a ray that Limits
    // excludes; the message has its index), out_of_memory, device_fault, interrupted.

    /// Computes the partitions along each ray, within its range, and the arrays that `fields` chooses.
    void partitions(const Rays& rays, Partitions& answer, Fields fields = {}, const RayRanges& ranges = {});
    /// Computes partitions in batches of at most `most` rays, one after the other, in the same arrays. Calls
    /// take(batch, index of the batch's first ray) on one thread at a time; if `take` returns false, the call ends.
    /// statistics() is about the last batch.
    void partitions(const Rays& rays, const std::function<bool(const Partitions&, std::uint64_t)>& take,
                    Fields fields = {}, const RayRanges& ranges = {}, std::uint64_t most = 1'000'000);
    /// Finds the first hit of each ray with a region, within the ray's range. Fields::overlaps has no effect.
    void cast_rays(const Rays& rays, Hits& answer, Fields fields = {}, const RayRanges& ranges = {});
    /// Writes 1 for each ray that meets any region within its range, else 0.
    void occluded(const Rays& rays, Array<std::uint8_t>& answer, const RayRanges& ranges = {});
    /// Finds the region that holds each point, in millimetres, or -1. A ray along x decides: if two regions touch at
    /// the point, the region that begins there holds it, and if several overlap, the first one does.
    void region_at(std::span<const Vec3> points, Array<std::int32_t>& answer);
    /// Finds the region that holds each pixel's middle, row by row. A ray along the row decides. -1: no region; -2:
    /// several regions overlap.
    void slice(const Slice& slice, Array<std::int32_t>& answer);

    /// Computes partitions and overlaps along the whole lines of few rays, with all fields, as an object for each ray,
    /// without partitions that end at t < 0. For many rays, making the objects takes 17 to 54 times as long as the
    /// tracing.
    std::vector<RayPartitions> shoot(const std::vector<Ray>& rays);

    /// Adds the names of the ids in the channels `region` and `solid` to a picture's header. The attributes
    /// csgrt:regions and csgrt:solids are JSON texts such as {"17": "/all.g/x.r"}, with the ids that occur in the
    /// picture.
    void name_pixels(Image& image) const;
    /// Adds the pairs of regions that overlap in a picture of the view to the picture's header, if it has the channel
    /// `overlap`. The attribute csgrt:overlaps is a JSON text such as {"count": 1, "pairs": [["/a.r", "/b.r"]]}, with
    /// the first 256 pairs. Traces the rays of the pixels that have overlaps. Throws as partitions() does.
    void name_overlaps(const View& view, Image& image);

    // The references are valid as long as the Renderer.

    /// The statistics of the last call; before the first call, of the constructor.
    const Statistics& statistics() const;
    /// Warnings about devices, which the model's warnings do not have: for example that there is no device and the
    /// reference computes, or that a GPU cannot be used. Calls may append warnings.
    const std::vector<Warning>& device_warnings() const;

private:
    struct Impl;
    struct Delete {
        void operator()(Impl* impl) const;
    };
    Impl& impl() const;

    std::unique_ptr<Impl, Delete> impl_;
};

}  // namespace csgrt
