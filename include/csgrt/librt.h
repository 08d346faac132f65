// librt's interface: programs that shoot rays with BRL-CAD's librt (rt_dirbuild, rt_gettrees, rt_prep_parallel,
// rt_shootray) compile with this header in place of raytrace.h, and csgrt traces the rays. The definitions are csgrt's
// own. They are the part of librt that gqa, rtcheck, rtweight, rtxray, rtshot, rtexample and MOOSE use; docs/librt.md
// lists them. C++ only. Other names of librt are not declared, so the compiler reports them.
//
// Distances are in lengths of r_dir. The partitions are those of Renderer::shoot(), to the last bit: neighbouring parts
// of one region become one partition, and partitions that end behind the ray's start are left out. Any number of
// threads may shoot, and callbacks may shoot.
#pragma once

#ifndef __cplusplus
#error "csgrt/librt.h is C++: programs in C use csgrt/csgrt.h"
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <csgrt/edit.hpp>
#include <csgrt/model.hpp>
#include <csgrt/renderer.hpp>
#include <csgrt/scene_io.hpp>

using fastf_t = double;
using point_t = fastf_t[3];
using vect_t = fastf_t[3];

/// A ray. r_min and r_max are not used: a ray begins at r_pt.
struct xray {
    point_t r_pt = {}, r_dir = {};
    fastf_t r_min = 0, r_max = 0;
};

/// One boundary of a partition. hit_point and hit_normal are always filled; RT_HIT_NORMAL only copies.
struct hit {
    fastf_t hit_dist = 0;
    point_t hit_point = {};
    vect_t hit_normal = {};  ///< a unit vector, outward from the region; zeros if the solid is "?"
    const xray* hit_rayp = nullptr;
};

struct directory {
    const char* d_namep = "";
};

/// A solid. It is "?" at a boundary that only a decision about an overlap makes, where no surface is.
struct soltab {
    const char* st_name = "?";
    const directory* st_dp = nullptr;
    long st_bit = -1;  ///< index into Model::solids()
};

struct seg {
    hit seg_in = {}, seg_out = {};
    soltab* seg_stp = nullptr;
};

struct mater_info {
    float ma_color[3] = {};
    int ma_color_valid = 1;
};

/// A link of a ring. Each linked struct begins with a link.
struct bu_list {
    bu_list *forw = nullptr, *back = nullptr;
};
#define BU_LIST_FOR(p, structure, head)                           \
    (p) = reinterpret_cast<struct structure*>((head)->forw);      \
    reinterpret_cast<bu_list*>(p) != static_cast<bu_list*>(head); \
    (p) = reinterpret_cast<struct structure*>(reinterpret_cast<bu_list*>(p)->forw)

/// A region of the prepared model.
struct region {
    bu_list l = {};             ///< link in the ring rt_i::HeadRegion
    const char* reg_name = "";  ///< the region's path, which no other region has
    long reg_bit = 0;           ///< index into Model::regions() and rt_i::Regions
    int reg_regionid = 0, reg_aircode = 0, reg_gmater = 0, reg_los = 0;
    mater_info reg_mater = {};
    void* reg_udata = nullptr;  ///< for the caller's data
};

/// A partition. All partitions of a ray are a ring through a head, which is not a partition.
struct partition {
    partition *pt_forw = nullptr, *pt_back = nullptr;
    seg *pt_inseg = nullptr, *pt_outseg = nullptr;
    hit *pt_inhit = nullptr, *pt_outhit = nullptr;
    region* pt_regionp = nullptr;
    char pt_inflip = 0, pt_outflip = 0;  ///< normals are outward, so nothing is flipped
};

/// librt's scratch memory of a thread. csgrt does not use it, because its threads have their own memory.
struct resource {
    int re_cpu = 0;
};
inline resource rt_uniresource;
#define RESOURCE_NULL (static_cast<struct resource*>(nullptr))
#define MAX_PSW 1024

/// The regions that claim a part of a ray. A handler removes the regions that do not get the part.
struct bu_ptbl {
    region** buffer = nullptr;
    size_t end = 0;  ///< number of regions
};
#define BU_PTBL_LEN(table) ((table)->end)
#define BU_PTBL_GET(table, i) ((table)->buffer[i])
#define BU_PTBL_SET(table, i, value) ((table)->buffer[i] = (value))
#define BU_PTBL_FOR(p, cast, table)            \
    (p) = cast(table)->buffer;                 \
    (p) != cast(table)->buffer + (table)->end; \
    ++(p)
