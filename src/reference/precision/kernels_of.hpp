// HostKernels and ReferenceKernels over the kernels in the namespace CSGRT_KERNELS, made by CSGRT_MAKE_KERNELS. This is
// the body of the one file that includes it.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

#include "compile/bvh/space.hpp"
#include "reference/reference_kernels.hpp"

namespace csgrt {
namespace {

namespace k = CSGRT_KERNELS;
using k::real;
using k::wide;

// ---- Conversion of records from double. A table that is the same in both is not copied. ----

template <class To, class From>
using Converted = std::conditional_t<std::is_same_v<To, From>, std::span<const From>, std::vector<To>>;

/// Converts a record: it begins with `numbers` numbers that are `wide`, and its rest is the same in all precisions.
template <class To, std::size_t numbers, class From>
To converted(const From& record) {
    constexpr std::size_t own = numbers * sizeof(wide), other = numbers * sizeof(double);
    constexpr std::size_t rest = std::min(sizeof(To) - own, sizeof(From) - other);
    static_assert(sizeof(To) - own - rest < alignof(To) && sizeof(From) - other - rest < alignof(From));  // padding
    std::array<double, numbers> from;
    std::array<wide, numbers> to;
    std::memcpy(from.data(), &record, other);
    std::transform(from.begin(), from.end(), to.begin(), [](double x) { return static_cast<wide>(x); });
    To result{};
    std::memcpy(&result, to.data(), own);
    std::memcpy(reinterpret_cast<std::byte*>(&result) + own, reinterpret_cast<const std::byte*>(&record) + other, rest);
    return result;
}

real convert(double x) { return static_cast<real>(x); }
[[maybe_unused]] k::PlaneRecord convert(const kernel::PlaneRecord& p) { return converted<k::PlaneRecord, 4>(p); }
[[maybe_unused]] k::LightRecord convert(const kernel::LightRecord& l) { return converted<k::LightRecord, 8>(l); }
k::MaterialRecord convert(const kernel::MaterialRecord& m) { return std::bit_cast<k::MaterialRecord>(m); }

// Boxes are larger in single precision. There a ray may meet a solid a little beside its position; with larger boxes a
// device finds everything that the reference finds.
[[maybe_unused]] k::BvhNode convert_node(const kernel::BvhNode& n) {
    k::BvhNode node = std::bit_cast<k::BvhNode>(n);
    double diagonal = 0;
    for (int i = 0; i < 3; ++i) diagonal += double(n.high[i] - n.low[i]) * double(n.high[i] - n.low[i]);
    const bool single = sizeof(real) == sizeof(float);
    const auto pad = static_cast<float>(single ? 0x1p-10 * std::sqrt(diagonal) : 0);
    for (int i = 0; i < 3; ++i) {
        node.low[i] -= pad;
        node.high[i] += pad;
    }
    return node;
}

[[maybe_unused]] k::SolidRecord convert_solid(const kernel::SolidRecord& s, const CompiledScene& scene) {
    k::SolidRecord solid{};
    static_assert(offsetof(k::SolidRecord, alone) == offsetof(kernel::SolidRecord, alone));
    std::memcpy(&solid, &s, sizeof s);  // the center stands behind
#ifdef CSGRT_EYE_RELATIVE
    if (s.type != SOLID_ARB && s.type != SOLID_HALF)  // all others begin with their center
        for (std::size_t i = 0; i < 3; ++i) solid.center[i] = scene.reals[s.first_real + i];
#endif
    (void)scene;
    return solid;
}

template <class To, class From, class Convert>
Converted<To, From> convert_all(const std::vector<From>& from, const Convert& one) {
    if constexpr (std::is_same_v<To, From>) {
        return from;
    } else {
        std::vector<To> to;
        to.reserve(from.size());
        for (const From& x : from) to.push_back(one(x));
        return to;
    }
}

k::RayRecord convert(const kernel::RayRecord& r) {
    return {static_cast<wide>(r.ox), static_cast<wide>(r.oy), static_cast<wide>(r.oz),     static_cast<wide>(r.dx),
            static_cast<wide>(r.dy), static_cast<wide>(r.dz), static_cast<wide>(r.t_near), static_cast<wide>(r.t_far)};
}

[[maybe_unused]] std::vector<kernel::Boundary> ends_of(std::vector<kernel::Boundary>&& boundaries) {
    return std::move(boundaries);
}
template <class Boundary>
std::vector<kernel::Boundary> ends_of(std::vector<Boundary>&& boundaries) {
    std::vector<kernel::Boundary> result;
    result.reserve(boundaries.size());
    for (const Boundary& e : boundaries) result.push_back({static_cast<double>(e.t), e.solid, e.surface});
    return result;
}

/// An empty list, in the memory of a used list if its type is the same.
template <class To, class From>
std::vector<To> again([[maybe_unused]] std::vector<From>&& used, To*) {
    if constexpr (std::is_same_v<To, From>) {
        used.clear();
        return std::move(used);
    } else {
        return {};
    }
}

template <class T>
std::vector<std::byte> bytes_of(const T* values, std::size_t count) {
    std::vector<std::byte> bytes(count * sizeof(T));
    if (count) std::memcpy(bytes.data(), values, bytes.size());
    return bytes;
}

// ---- A frame in this precision. ----

[[maybe_unused]] const kernel::Frame& convert_frame(const kernel::Frame& f, const kernel::Frame*) { return f; }
template <class Frame>
Frame convert_frame(const kernel::Frame& f, const Frame*) {
    static_assert(offsetof(Frame, word_capacity) - offsetof(Frame, background) ==
                  offsetof(kernel::Frame, word_capacity) - offsetof(kernel::Frame, background));
    return converted<Frame, offsetof(kernel::Frame, background) / sizeof(double)>(f);
}
decltype(auto) convert_frame(const kernel::Frame& f) { return convert_frame(f, static_cast<const k::Frame*>(nullptr)); }

k::world_ray convert_ray(const Ray& r) {
    return {{static_cast<wide>(r.origin.x), static_cast<wide>(r.origin.y), static_cast<wide>(r.origin.z)},
            {static_cast<wide>(r.direction.x), static_cast<wide>(r.direction.y), static_cast<wide>(r.direction.z)}};
}

/// The kernels of this precision over a compiled scene, whose tables it converts once.
class Kernels : public ReferenceKernels {
public:
    Kernels(const CompiledScene& scene, Quartic quartic)
        : met_(met_solids(scene, scene.solids.size())),
          solids_(
              convert_all<k::SolidRecord>(scene.solids.get(), [&](const auto& s) { return convert_solid(s, scene); })),
          reals_(convert_all<real>(scene.reals.get(), [](double x) { return convert(x); })),
          planes_(convert_all<k::PlaneRecord>(scene.planes.get(), [](const auto& p) { return convert(p); })),
          inner_nodes_(convert_all<k::BvhNode>(scene.inner_nodes.get(), [](const auto& n) { return convert_node(n); })),
          nodes_(convert_all<k::BvhNode>(scene.nodes.get(), [](const auto& n) { return convert_node(n); })),
          g_(k::make_geometry(solids_.data(), reals_.data(), planes_.data(), scene.words.data(), inner_nodes_.data())) {
        g_.quartic = static_cast<k::u32>(quartic);
    }

