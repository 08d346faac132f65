#include <csgrt/renderer.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <future>
#include <mutex>
#include <optional>
#include <utility>

#include "base/clock.hpp"
#include "base/display_bytes.hpp"
#include "base/fnv1a.hpp"
#include "base/parallel.hpp"
#include "base/process.hpp"
#include "base/thread.hpp"
#include "compile/frame.hpp"
#include "compile/lists/along_rays.hpp"
#include "device/choice.hpp"
#include "device/device_plan.hpp"
#include "device/driver_call.hpp"
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
    bool uses_drivers = false;
    Model model;                                              ///< of the calls; another may be next
    double tolerance = 0;                                     ///< as kernels get it, in millimetres
    std::array<std::shared_ptr<const ModelInUse>, 3> in_use;  ///< by Claims; null: not needed yet
    std::unique_ptr<Backend> backend;
    std::vector<Warning> warnings;         ///< the scene's, and then those of devices, which are not of the picture
    std::vector<Warning> device_warnings;  ///< these alone
    Statistics statistics;

    Impl(Model of, const Settings& given) : settings(given), model(std::move(of)), next(model) {}

    std::mutex mutex;                   ///< of the next two
    Model next;                         ///< what the next call is about
    std::atomic<bool> has_next{false};  ///< it is not `model`

    const CompiledScene& scene() const { return model.impl_->scene; }
    void use_model(bool is_reference);
    void take_next();
    std::shared_ptr<const ModelInUse> used(Claims claims, bool is_reference);
    void warn(std::string reason);
    void set_up_devices();
    void use_reference();
    void start_call(std::uint64_t rays, bool every_partition, int width, int height);
    void prepare(bool every_partition, Claims claims);
    void end_call(Clock::time_point start);
    Framebuffer beside;  ///< of rays beside the pixels' own

    void fit(Framebuffer& framebuffer, const kernel::Frame& frame, std::uint32_t channels, const Watch& watch) const;
    void draw(const PreparedFrame& prepared, Framebuffer& framebuffer, Watch& watch);
    const Image& draw_beside(const View& view, const Sampling& sampling, std::uint32_t channels, Watch& watch);
    bool draw_coarse(const View& view, const PreparedFrame& prepared, Framebuffer& framebuffer,
                     const std::function<bool(int)>& coarse, Watch& watch);
    void add_samples(const View& view, const PreparedFrame& prepared, Framebuffer& framebuffer, Watch& watch);
    void add_ghosts(const View& view, const PreparedFrame& prepared, Framebuffer& framebuffer, Watch& watch);
    std::uint32_t word_of(const float (&color)[4]) const;
    void render(const View& view, Framebuffer& framebuffer, const std::function<bool(int)>& coarse, Watch& watch);
    void trace(const RayList& list, RowTaker& taker, Claims claims, Watch& watch);
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
Model model_of(Scene scene, const std::vector<std::string>& objects, const Settings& settings) {
    prepare_devices(checked(settings));
    return Model(std::move(scene), objects, settings);
}

}  // namespace

Renderer::Renderer(Scene scene, const std::vector<std::string>& objects, const Settings& settings)
    : Renderer(model_of(std::move(scene), objects, settings), settings) {}

