#include <csgrt/renderer.hpp>

#include <utility>

#include "base/laboratory.hpp"
#include "base/thread.hpp"
#include "device/choice.hpp"
#include "device/device_plan.hpp"
#include "device/driver_call.hpp"
#include "rays/along.hpp"
#include "rays/calls.hpp"
#include "rays/frame.hpp"
#include "render/device_backend.hpp"
#include "render/reference_backend.hpp"
#include "render/renderer_impl.hpp"

namespace csgrt {
namespace {

/// Throws Error (usage) for settings that exclude each other.
const Settings& checked(const Settings& settings) {
    check_numbers(settings);
    if (settings.precision == Precision::quad && !settings.reference)
        throw Error(Status::usage, "113-bit precision is on the reference only: no device has it");
    if (laboratory(settings).contraction && settings.reference)
        throw Error(Status::usage, "contraction is on a device only: the reference rounds every operation");
    return settings;
}

/// Makes a Model, while drivers start on another thread.
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
    impl.use_model(settings.reference);
    settings.reference ? impl.use_reference() : impl.set_up_devices();
    impl.statistics.device = impl.backend->name();
    impl.statistics.method = impl.backend->method(true);
    impl.backend->report(impl.statistics);
}

/// Sets the model of this call and the next ones.
void Renderer::Impl::use_model(bool is_reference) {
    in_use = {};
    used(ClaimingRegions::all, is_reference);
    statistics.tolerance = tolerance = tolerance_of(scene(), settings);
    statistics.ms.compile = model.impl_->compile_ms;
}

std::shared_ptr<const ModelInUse> Renderer::Impl::used(ClaimingRegions claims, bool is_reference) {
    const std::shared_ptr<const CompiledScene> owner = Model::Impl::of(model.impl_, claims);
    const CompiledScene& scene = *owner;
    if (&scene == &model.impl_->scene) claims = ClaimingRegions::all;
    std::shared_ptr<const ModelInUse>& use = in_use[static_cast<std::size_t>(claims)];
    if (!use)
        use = std::make_shared<ModelInUse>(ModelInUse{owner, scene,
                                                      is_reference ? nullptr : make_converter(scene, settings),
                                                      is_reference ? make_kernels_to_run(scene, settings) : nullptr});
    return use;
}

/// Takes the next model at the beginning of a call. The call keeps it, even if another model is set meanwhile.
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
}

Model Renderer::model() const {
    Impl& impl = this->impl();
    const std::lock_guard lock(impl.mutex);
    return impl.next;
}

void Renderer::set_model(Model model) {
    Impl& impl = this->impl();
    const std::lock_guard lock(impl.mutex);
    std::swap(impl.next, model);  // the old model is destroyed after the lock is released
    impl.has_next = true;
}

void Renderer::Impl::use_reference() {
    use_model(true);
    backend = std::make_unique<ReferenceBackend>(used(ClaimingRegions::all, true));
}

