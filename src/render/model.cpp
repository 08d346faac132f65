#include <csgrt/model.hpp>

#include <algorithm>
#include <string>

#include "base/clock.hpp"
#include "base/floating_point.hpp"
#include "base/thread.hpp"
#include "compile/frame.hpp"
#include "compile/linear.hpp"
#include "compile/lists/ray_list.hpp"
#include "compile/lists/sink.hpp"
#include "device/host_memory.hpp"
#include "render/model_impl.hpp"

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

void Model::partitions(std::span<const Ray> rays, Partitions& answer, Fields fields, const RayRanges& ranges) const {
    const FloatingPoint own;
    const AllowedThreads alone(1);
    const RayList list(rays, ranges);
    kernel::Frame frame = prepare_rays(impl_->scene, static_cast<std::uint32_t>(rays.size()), impl_->tolerance).frame;
    frame.cuts = 1;
    RowSink sink(answer, fields, rays.size());
    if (const NativeTracer* const tracer = impl_->tracer()) {
        PipelineCounts counts;
        tracer->trace(frame, list, 0, rays.size(), nullptr, sink, counts);
    } else {
        ReferenceCounts counts;
        impl_->reference().trace(frame, list, sink, nullptr, counts);
    }
    list.restore_lengths(answer);
}

}  // namespace csgrt