Renderer::Renderer(Model model, const Settings& settings) : impl_(new Impl(std::move(model), checked(settings))) {
    const FloatingPoint own;
    const AllowedThreads allowed(settings.threads);
    Impl& impl = *impl_;
    impl.uses_drivers = may_use_drivers(settings);
    const DriverCall driver_call(impl.uses_drivers);
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

/// What this call and the next ones are about.
void Renderer::Impl::use_model(bool is_reference) {
    in_use = {};
    used(Claims::all, is_reference);
    statistics.tolerance = tolerance = tolerance_of(scene(), settings);
    statistics.ms.compile = model.impl_->compile_ms;
    warnings = scene().warnings;
    warnings.insert(warnings.end(), device_warnings.begin(), device_warnings.end());
}

std::shared_ptr<const ModelInUse> Renderer::Impl::used(Claims claims, bool is_reference) {
    const std::shared_ptr<const Model::Impl>& compiled = model.impl_;
    const CompiledScene& scene = compiled->of(claims);
    if (&scene == &compiled->scene) claims = Claims::all;
    std::shared_ptr<const ModelInUse>& use = in_use[static_cast<std::size_t>(claims)];
    if (!use)
        use = std::make_shared<ModelInUse>(
            ModelInUse{compiled, scene,
                       is_reference ? make_kernels_to_run(scene, settings.precision, settings.quartic)
                                    : make_kernels(scene, settings.precision, settings.quartic)});
    return use;
}

/// At the begin of a call, which keeps its model whatever comes meanwhile.
void Renderer::Impl::take_next() {
    if (!has_next) return;
    {
        const std::lock_guard lock(mutex);
        model = next;
        has_next = false;
    }
    use_model(backend->is_reference());
}

void Renderer::Impl::warn(std::string reason) {
    device_warnings.push_back({.object = {}, .place = {}, .reason = std::move(reason)});
    warnings.push_back(device_warnings.back());
}

Model Renderer::model() const {
    Impl& impl = this->impl();
    const std::lock_guard lock(impl.mutex);
    return impl.next;
}

void Renderer::set_model(Model model) {
    Impl& impl = this->impl();
    const std::lock_guard lock(impl.mutex);
    std::swap(impl.next, model);  // the old one goes when the lock does not hold any more
    impl.has_next = true;
}

void Renderer::Impl::use_reference() {
    use_model(true);
    backend = std::make_unique<ReferenceBackend>(used(Claims::all, true));
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
            backend = std::make_unique<DeviceBackend>(std::move(plan), used(Claims::all, false), settings, search_ms);
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

void Renderer::Impl::prepare(bool every_partition, Claims claims) {
    backend->set_model(used(claims, backend->is_reference()));
    backend->prepare(every_partition);
    statistics.device = backend->name();
    if (auto fault = backend->take_fault()) warn(std::move(*fault));
}

/// What a call waits for kernels counts as `build`.
void Renderer::Impl::end_call(Clock::time_point start) {
    backend->report(statistics);
    statistics.ms.frame = milliseconds_since(start) - backend->build_ms_in_call();
}

void Renderer::Delete::operator()(Impl* impl) const {
    const DriverCall driver_call(impl->process == process_number() && impl->uses_drivers);
    DeleteOwn{impl->process}(impl);
}

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

void Renderer::render(const View& view, Framebuffer& framebuffer, const std::function<bool(int)>& coarse) {
    const FloatingPoint own;
    Impl& impl = this->impl();
    const AllowedThreads allowed(impl.settings.threads);
    const std::function<bool(int)> shows = own.of_host(coarse);
    Watch::over(own.of_host(impl.settings.progress),
                [&](Watch& watch) { impl.render(view, framebuffer, shows, watch); });
}

/// Makes the framebuffer a picture of these channels, in memory that is background where it is new.
void Renderer::Impl::fit(Framebuffer& framebuffer, const kernel::Frame& frame, std::uint32_t channels,
                         const Watch& watch) const {
    const kernel::Pixel background_pixel = kernel::background_pixel(&frame);
    std::vector<std::string> names;
    std::vector<bool> are_ids;
    std::vector<float> background;
    for (const ChannelSource& source : channel_table) {
        if (!(channels & source.group)) continue;
        names.emplace_back(source.name);
        are_ids.push_back(holds_ids(source));
        background.push_back(source.value(background_pixel, scene().display[0]));
    }
    framebuffer.fit(static_cast<int>(frame.width), static_cast<int>(frame.height), std::move(names),
                    std::move(background), watch);
    framebuffer.image_.are_ids = std::move(are_ids);
}

/// The frame's channels, which the framebuffer has.
void Renderer::Impl::draw(const PreparedFrame& prepared, Framebuffer& framebuffer, Watch& watch) {
    std::vector<const ChannelSource*> sources;
    std::vector<ChannelMemory> channels;
    for (const ChannelSource& source : channel_table) {
        if (!(prepared.frame.channels & source.group)) continue;
        const std::size_t i = sources.size();  // they come first
        sources.push_back(&source);
        channels.push_back({framebuffer.image_.channels[i].data(), framebuffer.background_[i]});
    }
    try {
        backend->render(
            prepared, {channels, sources, framebuffer.covered_, framebuffer.drawn_by_, framebuffer.registered_}, watch);
    } catch (...) {
        if (framebuffer.registered_ && framebuffer.registered_->has_lost())
            keep_for_ever(std::make_shared<Framebuffer>(std::move(framebuffer)));
        throw;
    }
}

/// What other rays of the view show, in memory of the renderer's own.
const Image& Renderer::Impl::draw_beside(const View& view, const Sampling& sampling, std::uint32_t channels,
                                         Watch& watch) {
    PreparedFrame prepared = prepare_frame(scene(), view, tolerance, sampling);
    prepared.frame.channels = channels;
    fit(beside, prepared.frame, channels, watch);
    draw(prepared, beside, watch);
    return beside.image_;
}

/// Every 8th pixel each way, then what is missing for every 4th, 2nd and all; what is drawn of one step covers what is
/// to come. False: `coarse` ended it.
bool Renderer::Impl::draw_coarse(const View& view, const PreparedFrame& prepared, Framebuffer& framebuffer,
                                 const std::function<bool(int)>& coarse, Watch& watch) {
    Image& image = framebuffer.image_;
    std::ranges::fill(framebuffer.covered_, std::uint8_t{1});
    const auto put = [&](const Sampling& sampling, std::size_t size) {
        if (sampling.column >= image.width || sampling.line >= image.height) return;
        const Image& part = draw_beside(view, sampling, prepared.frame.channels, watch);
        const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
        const auto columns = static_cast<std::size_t>(part.width), step = static_cast<std::size_t>(sampling.step);
        for_chunks(static_cast<std::size_t>(part.height), 4, 0, [&](std::size_t line, std::size_t end, std::size_t) {
            for (; line < end; ++line)
                for (std::size_t c = 0; c < part.channels.size(); ++c) {
                    const std::size_t top = static_cast<std::size_t>(sampling.line) + line * step;
                    float* const first = image.channels[c].data() + top * width;
                    const float* from = part.channels[c].data() + line * columns;
                    for (std::size_t x = static_cast<std::size_t>(sampling.column); x < width; x += step)
                        std::fill_n(first + x, std::min(size, width - x), *from++);
                    for (std::size_t y = top + 1; y < std::min(top + size, height); ++y)
                        for (std::size_t x = static_cast<std::size_t>(sampling.column); x < width; x += step)
                            std::copy_n(first + x, std::min(size, width - x), first + (y - top) * width + x);
                }
        });
    };
    put({.step = 8}, 8);
    for (int size = 4; size >= 1; size /= 2) {
        if (!coarse(2 * size)) return false;
        const int step = size == 4 ? 8 : 2 * size;
        put({.step = step, .column = size, .line = 0}, static_cast<std::size_t>(size));
        put({.step = step, .column = 0, .line = size}, static_cast<std::size_t>(size));
        put({.step = step, .column = size, .line = size}, static_cast<std::size_t>(size));
    }
    return true;
}

/// The colours become the mean of several rays' a pixel: Hammersley's points, moved so that the first is the middle.
void Renderer::Impl::add_samples(const View& view, const PreparedFrame& prepared, Framebuffer& framebuffer,
                                 Watch& watch) {
    Image& image = framebuffer.image_;
    const bool has_color = prepared.frame.channels & channel::color;
    const std::size_t pixels = std::size_t{prepared.frame.width} * prepared.frame.height;
    Channels sums(pixels, std::vector<float>(4));
    const auto take = [&](const Image& drawn) {
        for_chunks(pixels, 1 << 16, 0, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t c = 0; c < 4; ++c)
                for (std::size_t i = first; i < last; ++i) sums[c][i] += drawn.channels[c][i];
        });
    };
    for (int i = 0; i < view.samples; ++i) {
        const auto from_middle = [](double part) { return part < 0.5 ? part : part - 1; };
        double reversed = 0;  // the binary digits of i, behind the point
        for (int bit = 0; bit < 8; ++bit) reversed += (i >> bit & 1) * std::ldexp(1.0, -1 - bit);
        const Sampling sampling{.right = from_middle(static_cast<double>(i) / view.samples),
                                .down = from_middle(reversed)};
        take(i == 0 && has_color ? image : draw_beside(view, sampling, channel::color, watch));
        for (std::size_t tile = 0; i > 0 && tile < beside.covered_.size(); ++tile)
            framebuffer.covered_[tile] |= beside.covered_[tile];
    }
    const auto words = std::ranges::find(image.names, "RGBA8");
    const std::span<std::uint32_t> display =
        words == image.names.end() ? std::span<std::uint32_t>()
                                   : image.channels.ids(static_cast<std::size_t>(words - image.names.begin()));
    for_chunks(pixels, 1 << 14, 0, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            float mean[4];
            for (std::size_t c = 0; c < 4; ++c) {
                mean[c] = sums[c][i] / static_cast<float>(view.samples);
                if (has_color) image.channels[c][i] = mean[c];
            }
            if (!display.empty()) display[i] = word_of(mean);
        }
    });
}