inline void bu_ptbl_reset(bu_ptbl* table) { table->end = 0; }

/// The result of rt_dirbuild().
struct db_i {
    const char* dbi_title = "";
    double dbi_local2base = 1, dbi_base2local = 1;  ///< millimetres in one of the file's units, and the inverse
};

/// A model. rt_dirbuild() makes it; rt_prep_parallel() or the first ray prepares it.
struct rt_i {
    point_t mdl_min = {}, mdl_max = {};  ///< the model's box, millimetres
    int useair = 0;                      ///< other than 0: regions of air are part of the model; before rt_prep
    std::atomic<int> needprep = 1;
    size_t nregions = 0, nsolids = 0;                 ///< before rt_prep nsolids is the number of added objects
    region** Regions = nullptr;                       ///< (nregions)
    bu_list HeadRegion = {&HeadRegion, &HeadRegion};  ///< a ring of the same regions
    db_i* rti_dbip = &database;

    // csgrt's own members.
    csgrt::Scene scene;
    db_i database;
    bool asked = false;  ///< rt_gettree() was called
    std::vector<std::string> objects;
    std::optional<csgrt::Model> model;                ///< empty: there is nothing to hit
    std::optional<csgrt::Renderer> renderer;          ///< for shoot_many()
    std::vector<std::optional<csgrt::Model>> layers;  ///< models with some of the regions; see layers_of()
    static constexpr size_t none = static_cast<size_t>(-1);
    std::vector<size_t> layer;                  ///< for each region its layer; empty: not needed yet
    std::set<std::pair<size_t, size_t>> apart;  ///< pairs of regions that overlap on a ray, and need different layers
    std::mutex mutex;                           ///< guards the preparation, `renderer` and the layers
    std::vector<region> regions;
    std::vector<region*> region_pointers;
    std::vector<soltab> solids;
    std::vector<directory> directories;
    soltab unknown_solid;
};
#define RTI_NULL (static_cast<struct rt_i*>(nullptr))

/// A ray to shoot, and the functions to call with its answer.
struct application {
    xray a_ray = {};
    int (*a_hit)(application*, partition* head, seg*) = nullptr;  ///< called if there are partitions; seg is empty
    int (*a_miss)(application*) = nullptr;                        ///< called if there is no partition
    /// Decides which of two regions gets a part of the ray that both claim. 0: neither of them, 1: the first, 2: the
    /// second. For three and more regions, the function is called with the last winner and the next region. Null: the
    /// first region gets the part.
    int (*a_overlap)(application*, partition*, region*, region*, partition* head) = nullptr;
    /// Decides in place of a_overlap: removes regions from the table, or sets them null. The first remaining region
    /// gets the part.
    void (*a_multioverlap)(application*, partition*, bu_ptbl* regions, partition* head) = nullptr;
    /// Called with each overlap before the other functions. May be null.
    void (*a_logoverlap)(application*, const partition*, const bu_ptbl* regions, const partition* head) = nullptr;
    /// 0: all partitions. n: the partitions of the first n boundaries; -n: of the first n boundaries of regions other
    /// than air.
    int a_onehit = 0;
    rt_i* a_rt_i = nullptr;
    resource* a_resource = nullptr;
    const char* a_purpose = "";
    void* a_uptr = nullptr;
    int a_user = 0, a_level = 0, a_x = 0, a_y = 0, a_flag = 0;
    fastf_t a_dist = 0, a_color[3] = {};  ///< for the caller's data
    int a_return = 0;                     ///< the result of a_hit or a_miss
};
inline void rt_silent_logoverlap(application*, const partition*, const bu_ptbl*, const partition*) {}
#define RT_APPLICATION_INIT(ap) csgrt::librt::initialize(*(ap))
#define RT_APPLICATION_NULL (static_cast<struct application*>(nullptr))

#define RT_HIT_NORMAL(normal, hitp, stp, rayp, flip) \
    ((void)(stp), (void)(rayp), (void)(flip), csgrt::librt::copy((normal), (hitp)->hit_normal))

#define RT_CK_APPLICATION(p) ((void)(p))
#define RT_CK_AP(p) ((void)(p))
#define RT_CK_RTI(p) ((void)(p))
#define RT_CK_RESOURCE(p) ((void)(p))
#define RT_CK_RAY(p) ((void)(p))
#define RT_CK_HIT(p) ((void)(p))
#define RT_CK_PT(p) ((void)(p))
#define RT_CK_PARTITION(p) ((void)(p))
#define RT_CK_REGION(p) ((void)(p))
#define RT_CK_SEG(p) ((void)(p))
#define RT_CK_SOLTAB(p) ((void)(p))
#define PT_NULL (static_cast<struct partition*>(nullptr))
#define REGION_NULL (static_cast<struct region*>(nullptr))

