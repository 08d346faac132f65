#include <csgrt/renderer.hpp>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <optional>
#include <utility>

#include "base/clock.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/frame.hpp"
#include "compile/linear.hpp"
#include "device/choice.hpp"
#include "base/fnv1a.hpp"
#include "kernel_host/geometry.hpp"
#include "base/parallel.hpp"
#include "render/device_takeover.hpp"
#include "reference/reference.hpp"
#include "scene/range.hpp"

namespace csgrt {
namespace {

/// The power of two that a direction is divided by before it is shot, so that its squares, and floats of it, are numbers. 0 for
/// all of usual length.
int exponent_of(const Vec3& direction) {
    constexpr int usual = 32;
    int exponent = 0;
    std::frexp(largest(direction), &exponent);
    return exponent > usual || exponent < -usual ? exponent : 0;
}
Vec3 times_power(const Vec3& v, int exponent) {
    return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
}
void scale_distances(RayPartitions& answer, int exponent) {
    const auto scale = [exponent](auto& stretch) {
        stretch.in = std::ldexp(stretch.in, exponent);
        stretch.out = std::ldexp(stretch.out, exponent);
    };
    std::for_each(answer.partitions.begin(), answer.partitions.end(), scale);
    std::for_each(answer.overlaps.begin(), answer.overlaps.end(), scale);
}

constexpr const char* exact_method = "five kernels, exact counts";

struct ChannelSource {
    const char* name;
    std::uint32_t group;
    float (*value)(const kernel::Pixel&);
};
constexpr ChannelSource channels[] = {
    {"R", channel::color, [](const kernel::Pixel& p) { return p.rgba[0]; }},
    {"G", channel::color, [](const kernel::Pixel& p) { return p.rgba[1]; }},
    {"B", channel::color, [](const kernel::Pixel& p) { return p.rgba[2]; }},
    {"A", channel::color, [](const kernel::Pixel& p) { return p.rgba[3]; }},
    {"Z", channel::distance, [](const kernel::Pixel& p) { return p.z; }},
    {"N.X", channel::normal, [](const kernel::Pixel& p) { return p.normal[0]; }},
    {"N.Y", channel::normal, [](const kernel::Pixel& p) { return p.normal[1]; }},
    {"N.Z", channel::normal, [](const kernel::Pixel& p) { return p.normal[2]; }},
    {"region", channel::ids, [](const kernel::Pixel& p) { return static_cast<float>(p.region); }},
    {"solid", channel::ids, [](const kernel::Pixel& p) { return static_cast<float>(p.solid); }},
    {"depth", channel::counts, [](const kernel::Pixel& p) { return static_cast<float>(p.depth); }},
    {"partitions", channel::counts, [](const kernel::Pixel& p) { return static_cast<float>(p.partitions); }},
    {"overlap", channel::counts, [](const kernel::Pixel& p) { return static_cast<float>(p.overlap); }},
};

// The camera for the picture's header, row-major, as graphics programs expect them: world to camera (x right, y up,
// z to the viewer, eye at the origin), and camera to screen (-1..1 across the height).
void describe_camera(const PreparedFrame& prepared, Image& image) {
    const auto dot = [](Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const Vec3 axes[3] = {prepared.right, prepared.up, prepared.back};
    std::vector<float> world_to_camera(16, 0.0f), camera_to_screen(16, 0.0f);
    for (std::size_t row = 0; row < 3; ++row) {
        world_to_camera[4 * row + 0] = static_cast<float>(axes[row].x);
        world_to_camera[4 * row + 1] = static_cast<float>(axes[row].y);
        world_to_camera[4 * row + 2] = static_cast<float>(axes[row].z);
        world_to_camera[4 * row + 3] =
            static_cast<float>(-dot(axes[row], prepared.center) - (row == 2 ? prepared.eye_to_center : 0));
    }
    world_to_camera[15] = 1;
    const double aspect = static_cast<double>(prepared.frame.width) / prepared.frame.height;
    const double zoom = 2 / prepared.view_size;
    if (prepared.frame.perspective) {
        camera_to_screen[0] = static_cast<float>(prepared.eye_to_center * zoom / aspect);
        camera_to_screen[5] = static_cast<float>(prepared.eye_to_center * zoom);
        camera_to_screen[10] = -1;
        camera_to_screen[14] = -1;
    } else {
        camera_to_screen[0] = static_cast<float>(zoom / aspect);
        camera_to_screen[5] = static_cast<float>(zoom);
        camera_to_screen[10] = static_cast<float>(-zoom);
        camera_to_screen[15] = 1;
    }
    image.matrices["worldToCamera"] = std::move(world_to_camera);
    image.matrices["cameraToScreen"] = std::move(camera_to_screen);
}

/// The tolerance that the settings ask for, in millimetres.
double tolerance_of(const CompiledScene& scene, const Settings& settings) {
    if (settings.tolerance_rule == Tolerance::none) return 0;
    if (settings.tolerance_rule == Tolerance::relative) return relative_tolerance(settings.precision) * 2 * scene.radius;
    if (settings.tolerance_rule == Tolerance::length) {
        if (settings.tolerance >= 0) return settings.tolerance;
        if (scene.tolerance > 0) return scene.tolerance;
    }
    const double of_size = rounding_tolerance(settings.precision) * 2 * scene.radius;
    return std::max(of_size, coordinate_rounding * largest_coordinate(scene.center, scene.radius));
}

/// A line each. A header is no place for thousands.
std::string as_attribute(const std::vector<Warning>& warnings) {
    constexpr std::size_t most_bytes = 4096;
    std::string text;
    for (std::size_t i = 0; i < warnings.size(); ++i) {
        const std::string line = format(warnings[i]);
        if (text.size() + line.size() > most_bytes)
            return text + (i > 0 ? "and " : "") + std::to_string(warnings.size() - i) + (i > 0 ? " more" : " warnings");
        text += line + (i + 1 < warnings.size() ? "\n" : "");
    }
    return text;
}

}  // namespace

struct Renderer::Impl {
    Settings settings;
    CompiledScene scene;
    std::string title;
    std::unique_ptr<ReferenceKernels> kernels;
    std::optional<Reference> reference;
    std::optional<DeviceTakeover> takeover;  // if no reference
    std::vector<Warning> warnings;  // the scene's, and then those of devices, which are not of the picture
    Statistics statistics;
    double search_ms = 0;  // for devices, before there were any
    double built_in_call_ms = 0;