/// A colour for a display, as display_pixels() has it.
std::uint32_t Renderer::Impl::word_of(const float (&color)[4]) const {
    const double alpha = color[3], weight = alpha > 0 ? alpha : 1;
    std::uint32_t word = std::uint32_t{display_byte(alpha, true)} << 24;
    for (int c = 0; c < 3; ++c)
        word |= std::uint32_t{display_byte(color[c] / weight, scene().display_shading)} << 8 * c;
    return word;
}

/// Where a ghost would be seen before what is.
void Renderer::Impl::add_ghosts(const View& view, const PreparedFrame& prepared, Framebuffer& framebuffer,
                                Watch& watch) {
    Image& image = framebuffer.image_;
    const std::span<std::uint32_t> ghosts = image.channels.ids(image.channels.size() - 1);
    std::ranges::fill(ghosts, 0u);
    if (!model.impl_->has_ghosts()) return;
    std::vector<float> seen;
    if (!(prepared.frame.channels & channel::distance)) {
        const Image& shown = draw_beside(view, {}, channel::distance, watch);
        seen.assign(shown.channels[0].begin(), shown.channels[0].end());
    }
    const std::span<const float> distances = seen.empty() ? image.channel("Z") : std::span<const float>(seen);
    prepare(prepared.frame.every_partition, Claims::ghosts);
    const Image& passed = draw_beside(view, {}, channel::distance | channel::ids, watch);
    const std::span<const std::uint32_t> regions = passed.ids("region");
    for (std::size_t i = 0; i < ghosts.size(); ++i)
        if (passed.channels[0][i] < distances[i]) ghosts[i] = regions[i];
    std::ranges::fill(framebuffer.covered_, std::uint8_t{1});
}