// Names of libbu that callbacks use.
#ifndef UNUSED
#define UNUSED(parameter) UNUSED_##parameter [[maybe_unused]]
#endif
/// Prints to standard error.
[[gnu::format(printf, 1, 2)]] inline void bu_log(const char* format, ...) {
    va_list values;
    va_start(values, format);
    std::vfprintf(stderr, format, values);
    va_end(values);
}
/// Prints, unless `format` is null, and ends the process.
[[noreturn, gnu::format(printf, 2, 3)]] inline void bu_exit(int status, const char* format, ...) {
    if (format) {
        va_list values;
        va_start(values, format);
        std::vfprintf(stderr, format, values);
        va_end(values);
    }
    std::exit(status);
}
[[noreturn]] inline void bu_bomb(const char* text) { bu_exit(12, "\n%s\n", text); }
/// Allocates zeros; bu_free() frees them. Throws std::bad_alloc.
inline void* bu_calloc(size_t count, size_t size, const char*) {
    void* const memory = std::calloc(count, size);
    if (!memory) throw std::bad_alloc();
    return memory;
}
inline void* bu_malloc(size_t size, const char* of) { return bu_calloc(1, size, of); }
inline void bu_free(void* memory, const char*) { std::free(memory); }
#define BU_ALLOC(pointer, type) ((pointer) = static_cast<type*>(bu_calloc(1, sizeof(type), #type)))

#define BU_SEM_SYSCALL 0
/// The mutex of a semaphore, 0 to 31. Throws std::out_of_range for other numbers.
inline std::mutex& csgrt_semaphore(int semaphore) {
    static std::array<std::mutex, 32> all;
    return all.at(static_cast<size_t>(semaphore));
}
inline void bu_semaphore_acquire(int semaphore) { csgrt_semaphore(semaphore).lock(); }
inline void bu_semaphore_release(int semaphore) { csgrt_semaphore(semaphore).unlock(); }

// Names of vmath.h that programs that shoot rays use. If vmath.h is included before, its definitions hold.
#ifndef VSET
#define VSET(a, x, y, z) ((a)[0] = (x), (a)[1] = (y), (a)[2] = (z))
#define VSETALL(a, s) VSET(a, s, s, s)
#define VMOVE(a, b) VSET(a, (b)[0], (b)[1], (b)[2])
#define VREVERSE(a, b) VSCALE(a, b, -1.0)
#define VSCALE(a, b, s) ((a)[0] = (b)[0] * (s), (a)[1] = (b)[1] * (s), (a)[2] = (b)[2] * (s))
#define VJOIN1(a, b, c, d) \
    ((a)[0] = (b)[0] + (c) * (d)[0], (a)[1] = (b)[1] + (c) * (d)[1], (a)[2] = (b)[2] + (c) * (d)[2])
#define VBLEND2(a, b, c, d, e) \
    ((a)[0] = (b) * (c)[0] + (d) * (e)[0], (a)[1] = (b) * (c)[1] + (d) * (e)[1], (a)[2] = (b) * (c)[2] + (d) * (e)[2])
#define VADD2(a, b, c) VJOIN1(a, b, 1.0, c)
#define VSUB2(a, b, c) VJOIN1(a, b, -1.0, c)
#define VCROSS(a, b, c)                                                                      \
    ((a)[0] = (b)[1] * (c)[2] - (b)[2] * (c)[1], (a)[1] = (b)[2] * (c)[0] - (b)[0] * (c)[2], \
     (a)[2] = (b)[0] * (c)[1] - (b)[1] * (c)[0])
#define VDOT(a, b) ((a)[0] * (b)[0] + (a)[1] * (b)[1] + (a)[2] * (b)[2])
#define MAGSQ(a) VDOT(a, a)
#define MAGNITUDE(a) std::sqrt(MAGSQ(a))
#define VUNITIZE(a) csgrt::librt::unitize(a)  ///< zeros stay zeros
#define V3ARGS(a) (a)[0], (a)[1], (a)[2]
#define VPRINT(text, a) bu_log("%s (%g, %g, %g)\n", text, V3ARGS(a))
enum { X, Y, Z };
#endif