// If there is no device, and the user named none, the reference draws, with a warning.
void Renderer::Impl::set_up_devices() {
    const auto start = Clock::now();
    DevicePlan plan = plan_devices(settings);
    const double search_ms = milliseconds_since(start);
    std::vector<std::string> notes = plan.notes;
    if (!plan.first.empty()) {
        const bool can_do_without = plan.is_default && kernels_for(settings) == Kernels::any;
        try {
            backend = std::make_unique<DeviceBackend>(std::move(plan), used(ClaimingRegions::all, false), settings,
                                                      search_ms);
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

/// Resets the statistics at the start of a call. Until the call ends, they have only the renderer's own numbers; if it
/// throws, they have no others.
void Renderer::Impl::start_call(std::uint64_t rays, bool every_partition, int width, int height) {
    Statistics fresh;
    fresh.device = statistics.device;
    fresh.precision = statistics.precision;
    fresh.method = backend->method(every_partition);
    fresh.tolerance = tolerance;
    fresh.ms.compile = statistics.ms.compile;
    fresh.ms.build = statistics.ms.build;
    fresh.rays = rays;
    fresh.width = width;
    fresh.height = height;
    statistics = std::move(fresh);
}

void Renderer::Impl::prepare(bool every_partition, ClaimingRegions claims) {
    backend->set_model(used(claims, backend->is_reference()));
    backend->prepare(every_partition);
    statistics.device = backend->name();
    if (auto fault = backend->take_fault()) warn(std::move(*fault));
}

/// Time in which a call waits for kernels counts as `build`, not as `frame`.
void Renderer::Impl::end_call(Clock::time_point start) {
    backend->report(statistics);
    statistics.ms.frame = milliseconds_since(start) - backend->build_ms_in_call();
}

void Renderer::Delete::operator()(Impl* impl) const { DeleteInCall{{impl->process}, impl->uses_drivers}(impl); }

Renderer::Impl& Renderer::impl() const {
    if (!impl_) throw Error(Status::usage, "this Renderer was moved from");
    if (impl_->process != process_number())
        throw Error(Status::usage, "this Renderer was made before this process was forked: make a new one");
    return *impl_;
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

/// The tracer of one call.
class Renderer::Impl::WatchedTracer final : public ListTracer {
public:
    WatchedTracer(Impl& impl, Watch& watch) : impl_(impl), watch_(watch) {}
    void trace(const RayList& list, RowReceiver& receiver, ClaimingRegions claims) const override {
        impl_.trace(list, receiver, claims, watch_);
    }

private:
    Impl& impl_;
    Watch& watch_;
};

template <class Work>
void Renderer::Impl::call(const Work& work, std::uint64_t all) {
    const FloatingPoint own;
    const AllowedThreads allowed(settings.threads);
    Watch::over(own.of_host(settings.progress), [&](Watch& watch) {
        take_next();
        if (all > 0) watch.begin_all(all);
        work(WatchedTracer(*this, watch));
    });
}

std::vector<RayPartitions> Renderer::shoot(const std::vector<Ray>& rays) {
    Partitions all;
    partitions(rays, all, all_fields, {.all = whole_line});
    const FloatingPoint own;
    const AllowedThreads allowed(impl().settings.threads);
    return along_rays(all);
}

void Renderer::partitions(const Rays& rays, Partitions& answer, Fields fields, const RayRanges& ranges) {
    impl().call([&](const ListTracer& tracer) { find_partitions(RayList(rays, ranges), answer, fields, tracer); });
}

void Renderer::partitions(const Rays& rays, const std::function<bool(const Partitions&, std::uint64_t)>& take,
                          Fields fields, const RayRanges& ranges, std::uint64_t most) {
    if (most == 0) throw Error(Status::usage, "a batch must have one ray at least");
    const FloatingPoint own;
    const auto takes = own.of_host(take);
    const auto shoot_batches = [&](const ListTracer& tracer) {
        const RayList list(rays, ranges);
        Partitions answer;
        bool goes_on = true;
        for (std::uint64_t first = 0; first < list.size() && goes_on; first += most) {
            find_partitions(list.part(first, std::min(most, list.size() - first)), answer, fields, tracer);
            goes_on = takes(answer, first);
        }
    };
    impl().call(shoot_batches, rays.size());
}

void Renderer::cast_rays(const Rays& rays, Hits& answer, Fields fields, const RayRanges& ranges) {
    impl().call([&](const ListTracer& tracer) { find_hits(RayList(rays, ranges), answer, fields, tracer); });
}

void Renderer::occluded(const Rays& rays, Array<std::uint8_t>& answer, const RayRanges& ranges) {
    impl().call([&](const ListTracer& tracer) { find_occluded(RayList(rays, ranges), answer, tracer); });
}

void Renderer::region_at(std::span<const Vec3> points, Array<std::int32_t>& answer) {
    impl().call([&](const ListTracer& tracer) { find_regions(points, answer, tracer); });
}

void Renderer::slice(const Slice& slice, Array<std::int32_t>& answer) {
    impl().call([&](const ListTracer& tracer) { find_pixels(slice, answer, tracer); });
}

void Renderer::Impl::trace(const RayList& list, RowReceiver& receiver, ClaimingRegions claims, Watch& watch) {
    const auto start = Clock::now();
    const kernel::Frame frame = frame_of(scene(), list, receiver, tolerance);
    start_call(list.size(), true, 0, 0);
    prepare(true, claims);
    backend->trace(frame, list, receiver, watch);
    backend->check(frame, list, receiver, watch);
    end_call(start);
}

const std::vector<Warning>& Renderer::device_warnings() const { return impl().device_warnings; }

const Statistics& Renderer::statistics() const {
    Impl& impl = this->impl();
    impl.statistics.awaited_device = impl.backend->awaited();
    return impl.statistics;
}

}  // namespace csgrt