void Renderer::Impl::render(const View& view, Framebuffer& framebuffer, const std::function<bool(int)>& coarse,
                            Watch& watch) {
    const auto start = Clock::now();
    take_next();
    const PreparedFrame prepared = prepare_frame(scene(), view, tolerance);
    const bool every_partition = prepared.frame.every_partition;
    start_call(std::uint64_t{prepared.frame.width} * prepared.frame.height, every_partition,
               static_cast<int>(prepared.frame.width), static_cast<int>(prepared.frame.height));
    const auto fit_picture = [&] {
        fit(framebuffer, prepared.frame, prepared.frame.channels | (view.channels & channel::ghosts), watch);
    };
    if (framebuffer.covered_.empty()) {
        std::future<void> fitting = start_async(fit_picture);
        prepare(every_partition, Claims::shown);  // a compiler leaves most processors idle
        fitting.get();
    } else {
        prepare(every_partition, Claims::shown);
        fit_picture();
    }
    bool is_whole = true;
    if (coarse)
        is_whole = draw_coarse(view, prepared, framebuffer, coarse, watch);
    else
        draw(prepared, framebuffer, watch);
    if (view.samples > 1 && is_whole && (prepared.frame.channels & (channel::color | channel::display)))
        add_samples(view, prepared, framebuffer, watch);
    if (view.channels & channel::ghosts) add_ghosts(view, prepared, framebuffer, watch);
    Image& image = framebuffer.image_;
    image.display_values = settings.display_shading;
    image.attributes.clear();
    image.attributes["csgrt:version"] = version();
    image.attributes["csgrt:title"] = model.impl_->source.scene->title;
    image.attributes["csgrt:precision"] = statistics.precision;
    image.attributes["csgrt:method"] =
        statistics.method + ", quartics " + statistics.quartic + (settings.contraction ? ", contraction" : "");
    image.attributes["csgrt:shading"] = settings.display_shading ? "display values" : "linear light";
    image.attributes["csgrt:scene_hash"] = hexadecimal(model.impl_->of(Claims::shown).hash);
    if (!scene().warnings.empty()) image.attributes["csgrt:warnings"] = warnings_attribute(scene().warnings);
    describe_camera(prepared, image);
    end_call(start);
}