/// Prints a hit to standard error.
inline void rt_pr_hit(const char* text, const hit* hitp) {
    bu_log("HIT %s dist=%g\n", text, hitp->hit_dist);
    VPRINT("HIT Point", hitp->hit_point);
    VPRINT("HIT Normal", hitp->hit_normal);
}

namespace csgrt::librt {

inline void initialize(application& ap) { ap = {}; }
inline void copy(fastf_t* to, const fastf_t* from) { VMOVE(to, from); }
inline void copy(fastf_t* to, const Vec3& from) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }
template <class Vector>
void unitize(Vector& v) {
    const auto length = MAGNITUDE(v);
    if (length > 0) VSET(v, v[0] / length, v[1] / length, v[2] / length);
}
inline Ray ray_of(const xray& x) { return {{x.r_pt[0], x.r_pt[1], x.r_pt[2]}, {x.r_dir[0], x.r_dir[1], x.r_dir[2]}}; }

/// Has the application a function for overlaps?
inline bool wants_overlaps(const application& ap) {
    return ap.a_overlap || ap.a_multioverlap || (ap.a_logoverlap && ap.a_logoverlap != rt_silent_logoverlap);
}
/// The fields of the answer: overlaps only if the application has a function for them.
inline Fields fields(bool overlaps) { return {.solids = true, .normals = true, .overlaps = overlaps}; }
inline constexpr RayRanges whole_line{.all = {-std::numeric_limits<double>::infinity()}};

/// Models that together have the regions of the ray's overlaps. No model has two regions that overlap on a ray. The
/// bits of their surfaces are the prepared model's.
inline std::vector<Model> layers_of(rt_i& rtip, const Partitions& all, std::size_t ray) {
    const std::lock_guard lock(rtip.mutex);
    std::vector<std::size_t>& layer = rtip.layer;
    layer.resize(rtip.nregions, rt_i::none);
    std::set<std::size_t> regions, used;
    for (std::int64_t k = all.overlap_splits[ray]; k < all.overlap_splits[ray + 1]; ++k) {
        const std::int64_t* const splits = all.overlap_region_splits.data() + k;
        const std::span claimants(all.overlap_region_ids.data() + splits[0], all.overlap_region_ids.data() + splits[1]);
        for (std::size_t i = 0; i < claimants.size(); ++i) {
            const auto a = static_cast<std::size_t>(claimants[i]);
            regions.insert(a);
            for (std::size_t j = 0; j < i; ++j) {
                const auto b = static_cast<std::size_t>(claimants[j]);
                rtip.apart.insert({{a, b}, {b, a}});
                if (layer[a] == rt_i::none || layer[a] != layer[b]) continue;
                rtip.layers[layer[a]].reset();
                layer[a] = rt_i::none;
            }
        }
    }
    for (const std::size_t number : regions) {
        if (layer[number] == rt_i::none) {
            std::set<std::size_t> taken;
            for (auto pair = rtip.apart.lower_bound({number, 0}); pair != rtip.apart.end() && pair->first == number;
                 ++pair)
                taken.insert(layer[pair->second]);
            std::size_t free = 0;
            while (taken.contains(free)) ++free;
            rtip.layers.resize(std::max(rtip.layers.size(), free + 1));
            rtip.layers[free].reset();
            layer[number] = free;
        }
        used.insert(layer[number]);
    }
    std::vector<Model> models;
    for (const std::size_t number : used) {
        std::optional<Model>& model = rtip.layers[number];
        if (!model) {
            Edit edit(*rtip.model);
            std::set<std::string> tops;
            for (const region& one : rtip.regions) tops.emplace(one.reg_name, std::strcspn(one.reg_name + 1, "/") + 1);
            for (const std::string& top : tops) edit.set_state(top, State::hidden);
            for (std::size_t i = 0; i < layer.size(); ++i)
                if (layer[i] == number) edit.set_state(rtip.Regions[i]->reg_name, State::shown);
            model = edit.commit();
        }
        models.push_back(*model);
    }
    return models;
}

/// A part of a ray before it becomes one of librt's partitions.
struct Piece {
    double t[2];  ///< in, out
    std::int32_t region, solids[2];
    Vec3 normals[2];
};

/// The memory of one ray's answer. A callback that shoots needs memory of its own.
struct Answer {
    Partitions rows;
    std::vector<Piece> pieces, others;
    std::vector<seg> segs;        // two for each partition, for its in and its out
    std::vector<partition> ring;  // the head, then the partitions
    partition overlap;
    seg overlap_segs[2];
    std::vector<region*> claimants;  // of the current overlap
    struct Surface {
        double t = 0;
        std::int32_t solid = -1;
        Vec3 normal = {};  ///< points against the ray
    };
    std::vector<Surface> surfaces;  // of the ray's overlapping regions, each as if alone; empty: not computed
    Partitions own;

