#include <csgrt/model.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/clock.hpp"
#include "base/floating_point.hpp"
#include "base/thread.hpp"
#include "compile/frame.hpp"
#include "compile/linear.hpp"
#include "compile/regions/claimed_by.hpp"
#include "device/host_memory.hpp"
#include "form/requests.hpp"
#include "kernel_host/geometry.hpp"
#include "rays/along.hpp"
#include "rays/calls.hpp"
#include "rays/frame.hpp"
#include "rays/grid.hpp"
#include "render/model_impl.hpp"
#include "scene/range.hpp"
#include "scene/vector.hpp"

namespace csgrt {

void check_numbers(const Settings& settings) {
    form::for_members(form::of<Settings>, [&](const auto& member) {
        using Kind = std::remove_cvref_t<decltype(member.kind)>;
        const auto refuse = [&](const std::string& number, const std::string& expected) {
            throw Error(Status::usage, "the setting " + std::string(member.key.member) + " is " + number +
                                           ", and must be " + expected);
        };
        if constexpr (std::is_same_v<Kind, form::Number>) {
            if (const double number = settings.*member.at; !std::isfinite(number))
                refuse(number_text(number), "a finite number; -1 is the default");
        } else if constexpr (std::is_same_v<Kind, form::Amount>) {
            const std::uint64_t number = settings.*member.at, low = member.kind.low, high = member.kind.high;
            if (number != 0 && (number < low || number > high))
                refuse(std::to_string(number),
                       "from " + std::to_string(low) + " to " + std::to_string(high) + ", or 0, the default");
        } else {
            static_cast<void>(refuse);
        }
    });
}

double tolerance_of(const CompiledScene& scene, const Settings& settings) {
    if (settings.tolerance_rule == Tolerance::none) return 0;
    if (settings.tolerance_rule == Tolerance::relative)
        return relative_tolerance(settings.precision) * 2 * scene.radius;
    if (settings.tolerance_rule == Tolerance::length) {
        if (settings.tolerance >= 0) return settings.tolerance;
        if (scene.tolerance > 0) return scene.tolerance;
    }
    const double of_size = rounding_tolerance(settings.precision) * 2 * scene.radius;
    return std::max(of_size, coordinate_rounding * largest_coordinate(scene.center, scene.radius));
}

namespace {

/// The most instances of which a compilation is kept, which takes half a kilobyte each.
constexpr std::size_t most_kept = 250'000;

CompiledScene compiled(const ModelSource& source) {
    const Settings& settings = source.settings;
    check_numbers(settings);
    auto made = std::make_unique<Compilation>(source.scene, source.objects,
                                              CompileOptions{.air = settings.air,
                                                             .skip_unsupported = settings.skip_unsupported,
                                                             .display_shading = settings.display_shading,
                                                             .max_instances = settings.max_instances},
                                              most_kept);
    CompiledScene scene = made->compiled();
    if (!made->is_kept()) made = nullptr;
    if (const std::unique_lock lock(source.kept->mutex, std::try_to_lock); lock) {
        if (source.kept->of != nullptr) std::swap(source.kept->of, source.kept->other);
        std::swap(source.kept->of, made);
    }
    return scene;
}

double tolerance_in_double(const CompiledScene& scene, Settings settings) {
    settings.precision = Precision::double_;
    return tolerance_of(scene, settings);
}

}  // namespace

Model::Impl::Impl(ModelSource of) : source(std::move(of)), compile_ms(0) {
    const auto start = Clock::now();
    scene = compiled(source);
    compile_ms = milliseconds_since(start);
    tolerance = tolerance_in_double(scene, source.settings);
    all_.emplace(scene, tolerance);
}

Model::Impl::Impl(ModelSource of, CompiledScene made, const Impl& before)
    : source(std::move(of)), scene(std::move(made)), tolerance(before.tolerance), compile_ms(before.compile_ms) {
    all_.emplace(scene, tolerance);
}

bool Model::Impl::has(State state) const {
    return std::ranges::find(scene.states, static_cast<std::uint8_t>(state)) != scene.states.end();
}

std::shared_ptr<const CompiledScene> Model::Impl::claimed(State by) const {
    const std::lock_guard lock(mutex_);
    std::weak_ptr<const CompiledScene>& known = claimed_[by == State::ghost];
    std::shared_ptr<const CompiledScene> found = known.lock();
    if (!found) known = found = std::make_shared<const CompiledScene>(claimed_by(scene, by));
    return found;
}

void Model::Impl::trace(const RayList& list, RowReceiver& receiver, ClaimingRegions claims) const {
    if (claims == ClaimingRegions::all || shows_all()) return all_->trace(list, receiver);
    std::call_once(has_shown_, [&] {
        shown_scene_ = claimed(State::shown);
        shown_.emplace(*shown_scene_, tolerance);
    });
    shown_->trace(list, receiver);
}

Model::Model(Scene scene, const std::vector<std::string>& objects, const Settings& settings) {
    const FloatingPoint own;
    const AllowedThreads allowed(settings.threads);
    ModelSource source{.scene = std::make_shared<const Scene>(std::move(scene)),
                       .objects = objects,
                       .settings = settings,
                       .kept = std::make_shared<KeptCompilation>()};
    source.settings.progress = nullptr;
    source.looks = source.scene->looks;
    source.lights = source.scene->lights;
    source.ambient = source.scene->ambient;
    source.background = source.scene->background;
    impl_ = std::make_shared<Impl>(std::move(source));
}

const CompiledScene& compiled_scene(const Model& model) { return model.impl_->scene; }

const Box& Model::bounds() const { return impl_->scene.bounds; }
const SharedList<RegionInfo>& Model::regions() const { return impl_->scene.region_info; }
const SharedList<SolidInfo>& Model::solids() const { return impl_->scene.solid_info; }
const std::vector<Warning>& Model::warnings() const { return impl_->scene.warnings; }
double Model::tolerance() const { return impl_->tolerance; }

Scene Model::scene() const {
    Scene scene = changed_scene(*impl_->source.scene, impl_->source.changes, impl_->source.objects);
    impl_->source.put_appearance(scene);
    return scene;
}

const NativeTracer* CallerTracer::native() const {
    std::call_once(has_native_, [this] {
        for (const native::Level& level : native::compiled_levels())
            if (native::can_run(level.name)) {
                native_.emplace(level, scene_, host_memory() / 2);
                break;
            }
    });
    return native_ ? &*native_ : nullptr;
}

const Reference& CallerTracer::reference() const {
    std::call_once(has_reference_, [this] {
        kernels_ = make_kernels_to_run(scene_);
        reference_.emplace(scene_, *kernels_);
    });
    return *reference_;
}

void CallerTracer::trace(const RayList& list, RowReceiver& receiver) const {
    const kernel::Frame frame = frame_of(scene_, list, receiver, tolerance_);
    if (const NativeTracer* const tracer = native()) {
        PipelineCounts counts;
        tracer->trace(frame, list, 0, list.size(), nullptr, receiver, counts);
    } else {
        ReferenceCounts counts;
        reference().trace(frame, list, receiver, nullptr, counts);
    }
}

RayGrid Model::grid_of(const View& view) const {
    const FloatingPoint own;
    View whole = view;
    whole.part = {};
    return csgrt::grid_of(prepare_frame(impl_->scene, whole, impl_->tolerance).frame);
}

Pick Model::pick(const View& view, int column, int row) const {
    Pick pick;
    pick.ray = ray_of(view, column, row);
    const kernel::Frame frame = prepare_frame(impl_->scene, view, impl_->tolerance).frame;
    const auto [o, d] = pick.ray;
    const kernel::view_range range = kernel::range_in_view(&frame, {{o.x, o.y, o.z}, {d.x, d.y, d.z}});
    const std::uint32_t seen_end = impl_->scene.rank_ends[RANK_AIR];  // after it come lights that no picture shows
    impl_->call([&](const ListTracer& tracer) {
        RayList list(pick.ray, {.all = whole_line});
        const auto along = [&](ClaimingRegions claims) {
            Partitions all;
            RowCollector receiver(all, all_fields, 1);
            tracer.trace(list, receiver, claims);
            return std::move(along_rays(all).front());
        };
        pick.along = along(ClaimingRegions::all);
        if (range.in_plane) list.cut_by({frame.clip, frame.clip_count});
        const RayPartitions shown = !impl_->shows_all() || range.in_plane ? along(ClaimingRegions::shown) : pick.along;
        for (const Partition& p : shown.partitions) {
            if (p.region >= seen_end || !(p.out > range.after)) continue;
            if (!(p.in < range.before && range.after < range.before)) break;
            const bool is_cut = range.plane != NO_PLANE && p.in < range.near;
            const kernel::PlaneRecord& plane = frame.clip[is_cut ? range.plane : 0];
            pick.region = static_cast<std::int32_t>(p.region);
            pick.solid = is_cut ? -1 : static_cast<std::int32_t>(p.in_solid);
            pick.t = is_cut ? range.near : p.in;
            pick.point = pick.ray.origin + pick.t * pick.ray.direction;
            pick.normal = is_cut ? Vec3{plane.nx, plane.ny, plane.nz} : p.in_normal;
            break;
        }
    });
    return pick;
}

void Model::partitions(const Rays& rays, Partitions& answer, Fields fields, const RayRanges& ranges) const {
    impl_->call([&](const ListTracer& tracer) { find_partitions(RayList(rays, ranges), answer, fields, tracer); });
}

void Model::cast_rays(const Rays& rays, Hits& answer, Fields fields, const RayRanges& ranges) const {
    impl_->call([&](const ListTracer& tracer) { find_hits(RayList(rays, ranges), answer, fields, tracer); });
}

void Model::occluded(const Rays& rays, Array<std::uint8_t>& answer, const RayRanges& ranges) const {
    impl_->call([&](const ListTracer& tracer) { find_occluded(RayList(rays, ranges), answer, tracer); });
}

void Model::region_at(std::span<const Vec3> points, Array<std::int32_t>& answer) const {
    impl_->call([&](const ListTracer& tracer) { find_regions(points, answer, tracer); });
}

void Model::slice(const Slice& slice, Array<std::int32_t>& answer) const {
    impl_->call([&](const ListTracer& tracer) { find_pixels(slice, answer, tracer); });
}

}  // namespace csgrt
