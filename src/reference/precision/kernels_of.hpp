// ReferenceKernels over the kernels in the namespace CSGRT_KERNELS, made by CSGRT_MAKE_KERNELS. The .cpp file of a
// precision defines these macros and includes this header, which has all the code.
#include "compile/bvh/space.hpp"
#include "compile/records/conversions.hpp"
#include "reference/reference_kernels.hpp"

namespace csgrt {
namespace {

k::MaterialRecord convert(const kernel::MaterialRecord& m) { return std::bit_cast<k::MaterialRecord>(m); }

/// An empty list. It reuses the memory of `used` if the type is the same.
template <class To, class From>
std::vector<To> again([[maybe_unused]] std::vector<From>&& used, To*) {
    if constexpr (std::is_same_v<To, From>) {
        used.clear();
        return std::move(used);
    } else {
        return {};
    }
}

k::world_ray convert_ray(const Ray& r) {
    return {{static_cast<wide>(r.origin.x), static_cast<wide>(r.origin.y), static_cast<wide>(r.origin.z)},
            {static_cast<wide>(r.direction.x), static_cast<wide>(r.direction.y), static_cast<wide>(r.direction.z)}};
}

/// The kernels of this precision over a compiled scene, whose tables it converts once.
class Kernels : public ReferenceKernels {
public:
    Kernels(const CompiledScene& scene, Quartic quartic)
        : met_(met_solids(scene, scene.solids.size())),
          records_(scene),
          g_(k::make_geometry(records_.solids.data(), records_.reals.data(), records_.planes.data(), scene.words.data(),
                              records_.inner_nodes.data())) {
        g_.quartic = static_cast<k::u32>(quartic);
    }

    void check(const kernel::RayRecord& ray, std::uint64_t number) const override { check_rays({&ray, 1}, number); }
    void append_rows(const kernel::Frame& f, const kernel::RayRecord& ray,
                     const std::vector<kernel::Boundary>& boundaries, const std::vector<kernel::PartitionNode>& nodes,
                     Fields fields, RowMemory& rows,
                     std::vector<kernel::OverlapRecord>& overlap_records) const override {
        const k::Frame& frame = convert_frame(f);
        const k::RayRecord record = convert(ray);
        std::vector<k::Boundary> own_boundaries;
        for (const kernel::Boundary& e : boundaries)
            own_boundaries.push_back({static_cast<real>(e.t), e.solid, e.surface});
        std::vector<k::PartitionNode> own_nodes;
        for (const kernel::PartitionNode& n : nodes)
            own_nodes.push_back({n.in_boundary, n.out_boundary, n.next, n.owner});
        k::ray_rows w = k::rows_of(&frame, record, own_boundaries.data(), own_nodes.data(),
                                   static_cast<k::u32>(nodes.size() / 2)),
                    overlaps = w;
        const k::ray3 r = k::geometry_ray(&frame, k::listed_ray(record));
        const auto describe = [&](k::u32 number, k::u32 is_out, auto& solids, auto& normals) {
            if (fields.solids)
                solids.push_back(number == NONE ? -1 : static_cast<std::int32_t>(boundaries[number].solid));
            if (!fields.normals) return;
            const k::vec3 n =
                number == NONE ? k::make_vec3(0, 0, 0) : k::row_normal(g_, r, own_boundaries[number], number, is_out);
            normals.push_back({static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)});
        };
        k::ray_row row;
        while (k::next_row(&w, &row)) {
            rows.regions.push_back(static_cast<std::int32_t>(row.region));
            rows.in.push_back(static_cast<double>(row.in));
            rows.out.push_back(static_cast<double>(row.out));
            describe(row.in_boundary, 0, rows.in_solids, rows.in_normals);
            describe(row.out_boundary, 1, rows.out_solids, rows.out_normals);
        }
        overlap_records.clear();
        for (k::u32 node = 0; k::next_overlap(&overlaps, &row, &node);)
            overlap_records.push_back({static_cast<double>(row.in), static_cast<double>(row.out), 0, node});
    }