    void start(const Partitions& all, std::int64_t first, std::int64_t last) {
        pieces.clear();
        for (std::int64_t k = first; k < last; ++k) {
            const auto i = static_cast<std::size_t>(k);
            if (all.t_out[i] < 0) continue;
            pieces.push_back({{all.t_in[i], all.t_out[i]},
                              all.region_ids[i],
                              {all.in_solids[i], all.out_solids[i]},
                              {all.in_normals[i], all.out_normals[i]}});
        }
    }

    static void put(seg& at, hit& end, rt_i& rtip, const xray& ray, double t, const Vec3& normal, std::int32_t solid) {
        end.hit_dist = t;
        for (int i = 0; i < 3; ++i) end.hit_point[i] = ray.r_pt[i] + t * ray.r_dir[i];
        copy(end.hit_normal, normal);
        end.hit_rayp = &ray;
        at.seg_stp = solid < 0 ? &rtip.unknown_solid : &rtip.solids[static_cast<std::size_t>(solid)];
    }
    static void fill(partition& of, seg* segs_of, rt_i& rtip, const xray& ray, const Piece& piece) {
        of.pt_regionp = rtip.Regions[piece.region];
        of.pt_inseg = &segs_of[0];
        of.pt_outseg = &segs_of[1];
        of.pt_inhit = &segs_of[0].seg_in;
        of.pt_outhit = &segs_of[1].seg_out;
        put(segs_of[0], segs_of[0].seg_in, rtip, ray, piece.t[0], piece.normals[0], piece.solids[0]);
        put(segs_of[1], segs_of[1].seg_out, rtip, ray, piece.t[1], piece.normals[1], piece.solids[1]);
    }
    partition& make_ring(rt_i& rtip, const xray& ray) {
        ring.resize(pieces.size() + 1);
        segs.resize(2 * pieces.size());
        for (std::size_t i = 0; i < ring.size(); ++i) {
            ring[i].pt_forw = &ring[(i + 1) % ring.size()];
            ring[i].pt_back = &ring[(i + ring.size() - 1) % ring.size()];
            if (i > 0) fill(ring[i], &segs[2 * (i - 1)], rtip, ray, pieces[i - 1]);
        }
        return ring.front();
    }

    /// Finds the surfaces of all regions that overlap another region along the ray.
    void find_surfaces(const application& ap, const Partitions& all, std::size_t ray) {
        for (const Model& model : layers_of(*ap.a_rt_i, all, ray)) {
            model.partitions(ray_of(ap.a_ray), own, {.solids = true, .normals = true, .hidden = false}, whole_line);
            for (std::size_t i = 0; i < own.region_ids.size(); ++i) {
                const Vec3& out = own.out_normals[i];
                surfaces.push_back({own.t_in[i], own.in_solids[i], own.in_normals[i]});
                surfaces.push_back({own.t_out[i], own.out_solids[i], {-out.x, -out.y, -out.z}});
            }
        }
    }
    /// The surface nearest to t, within the model's tolerance.
    Surface surface_at(const application& ap, double t) const {
        double nearest = ap.a_rt_i->model->tolerance() / MAGNITUDE(ap.a_ray.r_dir);
        Surface found;
        for (const Surface& surface : surfaces) {
            const double off = std::abs(surface.t - t);
            if (!(off <= nearest) || (off == nearest && found.solid >= 0)) continue;
            nearest = off;
            found = surface;
        }
        return found;
    }

    /// Gives the interval [in, out] of region `first` to region `next`, or to no region if `next` is -1.
    void give(const application& ap, double in, double out, std::int32_t first, std::int32_t next) {
        others.clear();
        for (const Piece& piece : pieces) {
            if (piece.region != first || piece.t[1] <= in || piece.t[0] >= out) {
                others.push_back(piece);
                continue;
            }
            const auto part = [&](double from, double to, std::int32_t region) {
                Piece cut = piece;
                cut.region = region;
                if (from > piece.t[0]) {
                    const Surface at = surface_at(ap, from);
                    cut.t[0] = from, cut.solids[0] = at.solid, cut.normals[0] = at.normal;
                }
                if (to < piece.t[1]) {
                    const Surface at = surface_at(ap, to);
                    cut.t[1] = to, cut.solids[1] = at.solid;
                    cut.normals[1] = {-at.normal.x, -at.normal.y, -at.normal.z};
                }
                if (cut.t[0] < cut.t[1]) others.push_back(cut);
            };
            part(piece.t[0], std::min(in, piece.t[1]), first);
            if (next >= 0) part(in, out, next);
            part(std::max(out, piece.t[0]), piece.t[1], first);
        }
        pieces.clear();
        for (const Piece& piece : others) {  // neighbours of one region are one partition
            Piece* const last = pieces.empty() ? nullptr : &pieces.back();
            if (last && last->region == piece.region && last->t[1] == piece.t[0]) {
                last->t[1] = piece.t[1];
                last->solids[1] = piece.solids[1];
                last->normals[1] = piece.normals[1];
            } else {
                pieces.push_back(piece);
            }
        }
    }

