#include <csgrt/model.hpp>

#include <algorithm>
#include <string>
#include <utility>

#include "base/clock.hpp"
#include "base/floating_point.hpp"
#include "base/thread.hpp"
#include "compile/frame.hpp"
#include "compile/linear.hpp"
#include "compile/lists/along_rays.hpp"
#include "compile/lists/grid.hpp"
#include "device/host_memory.hpp"
#include "render/model_impl.hpp"
#include "scene/vector.hpp"

namespace csgrt {

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

Model::Model(const Scene& scene, const std::vector<std::string>& objects, const Settings& settings) {
    const FloatingPoint own;
    const AllowedThreads allowed(settings.threads);
    if (settings.max_instances > Limits::most_instances)
        throw Error(Status::usage, "max_instances is more than " + std::to_string(Limits::most_instances));
    const auto start = Clock::now();
    const auto impl = std::make_shared<Impl>();
    impl->scene = compile(scene, objects,
                          {.air = settings.air,
                           .skip_unsupported = settings.skip_unsupported,
                           .display_shading = settings.display_shading,
                           .max_instances = settings.max_instances});
    impl->compile_ms = milliseconds_since(start);
    impl->title = scene.title;
    Settings in_double = settings;
    in_double.precision = Precision::double_;
    impl->tolerance = tolerance_of(impl->scene, in_double);
    impl_ = impl;
}

const Box& Model::bounds() const { return impl_->scene.bounds; }
const std::vector<RegionInfo>& Model::regions() const { return impl_->scene.region_info; }
const std::vector<SolidInfo>& Model::solids() const { return impl_->scene.solid_info; }
const std::vector<Warning>& Model::warnings() const { return impl_->scene.warnings; }
double Model::tolerance() const { return impl_->tolerance; }

const NativeTracer* Model::Impl::tracer() const {
    std::call_once(has_tracer_, [this] {
        for (const native::Level& level : native::compiled_levels())
            if (native::can_run(level.name)) {
                tracer_.emplace(level, scene, host_memory() / 2);
                break;
            }
    });
    return tracer_ ? &*tracer_ : nullptr;
}

const Reference& Model::Impl::reference() const {
    std::call_once(has_reference_, [this] {
        kernels_ = make_kernels_to_run(scene, Precision::double_, Quartic::bracketed);
        reference_.emplace(scene, *kernels_);
    });
    return *reference_;
}

/// Puts the rows of a list, on this thread.
void Model::Impl::trace(const RayList& list, RowTaker& taker) const {
    kernel::Frame frame = prepare_rays(scene, static_cast<std::uint32_t>(list.size()), tolerance).frame;
    frame.answer = taker.answer();
    if (list.is_grid()) list.put_camera(frame);
    if (const NativeTracer* const native = tracer()) {
        PipelineCounts counts;
        native->trace(frame, list, 0, list.size(), nullptr, taker, counts);
    } else {
        ReferenceCounts counts;
        reference().trace(frame, list, taker, nullptr, counts);
    }
}

RayGrid Model::grid_of(const View& view) const {
    const FloatingPoint own;
    return csgrt::grid_of(prepare_frame(impl_->scene, view, impl_->tolerance).frame);
}

Pick Model::pick(const View& view, int column, int row) const {
    Pick pick;
    pick.ray = ray_of(view, column, row);
    impl_->call([&](const TraceList& trace) {
        const RayList list(pick.ray);
        Partitions all;
        RowSink sink(all, {.solids = true, .normals = true, .overlaps = true}, 1, 0);
        trace(list, sink);
        pick.along = std::move(along_rays(all).front());
    });
    const std::uint32_t seen_end = impl_->scene.rank_ends[RANK_AIR];  // behind it: lights that no picture shows
    for (const Partition& p : pick.along.partitions) {
        if (p.region >= seen_end || !(p.out > 0)) continue;
        pick.region = static_cast<std::int32_t>(p.region);
        pick.solid = static_cast<std::int32_t>(p.in_solid);
        pick.t = p.in;
        pick.point = pick.ray.origin + p.in * pick.ray.direction;
        pick.normal = p.in_normal;
        break;
    }
    return pick;
}

void Model::partitions(const Rays& rays, Partitions& answer, Fields fields, const RayRanges& ranges) const {
    impl_->call([&](const TraceList& trace) { find_partitions(RayList(rays, ranges), answer, fields, trace); });
}

void Model::cast_rays(const Rays& rays, Hits& answer, Fields fields, const RayRanges& ranges) const {
    impl_->call([&](const TraceList& trace) { find_hits(RayList(rays, ranges), answer, fields, trace); });
}

void Model::occluded(const Rays& rays, Array<std::uint8_t>& answer, const RayRanges& ranges) const {
    impl_->call([&](const TraceList& trace) { find_occluded(RayList(rays, ranges), answer, trace); });
}

void Model::region_at(std::span<const Vec3> points, Array<std::int32_t>& answer) const {
    impl_->call([&](const TraceList& trace) { find_regions(points, answer, trace); });
}

void Model::slice(const Slice& slice, Array<std::int32_t>& answer) const {
    impl_->call([&](const TraceList& trace) { find_pixels(slice, answer, trace); });
}

}  // namespace csgrt