    void set_up_devices();
    void use_reference();
    Pipelines& drawer(bool every_partition);
    void draw(const PreparedFrame& prepared, Pipelines& pipelines, const std::vector<ChannelPlane>& planes,
              Framebuffer& framebuffer);

    void start_call(std::uint64_t rays, int width, int height) {
        Statistics fresh;
        fresh.device = statistics.device;
        fresh.precision = statistics.precision;
        fresh.method = statistics.method;
        fresh.quartic = statistics.quartic;
        fresh.tolerance = statistics.tolerance;
        fresh.contraction = statistics.contraction;
        fresh.ms.compile = statistics.ms.compile;
        fresh.ms.build = statistics.ms.build;
        built_in_call_ms = 0;
        fresh.rays = rays;
        fresh.width = width;
        fresh.height = height;
        statistics = fresh;
    }
    /// What waiting for kernels took of the call is `build`'s.
    void end_call(Clock::time_point start) { statistics.ms.frame = milliseconds_since(start) - built_in_call_ms; }
    /// `built_ms`: what the devices had built when they began with the call.
    void take(const PipelineCounts& c, const Pipelines& pipelines, double built_ms) {
        statistics.hits = c.hits;
        statistics.segments = c.segments;
        statistics.partitions_used = c.partitions_used;
        statistics.partitions_allocated = c.partitions_allocated;
        statistics.overlaps = c.overlaps;
        statistics.segment_bytes = c.segment_bytes;
        statistics.partition_bytes = c.partition_bytes;
        statistics.tiles = c.batches;
        statistics.device_bytes = pipelines.device_bytes();
        statistics.ms.count_hits = c.count_hits;
        statistics.ms.scan = c.scan;
        statistics.ms.store_segments = c.store_segments;
        statistics.ms.weave = c.weave;
        statistics.ms.evaluate = c.evaluate;
        statistics.ms.shade = c.shade;
        statistics.ms.cull_blocks = c.cull_tiles;
        statistics.ms.first_hits = c.first_hits;
        statistics.ms.build = search_ms + pipelines.build_ms();
        built_in_call_ms += pipelines.build_ms() - built_ms;
    }
    void take(const ReferenceCounts& c) {
        statistics.hits = c.hits;
        statistics.segments = c.segments;
        statistics.partitions_used = statistics.partitions_allocated = c.partitions;
        statistics.overlaps = c.overlaps;
        statistics.tiles = 1;
    }
};

Renderer::Renderer(const Scene& scene, const std::vector<std::string>& objects, const Settings& settings)
    : impl_(std::make_unique<Impl>()) {
    if (settings.precision == Precision::quad && !settings.reference)
        throw Error(Status::usage, "113-bit precision is on the reference only: no device has it");
    if (settings.contraction && settings.reference)
        throw Error(Status::usage, "contraction is on a device only: the reference rounds every operation");
    Impl& impl = *impl_;
    impl.settings = settings;
    impl.title = scene.title;
    prepare_devices(settings);
    const auto start = Clock::now();
    impl.scene = compile(scene, objects, {.air = settings.air, .skip_unsupported = settings.skip_unsupported});
    impl.statistics.ms.compile = milliseconds_since(start);
    impl.warnings = impl.scene.warnings;
    impl.statistics.precision = name_of(precision_names, settings.precision);
    if (settings.precision == Precision::quad) impl.statistics.precision = "quad";
    impl.statistics.contraction = settings.contraction;
    impl.statistics.quartic = name_of(quartic_names, settings.quartic);
    impl.statistics.tolerance = tolerance_of(impl.scene, settings);
    settings.reference ? impl.use_reference() : impl.set_up_devices();
}

void Renderer::Impl::use_reference() {
    kernels = make_kernels_to_run(scene, settings.precision, settings.quartic);
    statistics.device = "reference";
    statistics.method = "every solid near the ray, unique lists";
    reference.emplace(scene, *kernels, settings.threads);
}

void Renderer::Impl::set_up_devices() {
    const auto start = Clock::now();
    DevicePlan plan = plan_devices(settings);
    search_ms = milliseconds_since(start);
    kernels = make_kernels(scene, settings.precision, settings.quartic);
    const auto set_up = [this](const std::vector<FoundDevice>& devices) {
        return std::make_unique<Pipelines>(devices, scene, *kernels, settings);
    };
    std::vector<std::string> notes = plan.notes;
    if (!plan.first.empty()) {
        const bool can_do_without = plan.is_default && kernels_for(settings) == Kernels::any;
        try {
            takeover.emplace(std::move(plan), set_up, settings.wait_for_device);
            statistics.device = takeover->present().name();
            statistics.method = exact_method;
            statistics.ms.build = search_ms + takeover->present().build_ms();
            return;
        } catch (const Error& error) {
            if (!can_do_without || error.status() == Status::out_of_memory) throw;
            const std::string what = error.what();
            notes.push_back(what.substr(0, what.find('\n')));
        }
    }
    std::string why =
        "no device draws but the CPU reference, which is slow: csgrt has no kernels of its own for this processor";
    for (const std::string& note : notes) why += "; " + note;
    warnings.push_back({.object = {}, .place = {}, .reason = why});
    use_reference();
}

/// Who draws the next frame, or shoots the next rays.
Pipelines& Renderer::Impl::drawer(bool every_partition) {
    const auto start = Clock::now();
    Pipelines& pipelines = takeover->drawer(every_partition);
    built_in_call_ms += milliseconds_since(start);
    if (auto fault = takeover->take_fault())
        warnings.push_back({.object = {}, .place = {}, .reason = std::move(*fault)});
    statistics.device = pipelines.name();
    return pipelines;
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Image Renderer::render(const View& view) {
    Framebuffer framebuffer;
    render(view, framebuffer);
    return framebuffer.take();
}

void Renderer::Impl::draw(const PreparedFrame& prepared, Pipelines& pipelines, const std::vector<ChannelPlane>& planes,
                          Framebuffer& framebuffer) {
    const std::size_t pixels = std::size_t{prepared.frame.width} * prepared.frame.height;
    if (std::exchange(framebuffer.drawn_by_, pipelines.number()) != pipelines.number())
        framebuffer.known_ = nullptr;
    else if (!framebuffer.known_)
        framebuffer.known_ = pipelines.make_known(planes, pixels);
    const double built_ms = pipelines.build_ms();
    PipelineCounts counts;
    try {
        pipelines.render(prepared, {.planes = planes, .drawn = framebuffer.drawn_, .known = framebuffer.known_.get()},
                         settings.progress, counts);
    } catch (...) {  // pixels may be missing that were said to be there
        std::fill(framebuffer.drawn_.begin(), framebuffer.drawn_.end(), std::uint8_t{1});
        throw;
    }
    take(counts, pipelines, built_ms);
}

void Renderer::render(const View& view, Framebuffer& framebuffer) {
    Impl& impl = *impl_;
    const auto start = Clock::now();
    const PreparedFrame prepared = prepare_frame(impl.scene, view, impl.statistics.tolerance);
    impl.start_call(std::uint64_t(view.width) * std::uint64_t(view.height), view.width, view.height);
    if (!impl.reference) impl.statistics.method = view.every_partition ? exact_method : "first hits, front to back";
    std::vector<const ChannelSource*> wanted;
    for (const ChannelSource& source : channels)
        if (prepared.frame.channels & source.group) wanted.push_back(&source);
    const kernel::Pixel background_pixel = kernel::background_pixel(&prepared.frame);
    std::vector<std::string> names;
    std::vector<float> background;
    for (const ChannelSource* source : wanted) {
        names.emplace_back(source->name);
        background.push_back(source->value(background_pixel));
    }
    const auto fit = [&] { framebuffer.fit(view.width, view.height, std::move(names), std::move(background)); };
    Pipelines* pipelines = nullptr;
    if (!impl.reference && framebuffer.drawn_.empty()) {
        std::future<void> fitting = std::async(fit);
        pipelines = &impl.drawer(view.every_partition);  // the compiler leaves most processors idle
        fitting.get();
    } else {
        if (!impl.reference) pipelines = &impl.drawer(view.every_partition);
        fit();
    }
    Image& image = framebuffer.image_;
    std::vector<ChannelPlane> planes;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        planes.push_back({image.channels[i].data(), framebuffer.background_[i]});
    const std::size_t pixels = std::size_t{prepared.frame.width} * prepared.frame.height;
    if (impl.reference) {
        std::fill(framebuffer.drawn_.begin(), framebuffer.drawn_.end(), std::uint8_t{1});
        framebuffer.drawn_by_ = 0;
        ReferenceCounts counts;
        const std::vector<kernel::Pixel> seen = impl.reference->render(prepared, impl.settings.progress, counts);
        for_chunks(pixels, 16'384, impl.settings.threads, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t c = 0; c < wanted.size(); ++c)
                for (std::size_t i = first; i < last; ++i) planes[c].pixels[i] = wanted[c]->value(seen[i]);
        });
        impl.take(counts);
    } else {
        impl.draw(prepared, *pipelines, planes, framebuffer);
    }
    image.attributes.clear();
    image.attributes["csgrt:version"] = version();
    image.attributes["csgrt:title"] = impl.title;
    image.attributes["csgrt:precision"] = impl.statistics.precision;
    image.attributes["csgrt:method"] = impl.statistics.method + ", quartics " +
                                        impl.statistics.quartic + (impl.settings.contraction ? ", contraction" : "");
    image.attributes["csgrt:scene_hash"] = hexadecimal(impl.scene.hash);
    if (!impl.scene.warnings.empty()) image.attributes["csgrt:warnings"] = as_attribute(impl.scene.warnings);
    describe_camera(prepared, image);
    impl.end_call(start);
}

std::vector<RayPartitions> Renderer::shoot(const std::vector<Ray>& rays) {
    Impl& impl = *impl_;
    const auto start = Clock::now();
    if (rays.size() > std::numeric_limits<std::uint32_t>::max() / 2)
        throw Error(Status::usage, "too many rays in one call: shoot them in parts of at most 2^31");
    bool in_direction = false, any_scaled = false;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (const std::string fault = ray_fault(rays[i].origin, rays[i].direction, in_direction); !fault.empty())
            throw Error(Status::usage, "ray " + std::to_string(i) + ": " + fault);
        any_scaled = any_scaled || exponent_of(rays[i].direction) != 0;
    }
    const PreparedFrame prepared =
        prepare_rays(impl.scene, static_cast<std::uint32_t>(rays.size()), impl.statistics.tolerance);
    impl.kernels->check(rays);
    impl.start_call(rays.size(), 0, 0);
    if (!impl.reference) impl.statistics.method = exact_method;
    std::vector<Ray> scaled;
    if (any_scaled) {
        scaled = rays;
        for (Ray& ray : scaled) ray.direction = times_power(ray.direction, -exponent_of(ray.direction));
    }
    const std::vector<Ray>& shot = any_scaled ? scaled : rays;
    std::vector<RayPartitions> answers;
    if (impl.reference) {
        ReferenceCounts counts;
        answers = impl.reference->shoot(prepared, shot, impl.settings.progress, counts);
        impl.take(counts);
    } else {
        Pipelines& pipelines = impl.drawer(true);
        const double built_ms = pipelines.build_ms();
        PipelineCounts counts;
        answers = pipelines.shoot(prepared, shot, impl.settings.progress, counts);
        impl.take(counts, pipelines, built_ms);
    }
    for (std::size_t i = 0; any_scaled && i < rays.size(); ++i)
        if (const int exponent = exponent_of(rays[i].direction); exponent != 0) scale_distances(answers[i], -exponent);
    impl.end_call(start);
    return answers;
}

std::vector<Ray> Renderer::rays_of(const View& view) const {
    const PreparedFrame prepared = prepare_frame(impl_->scene, view, impl_->statistics.tolerance);
    std::vector<Ray> rays;
    rays.reserve(std::size_t{prepared.frame.width} * prepared.frame.height);
    for (std::uint32_t y = 0; y < prepared.frame.height; ++y)
        for (std::uint32_t x = 0; x < prepared.frame.width; ++x)
            rays.push_back(impl_->kernels->camera_ray(prepared.frame, x, y));
    return rays;
}

const Box& Renderer::bounds() const { return impl_->scene.bounds; }
const std::vector<RegionInfo>& Renderer::regions() const { return impl_->scene.region_info; }
const std::vector<SolidInfo>& Renderer::solids() const { return impl_->scene.solid_info; }
const std::vector<Warning>& Renderer::warnings() const { return impl_->warnings; }

const Statistics& Renderer::statistics() const {
    if (impl_->takeover) impl_->statistics.awaited_device = impl_->takeover->awaited();
    return impl_->statistics;
}

}  // namespace csgrt