    /// The region among `claimants`, two or more, that gets their overlap. Null: no region.
    region* decide(application& ap, double in, double out) {
        rt_i& rtip = *ap.a_rt_i;
        const auto of = [&](const region* owner) {  // the overlap as a partition of `owner`
            fill(overlap, overlap_segs, rtip, ap.a_ray,
                 {{in, out}, static_cast<std::int32_t>(owner->reg_bit), {-1, -1}, {}});
            return &overlap;
        };
        partition* const head = &make_ring(rtip, ap.a_ray);
        bu_ptbl table{claimants.data(), claimants.size()};
        if (ap.a_logoverlap) ap.a_logoverlap(&ap, of(claimants[0]), &table, head);
        if (ap.a_multioverlap) {
            ap.a_multioverlap(&ap, of(claimants[0]), &table, head);
            region** const end = table.buffer + table.end;
            region** const left = std::find_if(table.buffer, end, [](const region* one) { return one != nullptr; });
            return left == end ? nullptr : *left;
        }
        region* left = nullptr;
        for (region* const next : claimants) {
            const int code = left && ap.a_overlap ? ap.a_overlap(&ap, of(left), left, next, head) : left ? 1 : 2;
            left = code == 0 ? nullptr : code == 2 ? next : left;
        }
        return left;
    }

    void ask_about_overlaps(application& ap, const Partitions& all, std::size_t ray) {
        surfaces.clear();
        for (std::int64_t k = all.overlap_splits[ray]; k < all.overlap_splits[ray + 1]; ++k) {
            const auto i = static_cast<std::size_t>(k);
            const double in = all.overlap_t_in[i], out = all.overlap_t_out[i];
            if (out < 0) continue;
            claimants.clear();
            for (std::int64_t j = all.overlap_region_splits[i]; j < all.overlap_region_splits[i + 1]; ++j)
                claimants.push_back(ap.a_rt_i->Regions[all.overlap_region_ids[static_cast<std::size_t>(j)]]);
            const auto owner = static_cast<std::int32_t>(claimants[0]->reg_bit);
            const region* const left = decide(ap, in, out);
            const std::int32_t next = left ? static_cast<std::int32_t>(left->reg_bit) : -1;
            if (next == owner) continue;
            if (surfaces.empty()) find_surfaces(ap, all, ray);
            give(ap, in, out, owner, next);
        }
        std::erase_if(pieces, [](const Piece& piece) { return piece.t[1] < 0; });
    }

    /// Calls the application's functions for ray `ray` of `all`, with or without overlaps.
    int tell(application& ap, const Partitions& all, bool has_overlaps, std::size_t ray) {
        rt_i& rtip = *ap.a_rt_i;
        pieces.clear();
        if (rtip.model) start(all, all.ray_splits[ray], all.ray_splits[ray + 1]);
        if (rtip.model && has_overlaps) ask_about_overlaps(ap, all, ray);
        if (ap.a_onehit != 0) {
            int ends = std::abs(ap.a_onehit);
            const auto is_last = [&](const Piece& piece) {
                if (ap.a_onehit > 0 || rtip.Regions[piece.region]->reg_aircode == 0) ends -= 2;
                return ends <= 0;
            };
            const auto last = std::find_if(pieces.begin(), pieces.end(), is_last);
            if (last != pieces.end()) pieces.erase(last + 1, pieces.end());
        }
        if (pieces.empty()) return ap.a_return = ap.a_miss ? ap.a_miss(&ap) : 0;
        partition& head = make_ring(rtip, ap.a_ray);
        seg none;
        return ap.a_return = ap.a_hit ? ap.a_hit(&ap, &head, &none) : 1;
    }
};

