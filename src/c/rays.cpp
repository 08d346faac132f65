#include "c/described.hpp"

using namespace csgrt;
using namespace csgrt::c;

namespace {

/// The bits CSGRT_FIELD_... as Fields. The bits have the order of Fields' members in src/form.
Fields fields_of(unsigned bits) {
    Fields fields;
    unsigned bit = 1;
    form::for_members(form::of<Fields>, [&](const auto& member) {
        fields.*member.at = ((bits & bit) != 0) != member.option.is_off;
        bit *= 2;
    });
    if (bits >= bit) refuse("rays->fields is " + std::to_string(bits) + ", expected CSGRT_FIELD_...");
    return fields;
}

/// A call's rays, their ranges, and the fields that it shall compute.
struct RayRequest {
    Rays rays = {};
    RayRanges ranges = {};
    Fields fields = {};

    explicit RayRequest(const csgrt_rays* given) {
        const csgrt_rays r = read(given, csgrt_rays CSGRT_RAYS, "rays");
        if (r.grid && r.list) refuse("rays->grid and rays->list are both given");
        if (r.ranges && r.range_count == 0) refuse("rays->ranges is given, and rays->range_count is 0");
        if (r.grid) {
            rays = described<RayGrid>(*r.grid, "rays->grid");
        } else {
            rays = std::span(same_layout<const Ray>(r.list), needed(r.list, r.count, "rays->list").size());
        }
        ranges.all = {r.range.t_near, r.range.t_far};
        ranges.each = {same_layout<const RayRange>(r.ranges), needed(r.ranges, r.range_count, "rays->ranges").size()};
        fields = fields_of(r.fields);
    }
};

void expect_count(std::size_t count, std::uint64_t expected, const char* what) {
    if (count != expected) {
        refuse("the count is " + std::to_string(count) + ", expected " + std::to_string(expected) + ", one a " + what);
    }
}

template <class From, class To>
void copy(const Array<From>& from, To* to) {
    static_assert(sizeof(From) == sizeof(To));
    if (to && !from.empty()) std::memcpy(to, from.data(), from.size() * sizeof(To));
}

template <class T, class From>
const T* pointer_to(const Array<From>& array) {
    return array.empty() ? nullptr : same_layout<const T>(array.data());
}

// ---- Calls that models and renderers share ----

template <class Tracer>
void cast_rays(Tracer& tracer, const csgrt_rays* rays, const csgrt_hits* hits, Hits& answer) {
    const csgrt_hits h = read(hits, csgrt_hits CSGRT_HITS, "hits");
    RayRequest request(rays);
    expect_count(h.count, request.rays.size(), "ray");
    request.fields.solids = h.solid_ids != nullptr;
    request.fields.normals = h.normals != nullptr;
    tracer.cast_rays(request.rays, answer, request.fields, request.ranges);
    copy(answer.t_hit, h.t_hit);
    copy(answer.region_ids, h.region_ids);
    copy(answer.solid_ids, h.solid_ids);
    copy(answer.normals, h.normals);
}

template <class Tracer>
void occluded(Tracer& tracer, const csgrt_rays* rays, std::span<std::uint8_t> answers, Array<std::uint8_t>& answer) {
    const RayRequest request(rays);
    expect_count(answers.size(), request.rays.size(), "ray");
    tracer.occluded(request.rays, answer, request.ranges);
    copy(answer, answers.data());
}

template <class Tracer>
void region_at(Tracer& tracer, std::span<const csgrt_vec3> points, std::span<std::int32_t> ids,
               Array<std::int32_t>& answer) {
    tracer.region_at({same_layout<const Vec3>(points.data()), points.size()}, answer);
    copy(answer, ids.data());
}

template <class Tracer>
void slice(Tracer& tracer, const csgrt_slice& s, std::span<std::int32_t> ids, Array<std::int32_t>& answer) {
    const auto slice = described<Slice>(s, "slice");
    if (s.width > 0 && s.height > 0) {
        expect_count(ids.size(), std::uint64_t(s.width) * std::uint64_t(s.height), "pixel");
    }
    tracer.slice(slice, answer);
    copy(answer, ids.data());
}

}  // namespace

csgrt_status csgrt_rays_parallel(const csgrt_box* box, int axis, int columns, int rows, csgrt_ray_grid* grid) {
    return call([&] {
        CSGRT_NEED(grid) =
            shown<csgrt_ray_grid>(rays_parallel(of(CSGRT_NEED(box)), choice(axis, Axis::z, "axis"), columns, rows));
    });
}

csgrt_status csgrt_rays_pinhole(double vertical_fov, const csgrt_vec3* center, const csgrt_vec3* eye,
                                const csgrt_vec3* up, int width, int height, csgrt_ray_grid* grid) {
    return call([&] {
        CSGRT_NEED(grid) = shown<csgrt_ray_grid>(
            rays_pinhole(vertical_fov, of(CSGRT_NEED(center)), of(CSGRT_NEED(eye)), of(CSGRT_NEED(up)), width, height));
    });
}

csgrt_status csgrt_ray_grid_ray(const csgrt_ray_grid* grid, int column, int row, csgrt_ray* ray) {
    return call([&] { CSGRT_NEED(ray) = of(described<RayGrid>(CSGRT_NEED(grid), "grid").ray(column, row)); });
}

