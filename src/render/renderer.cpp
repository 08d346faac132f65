#include <csgrt/renderer.hpp>

#include <algorithm>
#include <cmath>
#include <future>
#include <optional>
#include <utility>

#include "base/clock.hpp"
#include "base/fnv1a.hpp"
#include "base/process.hpp"
#include "base/thread.hpp"
#include "compile/frame.hpp"
#include "compile/lists/along_rays.hpp"
#include "device/choice.hpp"
#include "kernel_host/geometry.hpp"
#include "render/device_backend.hpp"
#include "render/image_header.hpp"
#include "render/model_impl.hpp"
#include "render/reference_backend.hpp"
#include "scene/range.hpp"

namespace csgrt {
struct Renderer::Impl {
    const unsigned process = process_number();  ///< where it works: its threads, and what drivers keep, are there alone
    Settings settings;
    Model model;
    double tolerance = 0;  ///< as kernels get it, in millimetres
    std::shared_ptr<const ModelInUse> in_use;
    std::unique_ptr<Backend> backend;
    std::vector<Warning> warnings;         ///< the scene's, and then those of devices, which are not of the picture
    std::vector<Warning> device_warnings;  ///< these alone
    Statistics statistics;

    Impl(Model of, const Settings& given) : settings(given), model(std::move(of)) {}

