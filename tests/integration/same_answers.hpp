// Two answers, bit by bit; and what to ask.
#pragma once

#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "device/compiling_device.hpp"
#include "device/discovery.hpp"

namespace csgrt::test {

inline void require_same(const Image& a, const Image& b) {
    REQUIRE(a.names == b.names);
    for (std::size_t c = 0; c < a.names.size(); ++c) {
        REQUIRE(a.channels[c].size() == b.channels[c].size());
        std::size_t different = 0, where = 0;
        for (std::size_t i = 0; i < a.channels[c].size(); ++i) {
            if (std::memcmp(&a.channels[c][i], &b.channels[c][i], sizeof(float)) == 0) continue;
            if (different++ == 0) where = i;
        }
        INFO("channel " << a.names[c] << ": first difference at (" << where % static_cast<std::size_t>(a.width) << ", "
                        << where / static_cast<std::size_t>(a.width) << "): " << a.channels[c][where] << " and "
                        << b.channels[c][where]);
        REQUIRE(different == 0);
    }
}

inline bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
inline bool same(Vec3 a, Vec3 b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

inline void require_same(const std::vector<RayPartitions>& a, const std::vector<RayPartitions>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        INFO("ray " << i);
        REQUIRE(a[i].partitions.size() == b[i].partitions.size());
        for (std::size_t k = 0; k < a[i].partitions.size(); ++k) {
            const Partition &p = a[i].partitions[k], &q = b[i].partitions[k];
            const bool equal = same(p.in, q.in) && same(p.out, q.out) && same(p.in_normal, q.in_normal) &&
                               same(p.out_normal, q.out_normal) && p.region == q.region && p.in_solid == q.in_solid &&
                               p.out_solid == q.out_solid;
            REQUIRE(equal);
        }
        REQUIRE(a[i].overlaps.size() == b[i].overlaps.size());
        for (std::size_t k = 0; k < a[i].overlaps.size(); ++k) {
            const Overlap &p = a[i].overlaps[k], &q = b[i].overlaps[k];
            REQUIRE((same(p.in, q.in) && same(p.out, q.out) && p.regions == q.regions));
        }
    }
}

template <class T>
bool same(const Array<T>& a, const Array<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline void require_same(const Partitions& a, const Partitions& b) {
    REQUIRE(same(a.ray_splits, b.ray_splits));
    REQUIRE(same(a.region_ids, b.region_ids));
    REQUIRE(same(a.t_in, b.t_in));
    REQUIRE(same(a.t_out, b.t_out));
    REQUIRE(same(a.in_solids, b.in_solids));
    REQUIRE(same(a.out_solids, b.out_solids));
    REQUIRE(same(a.in_normals, b.in_normals));
    REQUIRE(same(a.out_normals, b.out_normals));
    REQUIRE(same(a.overlap_splits, b.overlap_splits));
    REQUIRE(same(a.overlap_t_in, b.overlap_t_in));
    REQUIRE(same(a.overlap_t_out, b.overlap_t_out));
    REQUIRE(same(a.overlap_region_splits, b.overlap_region_splits));
    REQUIRE(same(a.overlap_region_ids, b.overlap_region_ids));
}

/// What of a whole line's rows is within a range: one ray's regions, distances and solids.
struct CutRow {
    std::int32_t region, in_solid, out_solid;
    double in, out;
    Vec3 in_normal, out_normal;
};
inline std::vector<CutRow> cut_rows(const Partitions& whole, std::size_t ray, RayRange range) {
    std::vector<CutRow> rows;
    for (auto i = std::size_t(whole.ray_splits[ray]); i < std::size_t(whole.ray_splits[ray + 1]); ++i) {
        CutRow row{whole.region_ids[i], whole.in_solids[i],  whole.out_solids[i], whole.t_in[i],
                   whole.t_out[i],      whole.in_normals[i], whole.out_normals[i]};
        if (range.t_near == range.t_far ? !(row.in <= range.t_near && range.t_near < row.out)
                                        : !(row.in < range.t_far && range.t_near < row.out))
            continue;
        if (row.in < range.t_near) row.in = range.t_near, row.in_solid = -1, row.in_normal = {};
        if (row.out > range.t_far) row.out = range.t_far, row.out_solid = -1, row.out_normal = {};
        rows.push_back(row);
    }
    return rows;
}

/// A range for each ray: of both signs, some without a bound, some of one point.
inline std::vector<RayRange> random_ranges(std::size_t count) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> near(-2, 12);
    std::vector<RayRange> ranges(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double a = static_cast<float>(near(random)), b = static_cast<float>(near(random));  // in any precision
        ranges[i] = {std::min(a, b), std::max(a, b)};
        if (i % 5 == 1) ranges[i].t_near = -infinity;
        if (i % 5 == 2) ranges[i].t_far = infinity;
        if (i % 5 == 3) ranges[i].t_far = ranges[i].t_near;
    }
    return ranges;
}

/// First hits are the first rows.
inline void require_first_rows(const Hits& hits, const Array<std::uint8_t>& occluded, const Partitions& rows) {
    REQUIRE(hits.t_hit.size() + 1 == rows.ray_splits.size());
    REQUIRE(occluded.size() == hits.t_hit.size());
    for (std::size_t ray = 0; ray < hits.t_hit.size(); ++ray) {
        INFO("ray " << ray);
        const auto i = std::size_t(rows.ray_splits[ray]);
        const bool is_hit = rows.ray_splits[ray + 1] > rows.ray_splits[ray];
        REQUIRE(occluded[ray] == is_hit);
        REQUIRE(hits.region_ids[ray] == (is_hit ? rows.region_ids[i] : -1));
        REQUIRE(same(hits.t_hit[ray], is_hit ? rows.t_in[i] : std::numeric_limits<double>::infinity()));
        REQUIRE(hits.solid_ids[ray] == (is_hit ? rows.in_solids[i] : -1));
        REQUIRE(same(hits.normals[ray], is_hit ? rows.in_normals[i] : Vec3{}));
    }
}

/// Of renderers, whose answers have the same bits: for the whole line, and for ranges, which cut it.
inline void require_same_lists(Renderer& expected, std::initializer_list<Renderer*> found,
                               const std::vector<Ray>& rays) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr Fields all{.solids = true, .normals = true, .overlaps = true};
    const std::vector<RayRange> ranges = random_ranges(rays.size());
    Partitions whole, cut;
    expected.partitions(rays, whole, all, {.all = {-infinity, infinity}});
    expected.partitions(rays, cut, all, {.each = ranges});
    for (Renderer* const renderer : found) {
        Partitions other;
        renderer->partitions(rays, other, all, {.all = {-infinity, infinity}});
        require_same(other, whole);
        renderer->partitions(rays, other, all, {.each = ranges});
        require_same(other, cut);
        Hits hits;
        Array<std::uint8_t> occluded;
        renderer->cast_rays(rays, hits, all, {.each = ranges});
        renderer->occluded(rays, occluded, {.each = ranges});
        require_first_rows(hits, occluded, cut);
        if (renderer->statistics().precision == "double") {
            renderer->model().partitions(rays, other, all, {.each = ranges});
            require_same(other, cut);
        }
    }
    for (std::size_t ray = 0; ray < rays.size(); ++ray) {
        INFO("ray " << ray << " from " << ranges[ray].t_near << " to " << ranges[ray].t_far);
        const std::vector<CutRow> rows = cut_rows(whole, ray, ranges[ray]);
        const auto first = std::size_t(cut.ray_splits[ray]);
        REQUIRE(std::size_t(cut.ray_splits[ray + 1]) - first == rows.size());
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const std::size_t i = first + k;
            const CutRow& row = rows[k];
            REQUIRE((cut.region_ids[i] == row.region && same(cut.t_in[i], row.in) && same(cut.t_out[i], row.out)));
            REQUIRE((cut.in_solids[i] == row.in_solid && cut.out_solids[i] == row.out_solid));
            REQUIRE((same(cut.in_normals[i], row.in_normal) && same(cut.out_normals[i], row.out_normal)));
        }
    }
}