    Tables tables() const override {
        const auto bytes = [](const auto& table) { return std::as_bytes(std::span(table)); };
        return {bytes(solids_), bytes(reals_), bytes(planes_), bytes(inner_nodes_), bytes(nodes_)};
    }
    std::vector<std::byte> frame(const kernel::Frame& f) const override {
        const k::Frame& frame = convert_frame(f);
        return bytes_of(&frame, 1);
    }
    std::vector<std::byte> lights(const std::vector<kernel::LightRecord>& lights) const override {
        const auto& records = lights_of(lights);
        return bytes_of(records.data(), records.size());
    }
    void write_rays(std::span<const kernel::RayRecord> rays, std::byte* to) const override {
        for (const kernel::RayRecord& ray : rays) {
            const k::RayRecord record = convert(ray);
            std::memcpy(to, &record, sizeof record);
            to += sizeof record;
        }
    }
    void check(std::span<const kernel::RayRecord> rays, std::uint64_t first) const override {
        if (sizeof(wide) > sizeof(float)) return;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const k::world_ray r = k::listed_ray(convert(rays[i]));
            const wide sum = r.o.x + r.o.y + r.o.z;
            const wide size2 = r.d.x * r.d.x + r.d.y * r.d.y + r.d.z * r.d.z;
            if (sum - sum == 0 && size2 > wide(1e-30) && size2 < wide(1e30)) continue;
            throw Error(Status::usage, "ray " + std::to_string(first + i) +
                                           ": single precision in world coordinates needs a direction whose length is "
                                           "between 1e-15 and 1e15, and an origin below 1e38");
        }
    }
    std::size_t ray_bytes() const override { return sizeof(k::RayRecord); }
    std::size_t boundary_bytes() const override { return sizeof(k::Boundary); }
    std::size_t overlap_bytes() const override { return sizeof(k::OverlapRecord); }
    std::size_t wide_bytes() const override { return sizeof(wide); }
    std::vector<kernel::OverlapRecord> overlap_records(const std::vector<std::byte>& bytes) const override {
        std::vector<k::OverlapRecord> own(bytes.size() / sizeof(k::OverlapRecord));
        if (!own.empty()) std::memcpy(own.data(), bytes.data(), own.size() * sizeof(k::OverlapRecord));
        std::vector<kernel::OverlapRecord> overlap_records;
        for (const k::OverlapRecord& p : own)
            overlap_records.push_back({static_cast<double>(p.in), static_cast<double>(p.out), p.ray, p.node});
        return overlap_records;
    }
    std::vector<kernel::Boundary> boundaries(const std::vector<std::byte>& bytes) const override {
        std::vector<k::Boundary> boundaries(bytes.size() / sizeof(k::Boundary));
        if (!boundaries.empty()) std::memcpy(boundaries.data(), bytes.data(), bytes.size());
        return ends_of(std::move(boundaries));
    }