    Ray camera_ray(const kernel::Frame& f, std::uint32_t x, std::uint32_t y) const override {
        if constexpr (sizeof(real) > sizeof(double)) {
            return ReferenceKernels::camera_ray(f, x, y);
        } else {
            const k::Frame& frame = convert_frame(f);
            const k::world_ray r = k::camera_ray(&frame, {x, y, 1});
            const auto point = [](const auto& p) {
                return Vec3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
            };
            return {point(r.o), point(r.d)};
        }
    }
    std::span<const WovenPartition> trace(const kernel::Frame& f, const kernel::RayRecord& ray,
                                          [[maybe_unused]] const NearSolids& near,
                                          std::vector<kernel::Boundary>& boundaries, Weaver& weaver) const override {
        const k::Frame& frame = convert_frame(f);
        const k::RayRecord record = convert(ray);
        const k::ray3 r = k::geometry_ray(&frame, k::listed_ray(record));
        const real t_min = frame.work == WORK_RAYS
                               ? k::range_of(&frame, record, r).t_min
                               : k::parameter_at(r, k::range_in_view(&frame, k::listed_ray(record)).from);
        std::vector<k::Boundary> own = again(std::move(boundaries), static_cast<k::Boundary*>(nullptr));
        const auto meet = [&](std::uint32_t solid) {
            const k::u32 segments = k::collect(g_, records_.solids[solid], solid, r, t_min, nullptr);
            if (segments == 0) return;
            const std::size_t first = own.size();
            own.resize(first + 2 * std::size_t{segments});
            k::collect(g_, records_.solids[solid], solid, r, t_min, own.data() + first);
        };
        if constexpr (sizeof(real) == sizeof(double)) {
            near.for_each({{ray.ox, ray.oy, ray.oz}, {ray.dx, ray.dy, ray.dz}}, meet);
        } else if constexpr (sizeof(real) < sizeof(double)) {
            for (std::uint32_t solid = 0; solid < records_.solids.size(); ++solid)
                if (met_[solid]) meet(solid);
        } else {
            meet_boxes(frame, r, t_min, meet);
        }
        const std::span<const WovenPartition> woven = weave(own, k::tolerance_along(&frame, r), weaver);
        boundaries = boundaries_of(std::move(own));
        return woven;
    }
    Seen seen(const kernel::Frame& f, const Ray& ray) const override {
        const k::Frame& frame = convert_frame(f);
        const k::world_ray w = convert_ray(ray);
        const k::ray3 r = k::geometry_ray(&frame, w);
        const k::view_range range = k::range_in_view(&frame, w);
        return {static_cast<double>(k::parameter_at(r, range.after)),
                static_cast<double>(k::parameter_at(r, range.before)), k::sides_beyond(&frame, r)};
    }
    kernel::Pixel hit_pixel(const kernel::Frame& f, const std::vector<kernel::LightRecord>& lights,
                            std::uint32_t region, const kernel::MaterialRecord& material, const Ray& ray,
                            const kernel::Boundary& end, bool leaves) const override {
        const k::Frame& frame = convert_frame(f);
        const k::world_ray w = convert_ray(ray);
        const k::ray3 r = k::geometry_ray(&frame, w);
        const auto& records = lights_of(lights);
        const k::Boundary seen{static_cast<real>(end.t), end.solid, end.surface};
        const k::Pixel pixel = k::seen_pixel(&frame, records.data(), convert(material), g_, r,
                                             k::range_in_view(&frame, w), seen, leaves, region);
        kernel::Pixel result;
        static_assert(sizeof result == sizeof pixel && std::is_trivially_copyable_v<k::Pixel>);
        std::memcpy(&result, &pixel, sizeof result);
        return result;
    }

private:
    /// Solids whose boxes the ray misses are skipped, because 113 bits are slow. The reference in double checks that
    /// boxes contain their solids.
    template <class Meet>
    void meet_boxes(const k::Frame& frame, const k::ray3& r, real t_min, const Meet& meet) const {
        for (std::uint32_t solid = 0; solid < frame.unbounded_count; ++solid) meet(solid);
        const k::slab_ray slab = k::make_slab_ray(k::offset_from(k::frame_center(&frame), r.o), r.d, real(frame.radius),
                                                  frame.whole_lines ? -k::REAL_INFINITY : t_min);
        if (!slab.hits_sphere) return;
        for (std::size_t i = 0; i < records_.nodes.size();) {
            const k::BvhNode& node = records_.nodes[i];
            const bool met = k::box_is_hit(slab, node);
            const std::uint32_t first = node.leaf >> BVH_LEAF_SHIFT;
            for (std::uint32_t n = 0; met && n < (node.leaf & BVH_LEAF_MASK); ++n) meet(first + n);
            i = met && !node.leaf ? i + 1 : node.skip;
        }
    }
    k::vec3 normal_at(const k::ray3& r, const kernel::Boundary& end) const {
        return k::normal_at(g_, records_.solids[end.solid], r, static_cast<real>(end.t), end.surface);
    }
    const std::vector<bool> met_;
    const Records records_;
    k::Geometry g_;
};

}  // namespace

std::unique_ptr<ReferenceKernels> CSGRT_MAKE_KERNELS(const CompiledScene& scene, Quartic quartic) {
    return std::make_unique<Kernels>(scene, quartic);
}

}  // namespace csgrt