template <class Work>
void Renderer::Impl::call(const Work& work, std::uint64_t all) {
    const FloatingPoint own;
    const AllowedThreads allowed(settings.threads);
    Watch::over(own.of_host(settings.progress), [&](Watch& watch) {
        take_next();
        if (all > 0) watch.begin_all(all);
        work([&](const RayList& list, RowTaker& taker, Claims claims) { trace(list, taker, claims, watch); });
    });
}

std::vector<RayPartitions> Renderer::shoot(const std::vector<Ray>& rays) {
    std::vector<RayPartitions> answers;
    impl().call([&](const TraceList& trace) {
        const RayList list(rays);
        Partitions all;
        RowSink sink(all, {.solids = true, .normals = true, .overlaps = true}, list.size(), 0);
        trace(list, sink, Claims::all);
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

void Renderer::Impl::trace(const RayList& list, RowTaker& taker, Claims claims, Watch& watch) {
    const auto start = Clock::now();
    kernel::Frame frame = prepare_rays(scene(), static_cast<std::uint32_t>(list.size()), tolerance).frame;
    frame.answer = taker.answer();
    if (list.is_grid()) list.put_camera(frame);
    start_call(list.size(), true, 0, 0);
    prepare(true, claims);
    backend->trace(frame, list, taker, watch);
    backend->check(frame, list, taker, watch);
    end_call(start);
}

std::vector<Ray> Renderer::rays_of(const View& view) const {
    const FloatingPoint own;
    Impl& impl = latest();
    const PreparedFrame prepared = prepare_frame(impl.scene(), view, impl.tolerance);
    std::vector<Ray> rays;
    rays.reserve(std::size_t{prepared.frame.width} * prepared.frame.height);
    const auto use = impl.used(Claims::all, impl.backend->is_reference());
    for (std::uint32_t y = 0; y < prepared.frame.height; ++y)
        for (std::uint32_t x = 0; x < prepared.frame.width; ++x)
            rays.push_back(use->kernels->camera_ray(prepared.frame, x, y));
    return rays;
}

const Box& Renderer::bounds() const { return latest().scene().bounds; }
const std::vector<RegionInfo>& Renderer::regions() const { return latest().scene().region_info; }
const std::vector<SolidInfo>& Renderer::solids() const { return latest().scene().solid_info; }
const std::vector<Warning>& Renderer::warnings() const { return latest().warnings; }

Renderer::Impl& Renderer::latest() const {
    Impl& impl = this->impl();
    impl.take_next();
    return impl;
}

const Statistics& Renderer::statistics() const {
    Impl& impl = this->impl();
    impl.statistics.awaited_device = impl.backend->awaited();
    return impl.statistics;
}

}  // namespace csgrt