    void append_rows(const kernel::Frame& f, const kernel::RayRecord& ray,
                     const std::vector<kernel::Boundary>& boundaries, const std::vector<kernel::PartitionNode>& nodes,
                     Fields fields, RowMemory& rows,
                     std::vector<kernel::OverlapRecord>& overlap_records) const override {
        const k::Frame& frame = convert_frame(f);
        const k::RayRecord record = convert(ray);
        std::vector<k::Boundary> own_ends;
        for (const kernel::Boundary& e : boundaries) own_ends.push_back({static_cast<real>(e.t), e.solid, e.surface});
        std::vector<k::PartitionNode> own_nodes;
        for (const kernel::PartitionNode& n : nodes)
            own_nodes.push_back({n.in_boundary, n.out_boundary, n.next, n.owner});
        k::ray_rows w = k::rows_of(&frame, record, own_ends.data(), own_nodes.data(),
                                   static_cast<k::u32>(nodes.size() / 2)),
                    overlaps = w;
        const k::ray3 r = k::geometry_ray(&frame, k::listed_ray(record));
        const auto describe = [&](k::u32 number, k::u32 is_out, auto& solids, auto& normals) {
            if (fields.solids)
                solids.push_back(number == NONE ? -1 : static_cast<std::int32_t>(boundaries[number].solid));
            if (!fields.normals) return;
            const k::vec3 n =
                number == NONE ? k::make_vec3(0, 0, 0) : k::row_normal(g_, r, own_ends[number], number, is_out);
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
            const k::u32 segments = k::collect(g_, solids_[solid], solid, r, t_min, nullptr);
            if (segments == 0) return;
            const std::size_t first = own.size();
            own.resize(first + 2 * std::size_t{segments});
            k::collect(g_, solids_[solid], solid, r, t_min, own.data() + first);
        };
        if constexpr (sizeof(real) == sizeof(double)) {
            near.for_each({{ray.ox, ray.oy, ray.oz}, {ray.dx, ray.dy, ray.dz}}, meet);
        } else if constexpr (sizeof(real) < sizeof(double)) {
            for (std::uint32_t solid = 0; solid < solids_.size(); ++solid)
                if (met_[solid]) meet(solid);
        } else {
            meet_boxes(frame, r, t_min, meet);
        }
        const std::span<const WovenPartition> woven = weave(own, k::tolerance_along(&frame, r), weaver);
        boundaries = ends_of(std::move(own));
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
    /// Solids whose boxes the ray misses are passed over: 113 bits are slow. The reference in double checks that boxes
    /// hold their solids.
    template <class Meet>
    void meet_boxes(const k::Frame& frame, const k::ray3& r, real t_min, const Meet& meet) const {
        for (std::uint32_t solid = 0; solid < frame.unbounded_count; ++solid) meet(solid);
        const k::slab_ray slab = k::make_slab_ray(k::offset_from(k::frame_center(&frame), r.o), r.d, real(frame.radius),
                                                  frame.whole_lines ? -k::REAL_INFINITY : t_min);
        if (!slab.hits_sphere) return;
        for (std::size_t i = 0; i < nodes_.size();) {
            const k::BvhNode& node = nodes_[i];
            const bool met = k::box_is_hit(slab, node);
            const std::uint32_t first = node.leaf >> BVH_LEAF_SHIFT;
            for (std::uint32_t n = 0; met && n < (node.leaf & BVH_LEAF_MASK); ++n) meet(first + n);
            i = met && !node.leaf ? i + 1 : node.skip;
        }
    }
    k::vec3 normal_at(const k::ray3& r, const kernel::Boundary& end) const {
        return k::normal_at(g_, solids_[end.solid], r, static_cast<real>(end.t), end.surface);
    }
    static Converted<k::LightRecord, kernel::LightRecord> lights_of(const std::vector<kernel::LightRecord>& lights) {
        return convert_all<k::LightRecord>(lights, [](const auto& l) { return convert(l); });
    }

    const std::vector<bool> met_;
    const Converted<k::SolidRecord, kernel::SolidRecord> solids_;
    const Converted<real, double> reals_;
    const Converted<k::PlaneRecord, kernel::PlaneRecord> planes_;
    const Converted<k::BvhNode, kernel::BvhNode> inner_nodes_, nodes_;
    k::Geometry g_;
};

}  // namespace

std::unique_ptr<ReferenceKernels> CSGRT_MAKE_KERNELS(const CompiledScene& scene, Quartic quartic) {
    return std::make_unique<Kernels>(scene, quartic);
}

}  // namespace csgrt