// Rays from a sphere around the model to points within it, and some from within.
inline std::vector<Ray> random_rays(const Box& box, int count) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto inside = [&] {
        return Vec3{box.low.x + unit(random) * (box.high.x - box.low.x),
                    box.low.y + unit(random) * (box.high.y - box.low.y),
                    box.low.z + unit(random) * (box.high.z - box.low.z)};
    };
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const Vec3 a = inside(), b = inside();
        const Vec3 d{b.x - a.x, b.y - a.y, b.z - a.z};
        const double back = i % 4 == 0 ? 0 : 10;
        rays.push_back({{a.x - back * d.x, a.y - back * d.y, a.z - back * d.z}, d});
    }
    return rays;
}

/// The device that CSGRT_DEVICE chooses (as --device does), or the default one.
inline Settings on_device() {
    Settings settings;
    settings.wait_for_device = true;  // else a native device may draw in its place
    if (const char* choice = std::getenv("CSGRT_DEVICE")) settings.device = choice;
    return settings;
}

/// The same for thousands of scenes, each of which a driver would compile for: the native device, if there is one.
inline Settings on_native_device() {
    Settings settings = on_device();
    if (settings.device.empty() && !find_native_devices().empty()) settings.device = "native";
    return settings;
}

/// The same for what needs a device with a compiler (compiling_device.hpp).
inline Settings on_compiling_device() {
    Settings settings = on_device();
    settings.device = compiling_device();
    return settings;
}

