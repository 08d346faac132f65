// From a scene to pictures and partitions, on a device or on the CPU reference.
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

/// Draws and shoots Models, on one device or on several that share the work. If the device is a GPU, its kernels are
/// compiled on another thread while a native device computes (see Settings::wait_for_device); the GPU replaces the
/// native device between two calls. Not copyable. One thread at a time; different Renderers may be used by different
/// threads at the same time. In a child of fork() a Renderer of the parent's throws Error (usage) at every call, and
/// its destructor does nothing.
class CSGRT_API Renderer {
public:
    /// Opens devices and copies the model to them. Of the settings those of the scene have no part in it (see
    /// Model::Model). Throws Error: usage (settings that exclude each other), no_device, out_of_memory, device_fault.
    /// If a GPU was asked for by name and fails while it is made ready, the next call throws (device_fault,
    /// out_of_memory); if it was chosen by default, device_warnings() says so.
    explicit Renderer(Model model, const Settings& settings = {});
    /// Of a Model that it makes of the scene, while it looks for devices. Throws as both do.
    explicit Renderer(Scene scene, const std::vector<std::string>& objects = {}, const Settings& settings = {});
    /// Waits until a driver that is compiling kernels has ended, up to half a minute, since no driver can be stopped.
    /// Statistics::awaited_device tells whether there is one. A driver that caches its programs compiles once.
    ~Renderer();
    /// Calls of a Renderer that was moved from throw Error (usage).
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    // Any thread may call the next two, also while the Renderer works for another thread.

    /// As set_model() had it last. It tells the regions, solids, bounds and warnings, and the rays of a view.
    Model model() const;
    /// The next calls are about this model, which the first of them copies to the devices, but for the tables that the
    /// last one has, too. A call that works keeps its model. Programs that know the model's types of solids stay, and
    /// buffers; where a GPU's do not, a native device computes until they are compiled anew. A call that throws since
    /// the model does not fit (out_of_memory) leaves the Renderer to other models. Throws Error (usage).
    void set_model(Model model);

    /// Draws a picture. Throws Error: usage (the view), out_of_memory, device_fault, interrupted.
    Image render(const View& view);
    /// Draws into memory that is used again, which is faster (see Framebuffer). Any Renderer may draw into it. If there
    /// is a function `coarse`, the picture is drawn in four steps, of every 8th pixel each way, every 4th, every 2nd
    /// and all, none twice: it is called behind the first three with 8, 4 and 2, the size of squares of one colour that
    /// the framebuffer shows, and returns false to leave it at that. Throws as the other does.
    void render(const View& view, Framebuffer& framebuffer, const std::function<bool(int)>& coarse = {});

    // Lists in arrays, whose memory is used again. All throw Error: usage (a ray that Limits excludes; the message has
    // its index), out_of_memory, device_fault, interrupted.

    /// Everything along each ray, within its range: the arrays that `fields` asks for.
    void partitions(const Rays& rays, Partitions& answer, Fields fields = {}, const RayRanges& ranges = {});
    /// The same in batches of at most `most` rays, one after the other in the same arrays. `take` gets each with the
    /// number of its first ray, on one thread at a time, and returns false to end the call. statistics() is of the last
    /// batch.
    void partitions(const Rays& rays, const std::function<bool(const Partitions&, std::uint64_t)>& take,
                    Fields fields = {}, const RayRanges& ranges = {}, std::uint64_t most = 1'000'000);
    /// Where each ray first meets a region, within its range. Of the fields, `overlaps` counts for nothing.
    void cast_rays(const Rays& rays, Hits& answer, Fields fields = {}, const RayRanges& ranges = {});
    /// 1 for each ray that meets any region within its range, else 0.
    void occluded(const Rays& rays, Array<std::uint8_t>& answer, const RayRanges& ranges = {});
    /// The region that holds each point, in millimetres, or -1: what a ray along x meets there, so of two regions that
    /// touch at the point the one that begins, and of several that overlap the first.
    void region_at(std::span<const Vec3> points, Array<std::int32_t>& answer);
    /// The region that holds each pixel's middle, row by row: what a ray along its row meets there. -1: none, -2:
    /// several, which overlap.
    void slice(const Slice& slice, Array<std::int32_t>& answer);

    /// For few rays: what partitions() gives of the whole lines, with all fields, as an object a ray, less what ends at
    /// a t below 0. To make the objects of many rays takes 17 to 54 times as long as to trace them.
    std::vector<RayPartitions> shoot(const std::vector<Ray>& rays);

    /// Adds the meaning of the numbers in the channels `region` and `solid` to a picture's header: the attributes
    /// csgrt:regions and csgrt:solids, JSON texts such as {"17": "/all.g/x.r"}, of the numbers that occur in the
    /// picture.
    void name_pixels(Image& image) const;

    // The references are valid as long as the Renderer.

    /// Of the last call; before the first call, of the constructor.
    const Statistics& statistics() const;
    /// What is about devices, beside the model's own warnings: that the reference computes since there is no device, or
    /// that a GPU cannot be used. Calls may append to it.
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