/// Reserves the calling thread's next free Answer while it lives.
class Borrowed {
public:
    Borrowed() {
        if (depth() == answers().size()) answers().emplace_back();
        answer_ = &answers()[depth()++];
    }
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    ~Borrowed() { --depth(); }
    Answer* operator->() const { return answer_; }

private:
    static std::deque<Answer>& answers() {
        static thread_local std::deque<Answer> all;
        return all;
    }
    static std::size_t& depth() {
        static thread_local std::size_t depth = 0;
        return depth;
    }
    Answer* answer_;
};

inline void prepare(rt_i& rtip, int threads) {
    Settings settings;
    settings.air = rtip.useair != 0;
    settings.threads = threads > 0 ? static_cast<unsigned>(threads) : 0;
    rtip.model.reset();
    rtip.renderer.reset();
    rtip.layers.clear();
    rtip.layer.clear();
    rtip.apart.clear();
    rtip.nregions = rtip.nsolids = 0;
    rtip.HeadRegion = {&rtip.HeadRegion, &rtip.HeadRegion};
    if (rtip.asked && rtip.objects.empty()) {
        rtip.needprep = 0;
        return;
    }
    rtip.model.emplace(rtip.scene, rtip.objects, settings);
    const Model& model = *rtip.model;
    copy(rtip.mdl_min, model.bounds().low);
    copy(rtip.mdl_max, model.bounds().high);
    rtip.nregions = model.regions().size();
    rtip.nsolids = model.solids().size();
    rtip.directories.resize(rtip.nsolids);
    rtip.solids.resize(rtip.nsolids);
    for (std::size_t i = 0; i < rtip.nsolids; ++i) {
        rtip.directories[i].d_namep = model.solids()[i].name.c_str();
        rtip.solids[i] = {rtip.directories[i].d_namep, &rtip.directories[i], static_cast<long>(i)};
    }
    static constexpr directory unknown{"?"};
    rtip.unknown_solid.st_dp = &unknown;
    rtip.regions.clear();
    for (const RegionInfo& info : model.regions()) {
        region one{.reg_name = info.path.c_str(),
                   .reg_bit = static_cast<long>(rtip.regions.size()),
                   .reg_regionid = info.region_id,
                   .reg_aircode = info.air,
                   .reg_gmater = info.material_id,
                   .reg_los = info.los};
        const double color[] = {info.color.x, info.color.y, info.color.z};
        for (int i = 0; i < 3; ++i) one.reg_mater.ma_color[i] = static_cast<float>(color[i]);
        rtip.regions.push_back(one);
    }
    rtip.region_pointers.clear();
    for (region& one : rtip.regions) {
        bu_list* const last = rtip.HeadRegion.back;
        one.l = {&rtip.HeadRegion, last};
        last->forw = rtip.HeadRegion.back = &one.l;
        rtip.region_pointers.push_back(&one);
    }
    rtip.Regions = rtip.region_pointers.data();
    rtip.needprep = 0;  // set last, because other threads then shoot
}

inline rt_i& prepared(rt_i* rtip) {
    if (!rtip) throw Error(Status::usage, "there is no model: rt_dirbuild() returned RTI_NULL");
    if (rtip->needprep) {
        const std::lock_guard lock(rtip->mutex);
        if (rtip->needprep) prepare(*rtip, 1);
    }
    return *rtip;
}

/// Calls each(partition) for the ray's partitions in order, until a call returns false. Returns true if no call did.
/// The first region of an overlap gets the part. Any thread. Throws Error: usage.
template <class Each>
bool shoot(rt_i* rtip, const xray& ray, const Each& each) {
    if (!prepared(rtip).model) return true;
    const Borrowed answer;
    rtip->model->partitions(ray_of(ray), answer->rows, fields(false), whole_line);
    answer->start(answer->rows, 0, answer->rows.ray_splits[1]);
    const partition& head = answer->make_ring(*rtip, ray);
    for (const partition* p = head.pt_forw; p != &head; p = p->pt_forw)
        if (!each(*p)) return false;
    return true;
}