csgrt_status csgrt_slice_of(const csgrt_box* box, const csgrt_vec3* normal, double offset, int width, int height,
                            csgrt_slice* slice) {
    return call([&] {
        CSGRT_NEED(slice) =
            shown<csgrt_slice>(slice_of(of(CSGRT_NEED(box)), of(CSGRT_NEED(normal)), offset, width, height));
    });
}

csgrt_status csgrt_partitions_create(csgrt_partitions** partitions) {
    return make(partitions, [] { return Partitions{}; });
}

void csgrt_partitions_free(csgrt_partitions* partitions) { delete partitions; }

csgrt_status csgrt_partitions_get(const csgrt_partitions* partitions, csgrt_partition_arrays* arrays) {
    return call([&] {
        const Partitions& p = *CSGRT_NEED(partitions).shown;
        fill(arrays,
             {0, p.ray_splits.empty() ? 0 : p.ray_splits.size() - 1, p.region_ids.size(), p.overlap_t_in.size(),
              p.overlap_region_ids.size(), p.ray_splits.data(), p.region_ids.data(), p.t_in.data(), p.t_out.data(),
              pointer_to<std::int32_t>(p.in_solids), pointer_to<std::int32_t>(p.out_solids),
              pointer_to<csgrt_vec3>(p.in_normals), pointer_to<csgrt_vec3>(p.out_normals),
              pointer_to<std::int64_t>(p.overlap_splits), pointer_to<double>(p.overlap_t_in),
              pointer_to<double>(p.overlap_t_out), pointer_to<std::int64_t>(p.overlap_region_splits),
              pointer_to<std::int32_t>(p.overlap_region_ids)},
             "arrays");
    });
}

// ---- On the calling thread ----

csgrt_status csgrt_model_partitions(const csgrt_model* model, const csgrt_rays* rays, csgrt_partitions* partitions) {
    return call([&] {
        const RayRequest request(rays);
        CSGRT_NEED(model).model.partitions(request.rays, CSGRT_NEED(partitions).own, request.fields, request.ranges);
    });
}

csgrt_status csgrt_model_cast_rays(const csgrt_model* model, const csgrt_rays* rays, const csgrt_hits* hits) {
    return call([&] {
        Hits answer;
        cast_rays(CSGRT_NEED(model).model, rays, hits, answer);
    });
}

csgrt_status csgrt_model_occluded(const csgrt_model* model, const csgrt_rays* rays, uint8_t* answers, size_t count) {
    return call([&] {
        Array<std::uint8_t> answer;
        occluded(CSGRT_NEED(model).model, rays, needed(answers, count, "answers"), answer);
    });
}

csgrt_status csgrt_model_region_at(const csgrt_model* model, const csgrt_vec3* points, int32_t* ids, size_t count) {
    return call([&] {
        Array<std::int32_t> answer;
        region_at(CSGRT_NEED(model).model, needed(points, count, "points"), needed(ids, count, "ids"), answer);
    });
}

csgrt_status csgrt_model_slice(const csgrt_model* model, const csgrt_slice* slice, int32_t* ids, size_t count) {
    return call([&] {
        Array<std::int32_t> answer;
        ::slice(CSGRT_NEED(model).model, CSGRT_NEED(slice), needed(ids, count, "ids"), answer);
    });
}

// ---- On a device ----

csgrt_status csgrt_renderer_partitions(csgrt_renderer* renderer, const csgrt_rays* rays, csgrt_partitions* partitions) {
    return call([&] {
        const RayRequest request(rays);
        CSGRT_NEED(renderer).renderer.partitions(request.rays, CSGRT_NEED(partitions).own, request.fields,
                                                 request.ranges);
    });
}

csgrt_status csgrt_renderer_partitions_in_batches(csgrt_renderer* renderer, const csgrt_rays* rays, uint64_t most,
                                                  csgrt_take take, void* user) {
    return call([&] {
        const RayRequest request(rays);
        CSGRT_NEED(take);
        const auto pass_on = [&](const Partitions& batch, std::uint64_t first_ray) {
            const csgrt_partitions shown{.shown = &batch};
            return take(user, &shown, first_ray) != 0;
        };
        CSGRT_NEED(renderer).renderer.partitions(request.rays, pass_on, request.fields, request.ranges, most);
    });
}

csgrt_status csgrt_renderer_cast_rays(csgrt_renderer* renderer, const csgrt_rays* rays, const csgrt_hits* hits) {
    return call([&] {
        csgrt_renderer& r = CSGRT_NEED(renderer);
        cast_rays(r.renderer, rays, hits, r.hits);
    });
}

csgrt_status csgrt_renderer_occluded(csgrt_renderer* renderer, const csgrt_rays* rays, uint8_t* answers, size_t count) {
    return call([&] {
        csgrt_renderer& r = CSGRT_NEED(renderer);
        occluded(r.renderer, rays, needed(answers, count, "answers"), r.flags);
    });
}

csgrt_status csgrt_renderer_region_at(csgrt_renderer* renderer, const csgrt_vec3* points, int32_t* ids, size_t count) {
    return call([&] {
        csgrt_renderer& r = CSGRT_NEED(renderer);
        region_at(r.renderer, needed(points, count, "points"), needed(ids, count, "ids"), r.ids);
    });
}

csgrt_status csgrt_renderer_slice(csgrt_renderer* renderer, const csgrt_slice* slice, int32_t* ids, size_t count) {
    return call([&] {
        csgrt_renderer& r = CSGRT_NEED(renderer);
        ::slice(r.renderer, CSGRT_NEED(slice), needed(ids, count, "ids"), r.ids);
    });
}