    const CompiledScene& scene() const { return model.impl_->scene; }
    void use_model(bool is_reference);
    void warn(std::string reason);
    void set_up_devices();
    void use_reference();
    void start_call(std::uint64_t rays, bool every_partition, int width, int height);
    void prepare(bool every_partition);
    void end_call(Clock::time_point start);
    void render(const View& view, Framebuffer& framebuffer, Watch& watch);
    void trace(const RayList& list, RowTaker& taker, Watch& watch);
    /// Calls work(trace) as a call of the host's. `all`: the rays of several lists that it traces; 0: it traces one.
    template <class Work>
    void call(const Work& work, std::uint64_t all = 0);
};

namespace {

/// Throws Error (usage) for settings that exclude each other.
const Settings& checked(const Settings& settings) {
    if (settings.precision == Precision::quad && !settings.reference)
        throw Error(Status::usage, "113-bit precision is on the reference only: no device has it");
    if (settings.contraction && settings.reference)
        throw Error(Status::usage, "contraction is on a device only: the reference rounds every operation");
    if (settings.contraction && settings.check > 0)
        throw Error(Status::usage, "contraction changes the last digits, which a check by the reference compares");
    return settings;
}

/// Drivers start while a scene is compiled.
Model model_of(const Scene& scene, const std::vector<std::string>& objects, const Settings& settings) {
    prepare_devices(checked(settings));
    return Model(scene, objects, settings);
}

}  // namespace

Renderer::Renderer(const Scene& scene, const std::vector<std::string>& objects, const Settings& settings)
    : Renderer(model_of(scene, objects, settings), settings) {}

Renderer::Renderer(Model model, const Settings& settings) : impl_(new Impl(std::move(model), checked(settings))) {
    const FloatingPoint own;
    const AllowedThreads allowed(settings.threads);
    Impl& impl = *impl_;
    prepare_devices(settings);
    impl.statistics.precision = name_of(precision_names, settings.precision);
    if (settings.precision == Precision::quad) impl.statistics.precision = "quad";
    impl.statistics.contraction = settings.contraction;
    impl.statistics.quartic = name_of(quartic_names, settings.quartic);
    impl.use_model(settings.reference);
    settings.reference ? impl.use_reference() : impl.set_up_devices();
    impl.statistics.device = impl.backend->name();
    impl.statistics.method = impl.backend->method(true);
    impl.backend->report(impl.statistics);
}

/// What the next calls are about.
void Renderer::Impl::use_model(bool is_reference) {
    const std::shared_ptr<const Model::Impl>& compiled = model.impl_;
    in_use = std::make_shared<ModelInUse>(
        ModelInUse{compiled, compiled->scene,
                   is_reference ? make_kernels_to_run(compiled->scene, settings.precision, settings.quartic)
                                : make_kernels(compiled->scene, settings.precision, settings.quartic)});
    statistics.tolerance = tolerance = tolerance_of(compiled->scene, settings);
    statistics.ms.compile = compiled->compile_ms;
    warnings = compiled->scene.warnings;
    warnings.insert(warnings.end(), device_warnings.begin(), device_warnings.end());
}

void Renderer::Impl::warn(std::string reason) {
    device_warnings.push_back({.object = {}, .place = {}, .reason = std::move(reason)});
    warnings.push_back(device_warnings.back());
}

const Model& Renderer::model() const { return impl().model; }

void Renderer::set_model(Model model) {
    const FloatingPoint own;
    Impl& impl = this->impl();
    const AllowedThreads allowed(impl.settings.threads);
    impl.model = std::move(model);
    impl.use_model(impl.backend->is_reference());
    impl.backend->set_model(impl.in_use);
}

void Renderer::Impl::use_reference() {
    use_model(true);
    backend = std::make_unique<ReferenceBackend>(in_use);
}

// Without devices, and where nobody named one, the reference draws, with a warning.
void Renderer::Impl::set_up_devices() {
    const auto start = Clock::now();
    DevicePlan plan = plan_devices(settings);
    const double search_ms = milliseconds_since(start);
    std::vector<std::string> notes = plan.notes;
    if (!plan.first.empty()) {
        const bool can_do_without = plan.is_default && kernels_for(settings) == Kernels::any;
        try {
            backend = std::make_unique<DeviceBackend>(std::move(plan), in_use, settings, search_ms);
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
    warn(std::move(why));
    use_reference();
}

/// Of a new call only the renderer's own figures are known yet, and of one that throws no others.
void Renderer::Impl::start_call(std::uint64_t rays, bool every_partition, int width, int height) {
    Statistics fresh;
    fresh.device = statistics.device;
    fresh.precision = statistics.precision;
    fresh.method = backend->method(every_partition);
    fresh.quartic = statistics.quartic;
    fresh.tolerance = tolerance;
    fresh.contraction = statistics.contraction;
    fresh.ms.compile = statistics.ms.compile;
    fresh.ms.build = statistics.ms.build;
    fresh.rays = rays;
    fresh.width = width;
    fresh.height = height;
    statistics = std::move(fresh);
}

void Renderer::Impl::prepare(bool every_partition) {
    backend->prepare(every_partition);
    statistics.device = backend->name();
    if (auto fault = backend->take_fault()) warn(std::move(*fault));
}

/// What a call waits for kernels counts as `build`.
void Renderer::Impl::end_call(Clock::time_point start) {
    backend->report(statistics);
    statistics.ms.frame = milliseconds_since(start) - backend->build_ms_in_call();
}

void Renderer::Delete::operator()(Impl* impl) const { DeleteOwn{impl->process}(impl); }

Renderer::Impl& Renderer::impl() const {
    if (!impl_) throw Error(Status::usage, "this Renderer was moved from");
    if (impl_->process != process_number())
        throw Error(Status::usage, "this Renderer was made before this process was forked: make a new one");
    return *impl_;
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Image Renderer::render(const View& view) {
    Framebuffer framebuffer;
    render(view, framebuffer);
    return framebuffer.take();
}

void Renderer::render(const View& view, Framebuffer& framebuffer) {
    const FloatingPoint own;
    Impl& impl = this->impl();
    const AllowedThreads allowed(impl.settings.threads);
    Watch::over(own.of_host(impl.settings.progress), [&](Watch& watch) { impl.render(view, framebuffer, watch); });
}

void Renderer::Impl::render(const View& view, Framebuffer& framebuffer, Watch& watch) {
    const auto start = Clock::now();
    const PreparedFrame prepared = prepare_frame(scene(), view, tolerance);
    const bool every_partition = prepared.frame.every_partition;
    start_call(std::uint64_t(view.width) * std::uint64_t(view.height), every_partition, view.width, view.height);
    const kernel::Pixel background_pixel = kernel::background_pixel(&prepared.frame);
    std::vector<const ChannelSource*> sources;
    std::vector<std::string> names;
    std::vector<float> background;
    for (const ChannelSource& source : channel_table) {
        if (!(prepared.frame.channels & source.group)) continue;
        sources.push_back(&source);
        names.emplace_back(source.name);
        background.push_back(source.value(background_pixel));
    }
    const auto fit = [&] { framebuffer.fit(view.width, view.height, std::move(names), std::move(background), watch); };
    if (framebuffer.covered_.empty()) {
        std::future<void> fitting = start_async(fit);
        prepare(every_partition);  // a compiler leaves most processors idle
        fitting.get();
    } else {
        prepare(every_partition);
        fit();
    }
    Image& image = framebuffer.image_;
    std::vector<ChannelMemory> channels;
    for (std::size_t i = 0; i < sources.size(); ++i)
        channels.push_back({image.channels[i].data(), framebuffer.background_[i]});
    try {
        backend->render(
            prepared, {channels, sources, framebuffer.covered_, framebuffer.drawn_by_, framebuffer.registered_}, watch);
    } catch (...) {
        if (framebuffer.registered_ && framebuffer.registered_->has_lost())
            keep_for_ever(std::make_shared<Framebuffer>(std::move(framebuffer)));
        throw;
    }
    image.display_values = settings.display_shading;
    image.attributes.clear();
    image.attributes["csgrt:version"] = version();
    image.attributes["csgrt:title"] = model.impl_->title;
    image.attributes["csgrt:precision"] = statistics.precision;
    image.attributes["csgrt:method"] =
        statistics.method + ", quartics " + statistics.quartic + (settings.contraction ? ", contraction" : "");
    image.attributes["csgrt:shading"] = settings.display_shading ? "display values" : "linear light";
    image.attributes["csgrt:scene_hash"] = hexadecimal(scene().hash);
    if (!scene().warnings.empty()) image.attributes["csgrt:warnings"] = warnings_attribute(scene().warnings);
    describe_camera(prepared, image);
    end_call(start);
}

template <class Work>
void Renderer::Impl::call(const Work& work, std::uint64_t all) {
    const FloatingPoint own;
    const AllowedThreads allowed(settings.threads);
    Watch::over(own.of_host(settings.progress), [&](Watch& watch) {
        if (all > 0) watch.begin_all(all);
        work([&](const RayList& list, RowTaker& taker) { trace(list, taker, watch); });
    });
}

std::vector<RayPartitions> Renderer::shoot(const std::vector<Ray>& rays) {
    std::vector<RayPartitions> answers;
    impl().call([&](const TraceList& trace) {
        const RayList list(rays);
        Partitions all;
        RowSink sink(all, {.solids = true, .normals = true, .overlaps = true}, list.size(), 0);
        trace(list, sink);
        list.restore_lengths(all);
        answers = along_rays(all);
    });
    return answers;
}

void Renderer::partitions(const Rays& rays, Partitions& answer, Fields fields, const RayRanges& ranges) {
    impl().call([&](const TraceList& trace) { find_partitions(RayList(rays, ranges), answer, fields, trace); });
}

void Renderer::partitions(const Rays& rays, const std::function<bool(const Partitions&, std::uint64_t)>& take,
                          Fields fields, const RayRanges& ranges, std::uint64_t most) {
    if (most == 0) throw Error(Status::usage, "a batch must have one ray at least");
    const FloatingPoint own;
    const auto takes = own.of_host(take);
    const auto shoot_batches = [&](const TraceList& trace) {
        const RayList list(rays, ranges);
        Partitions answer;
        bool goes_on = true;
        for (std::uint64_t first = 0; first < list.size() && goes_on; first += most) {
            find_partitions(list.part(first, std::min(most, list.size() - first)), answer, fields, trace);
            goes_on = takes(answer, first);
        }
    };
    impl().call(shoot_batches, rays.size());
}

void Renderer::cast_rays(const Rays& rays, Hits& answer, Fields fields, const RayRanges& ranges) {
    impl().call([&](const TraceList& trace) { find_hits(RayList(rays, ranges), answer, fields, trace); });
}

void Renderer::occluded(const Rays& rays, Array<std::uint8_t>& answer, const RayRanges& ranges) {
    impl().call([&](const TraceList& trace) { find_occluded(RayList(rays, ranges), answer, trace); });
}

void Renderer::region_at(std::span<const Vec3> points, Array<std::int32_t>& answer) {
    impl().call([&](const TraceList& trace) { find_regions(points, answer, trace); });
}

void Renderer::slice(const Slice& slice, Array<std::int32_t>& answer) {
    impl().call([&](const TraceList& trace) { find_pixels(slice, answer, trace); });
}

void Renderer::Impl::trace(const RayList& list, RowTaker& taker, Watch& watch) {
    const auto start = Clock::now();
    kernel::Frame frame = prepare_rays(scene(), static_cast<std::uint32_t>(list.size()), tolerance).frame;
    frame.answer = taker.answer();
    if (list.is_grid()) list.put_camera(frame);
    start_call(list.size(), true, 0, 0);
    prepare(true);
    backend->trace(frame, list, taker, watch);
    backend->check(frame, list, taker, watch);
    end_call(start);
}

std::vector<Ray> Renderer::rays_of(const View& view) const {
    const FloatingPoint own;
    const Impl& impl = this->impl();
    const PreparedFrame prepared = prepare_frame(impl.scene(), view, impl.tolerance);
    std::vector<Ray> rays;
    rays.reserve(std::size_t{prepared.frame.width} * prepared.frame.height);
    for (std::uint32_t y = 0; y < prepared.frame.height; ++y)
        for (std::uint32_t x = 0; x < prepared.frame.width; ++x)
            rays.push_back(impl.in_use->kernels->camera_ray(prepared.frame, x, y));
    return rays;
}

const Box& Renderer::bounds() const { return impl().scene().bounds; }
const std::vector<RegionInfo>& Renderer::regions() const { return impl().scene().region_info; }
const std::vector<SolidInfo>& Renderer::solids() const { return impl().scene().solid_info; }
const std::vector<Warning>& Renderer::warnings() const { return impl().warnings; }

const Statistics& Renderer::statistics() const {
    Impl& impl = this->impl();
    impl.statistics.awaited_device = impl.backend->awaited();
    return impl.statistics;
}

}  // namespace csgrt