/// Does the same as rt_shootray() for each ray, in order, but all processors or the GPU trace. The application's
/// functions are called with the ray in a_ray and its index in a_x. Returns the number of rays for which a_hit was
/// called. Throws Error: usage, out_of_memory, device_fault.
inline std::size_t shoot_many(application* ap, const xray* rays, std::size_t count) {
    rt_i& rtip = prepared(ap->a_rt_i);
    constexpr std::size_t most = 1 << 17;
    const Borrowed answer;
    std::vector<Ray> part;
    std::size_t hits = 0;
    for (std::size_t first = 0; first < count; first += most) {
        const bool overlaps = wants_overlaps(*ap);
        part.clear();
        for (std::size_t i = first; i < std::min(count, first + most); ++i) part.push_back(ray_of(rays[i]));
        if (rtip.model) {
            const std::lock_guard lock(rtip.mutex);
            if (!rtip.renderer) rtip.renderer.emplace(*rtip.model);
            rtip.renderer->partitions(part, answer->rows, fields(overlaps), whole_line);
        }
        for (std::size_t i = 0; i < part.size(); ++i) {
            ap->a_ray = rays[first + i];
            ap->a_x = static_cast<int>(first + i);
            answer->tell(*ap, answer->rows, overlaps, i);
            hits += !answer->pieces.empty();
        }
    }
    return hits;
}

inline int refuse(const char* where, const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", where, error.what());
    return -1;
}

}  // namespace csgrt::librt

/// Reads a model (.g, .asc, .json); `title` becomes the model's title, cut to `length`. RTI_NULL: the model cannot be
/// read, and standard error has the reason.
inline rt_i* rt_dirbuild(const char* file, char* title, int length) {
    try {
        auto rtip = std::make_unique<rt_i>();
        rtip->scene = csgrt::load_scene(file);
        rtip->database = {rtip->scene.title.c_str(), rtip->scene.unit_length, 1 / rtip->scene.unit_length};
        if (title && length > 0)
            std::snprintf(title, static_cast<std::size_t>(length), "%s", rtip->scene.title.c_str());
        return rtip.release();
    } catch (const std::exception& error) {
        csgrt::librt::refuse("rt_dirbuild", error);
        return RTI_NULL;
    }
}

/// Adds an object, by its name or a path to it, to the objects that rt_prep_parallel() prepares. Below 0: there is no
/// such object.
inline int rt_gettree(rt_i* rtip, const char* name) {
    rtip->asked = true;
    if (!csgrt::object_at(rtip->scene, name))
        return csgrt::librt::refuse("rt_gettree", std::runtime_error(std::string("no object '") + name + "'"));
    rtip->objects.emplace_back(name);
    rtip->nsolids = rtip->objects.size();
    rtip->needprep = 1;
    return 0;
}

/// Adds several objects. If an object does not exist, adds none and returns a number below 0.
inline int rt_gettrees(rt_i* rtip, int count, const char** names, int) {
    const std::size_t before = rtip->objects.size();
    for (int i = 0; i < count; ++i)
        if (rt_gettree(rtip, names[i]) < 0) {
            rtip->nsolids = before;
            rtip->objects.resize(before);
            return -1;
        }
    return 0;
}

/// Compiles the added objects. If rt_gettree() was called and found nothing, the model is empty; if it was never
/// called, the scene's top objects are compiled. `threads` = 0: one for each processor. Throws csgrt::Error (scene)
/// where librt ends the process.
inline void rt_prep_parallel(rt_i* rtip, int threads) {
    const std::lock_guard lock(rtip->mutex);
    csgrt::librt::prepare(*rtip, threads);
}
inline void rt_prep(rt_i* rtip) { rt_prep_parallel(rtip, 1); }
/// Shoots ap->a_ray through ap->a_rt_i: calls a_overlap for each overlap, then a_hit or a_miss, and returns its result.
/// Prepares the model if it is not prepared. Any thread. Throws csgrt::Error: usage for an invalid ray, and the errors
/// of rt_prep_parallel().
inline int rt_shootray(application* ap) {
    rt_i& rtip = csgrt::librt::prepared(ap->a_rt_i);
    const csgrt::librt::Borrowed answer;
    const bool overlaps = csgrt::librt::wants_overlaps(*ap);
    if (rtip.model)
        rtip.model->partitions(csgrt::librt::ray_of(ap->a_ray), answer->rows, csgrt::librt::fields(overlaps),
                               csgrt::librt::whole_line);
    return answer->tell(*ap, answer->rows, overlaps, 0);
}

inline void rt_init_resource(resource* of, int cpu, rt_i*) { of->re_cpu = cpu; }
inline void rt_clean_resource(rt_i*, resource*) {}
inline void rt_clean_resource_complete(rt_i*, resource*) {}
/// Removes all objects and the prepared model, so that other objects can be added.
inline void rt_clean(rt_i* rtip) {
    rtip->objects.clear();
    rtip->asked = true;
    rtip->needprep = 1;
    csgrt::librt::prepared(rtip);
}
inline void rt_free_rti(rt_i* rtip) { delete rtip; }