/// Whole and in batches, parallel and in perspective, every partition and the first hit; then `rays` random rays.
inline void require_agreement(const Scene& scene, const std::vector<std::string>& objects, int size, int rays,
                              const Settings& settings = on_device()) {
    Settings by_reference = settings;
    by_reference.reference = true;
    by_reference.device.clear();
    Renderer reference(scene, objects, by_reference);
    Renderer device(scene, objects, settings);
    const std::uint64_t scene_bytes = [&] {
        device.render({.width = 8, .height = 8, .camera = {}});
        return device.statistics().device_bytes;
    }();
    Settings little = settings;
    little.max_memory = scene_bytes + 475'000;  // some dozen batches
    Renderer batched(scene, objects, little);
    for (const double perspective : {0.0, 40.0}) {
        View view{.width = size, .height = size, .camera = scene.camera};
        view.camera.perspective = perspective;
        INFO("perspective " << perspective);
        const Image expected = reference.render(view);
        require_same(device.render(view), expected);
        require_same(batched.render(view), expected);
        if (expected.width >= 64) CHECK(batched.statistics().batches > 1);
        CHECK(device.statistics().segments == reference.statistics().segments);
        CHECK(device.statistics().partitions_used == reference.statistics().partitions_used);
        CHECK(device.statistics().overlaps == reference.statistics().overlaps);
        view.every_partition = false;
        const Image first = device.render(view);
        require_same(first, reference.render(view));
        require_same(batched.render(view), first);
        REQUIRE(first.names.size() == 10);
        for (std::size_t c = 0; c < first.names.size(); ++c)
            CHECK(std::memcmp(first.channels[c].data(), expected.channels[c].data(), first.channels[c].size() * 4) ==
                  0);
    }
    const std::vector<Ray> list = random_rays(reference.model().bounds(), rays);
    const auto expected = reference.shoot(list);
    require_same(device.shoot(list), expected);
    require_same(batched.shoot(list), expected);
    require_same_lists(reference, {&device, &batched}, list);
}

}  // namespace csgrt::test
