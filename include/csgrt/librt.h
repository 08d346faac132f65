// librt's shape: programs that shoot rays by BRL-CAD's names (rt_dirbuild, rt_gettrees, rt_prep_parallel, rt_shootray)
// compile with this header in place of raytrace.h, and csgrt answers. The definitions are csgrt's own, as far as gqa,
// rtcheck, rtweight, rtxray, rtshot and rtexample use librt; docs/librt.md says what is where. C++ alone.
//
// Distances are in lengths of r_dir. The partitions are those of Renderer::shoot(), to the last bit: neighbours of one
// region are one partition, and what ends behind the ray's start is left out. A model is prepared by one thread; then
// any number of threads shoot, and callbacks may shoot.
#pragma once

#ifndef __cplusplus
#error "csgrt/librt.h is C++: programs in C use csgrt/csgrt.h"
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <csgrt/model.hpp>
#include <csgrt/renderer.hpp>
#include <csgrt/scene_io.hpp>

using fastf_t = double;
using point_t = fastf_t[3];
using vect_t = fastf_t[3];

/// A type that cannot be used: csgrt has no such member. The compiler's message names it.
struct csgrt_does_not_have {
    template <class T>
    operator T() const = delete;
    template <class T>
    csgrt_does_not_have& operator=(const T&) = delete;
};

/// A ray. r_min and r_max are not used: a ray begins at r_pt.
struct xray {
    point_t r_pt = {}, r_dir = {};
    fastf_t r_min = 0, r_max = 0;
};

/// One end of a partition. hit_point and hit_normal are there from the start: RT_HIT_NORMAL copies.
struct hit {
    fastf_t hit_dist = 0;
    point_t hit_point = {};
    vect_t hit_normal = {};  ///< a unit vector, outward from the region; zeros where an overlap was cut
    csgrt_does_not_have hit_surfno = {}, hit_vpriv = {};
    const xray* hit_rayp = nullptr;
};

struct directory {
    const char* d_namep = "";
};

/// A solid. An end that a decision about an overlap made has the solid "?".
struct soltab {
    const char* st_name = "?";
    const directory* st_dp = nullptr;
    long st_bit = -1;  ///< index into Model::solids()
};

struct seg {
    hit seg_in = {}, seg_out = {};
    const soltab* seg_stp = nullptr;
};

struct mater_info {
    float ma_color[3] = {};
    int ma_color_valid = 1;
};

/// A region of the prepared model.
struct region {
    const char* reg_name = "";  ///< its path, which no other region has
    long reg_bit = 0;           ///< index into Model::regions() and rt_i::Regions
    int reg_regionid = 0, reg_aircode = 0, reg_gmater = 0, reg_los = 0;
    mater_info reg_mater = {};
    void* reg_udata = nullptr;  ///< the caller's
};

/// A partition; all of a ray are a ring through a head, which is none itself.
struct partition {
    partition *pt_forw = nullptr, *pt_back = nullptr;
    seg *pt_inseg = nullptr, *pt_outseg = nullptr;
    hit *pt_inhit = nullptr, *pt_outhit = nullptr;
    region* pt_regionp = nullptr;
    char pt_inflip = 0, pt_outflip = 0;  ///< normals are outward: there is nothing to flip
};

/// librt's scratch memory of a thread. Here each thread has its own by itself.
struct resource {
    int re_cpu = 0;
};
inline resource rt_uniresource;

struct bu_ptbl;  // of a_logoverlap's parameter

/// A model: made by rt_dirbuild(), prepared by rt_prep_parallel().
struct rt_i {
    point_t mdl_min = {}, mdl_max = {};  ///< the model's box, millimetres
    int useair = 0;                      ///< other than 0: regions of air are part of the model; before rt_prep
    size_t nregions = 0, nsolids = 0;
    region** Regions = nullptr;  ///< (nregions), in place of librt's list HeadRegion

    // csgrt's own.
    csgrt::Scene scene;
    std::vector<std::string> objects;
    std::optional<csgrt::Model> model;
    std::optional<csgrt::Renderer> renderer;  ///< of shoot_many()
    std::mutex renderer_mutex;
    std::vector<region> regions;
    std::vector<region*> region_pointers;
    std::vector<soltab> solids;
    std::vector<directory> directories;
    soltab unknown_solid;
};
#define RTI_NULL (static_cast<struct rt_i*>(nullptr))

/// What to shoot, and who is told.
struct application {
    xray a_ray = {};
    int (*a_hit)(application*, partition* head, seg*) = nullptr;  ///< where there are partitions; the list is empty
    int (*a_miss)(application*) = nullptr;                        ///< where there is none
    /// For two regions that claim a part of the ray: 0: neither gets it, 1: the first, 2: the second. Of three and more
    /// the one that is left is asked about with the next. Null: the first gets it.
    int (*a_overlap)(application*, partition*, region*, region*, partition* head) = nullptr;
    void (*a_logoverlap)(application*, const partition*, const bu_ptbl*, const partition*) = nullptr;  ///< not called
    /// 0: all partitions. n: those of the first n ends; -n: of the first n ends of regions that are no air.
    int a_onehit = 0;
    rt_i* a_rt_i = nullptr;
    resource* a_resource = nullptr;
    const char* a_purpose = "";
    void* a_uptr = nullptr;
    int a_user = 0, a_level = 0, a_x = 0, a_y = 0;
    int a_return = 0;  ///< what a_hit or a_miss returned
};
#define RT_APPLICATION_INIT(ap) (*(ap) = application())
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

// Of vmath.h, what programs that shoot rays use; its own definitions count where it is included before.
#ifndef VSET
#define VSET(a, x, y, z) ((a)[0] = (x), (a)[1] = (y), (a)[2] = (z))
#define VMOVE(a, b) csgrt::librt::copy((a), (b))
#define VJOIN1(a, b, c, d) \
    ((a)[0] = (b)[0] + (c) * (d)[0], (a)[1] = (b)[1] + (c) * (d)[1], (a)[2] = (b)[2] + (c) * (d)[2])
#define VADD2(a, b, c) VJOIN1(a, b, 1.0, c)
#define VSUB2(a, b, c) VJOIN1(a, b, -1.0, c)
#define VDOT(a, b) ((a)[0] * (b)[0] + (a)[1] * (b)[1] + (a)[2] * (b)[2])
#define MAGNITUDE(a) std::sqrt(VDOT(a, a))
enum { X, Y, Z };
#endif

// What csgrt does not have. A use does not compile, and the compiler names it.
struct curvature;  // never defined
struct uvcoord;    // never defined
template <class... T>
void csgrt_has_no_curvature(T&&...) = delete;
template <class... T>
void csgrt_has_no_uv_coordinates(T&&...) = delete;
#define RT_CURVATURE(...) csgrt_has_no_curvature(__VA_ARGS__)
#define RT_HIT_UV(...) csgrt_has_no_uv_coordinates(__VA_ARGS__)
#define RT_HIT_UVCOORD(...) csgrt_has_no_uv_coordinates(__VA_ARGS__)

namespace csgrt::librt {

inline void copy(fastf_t* to, const fastf_t* from) { std::copy_n(from, 3, to); }
inline void copy(fastf_t* to, const Vec3& from) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }
inline Ray ray_of(const xray& x) { return {{x.r_pt[0], x.r_pt[1], x.r_pt[2]}, {x.r_dir[0], x.r_dir[1], x.r_dir[2]}}; }

/// Overlaps only for those who are asked about them.
inline Fields fields(bool overlaps) { return {.solids = true, .normals = true, .overlaps = overlaps}; }
inline constexpr RayRanges whole_line{.all = {-std::numeric_limits<double>::infinity()}};

/// A part of a ray before it is one of librt's partitions.
struct Piece {
    double t[2];  ///< in, out
    std::int32_t region, solids[2];
    Vec3 normals[2];
};

/// The memory of one ray's answer. A callback that shoots needs another one.
struct Answer {
    Partitions rows;
    std::vector<Piece> pieces, others;
    std::vector<seg> segs;        // two a partition: of its in and of its out
    std::vector<partition> ring;  // the head, then one a piece
    partition overlap;
    seg overlap_segs[2];

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

    static void put(seg& at, hit& end, const rt_i& rtip, const xray& ray, double t, const Vec3& normal,
                    std::int32_t solid) {
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

    /// The interval [in, out], which is region `first`'s, becomes region `next`'s; -1: nobody's.
    void give(double in, double out, std::int32_t first, std::int32_t next) {
        others.clear();
        for (const Piece& piece : pieces) {
            if (piece.region != first || piece.t[1] <= in || piece.t[0] >= out) {
                others.push_back(piece);
                continue;
            }
            const auto part = [&](double from, double to, std::int32_t region) {
                Piece cut = piece;
                cut.region = region;
                if (from > piece.t[0]) cut.t[0] = from, cut.solids[0] = -1, cut.normals[0] = {};
                if (to < piece.t[1]) cut.t[1] = to, cut.solids[1] = -1, cut.normals[1] = {};
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

    void ask_about_overlaps(application& ap, const Partitions& all, std::size_t ray) {
        for (std::int64_t k = all.overlap_splits[ray]; k < all.overlap_splits[ray + 1]; ++k) {
            const auto i = static_cast<std::size_t>(k);
            const double in = all.overlap_t_in[i], out = all.overlap_t_out[i];
            if (out < 0) continue;
            const auto first = static_cast<std::size_t>(all.overlap_region_splits[i]);
            const auto last = static_cast<std::size_t>(all.overlap_region_splits[i + 1]);
            const std::int32_t owner = all.overlap_region_ids[first];
            std::int32_t left = owner;
            for (std::size_t j = first + 1; j < last; ++j) {
                const std::int32_t next = all.overlap_region_ids[j];
                if (left < 0) {
                    left = next;
                    continue;
                }
                partition& head = make_ring(*ap.a_rt_i, ap.a_ray);
                fill(overlap, overlap_segs, *ap.a_rt_i, ap.a_ray, {{in, out}, left, {-1, -1}, {}});
                const int code = ap.a_overlap(&ap, &overlap, ap.a_rt_i->Regions[left], ap.a_rt_i->Regions[next], &head);
                left = code == 0 ? -1 : code == 2 ? next : left;
            }
            if (left != owner) give(in, out, owner, left);
        }
        std::erase_if(pieces, [](const Piece& piece) { return piece.t[1] < 0; });
    }

    /// Calls the application about ray `ray` of `all`, which has overlaps or not.
    int tell(application& ap, const Partitions& all, bool has_overlaps, std::size_t ray) {
        rt_i& rtip = *ap.a_rt_i;
        start(all, all.ray_splits[ray], all.ray_splits[ray + 1]);
        if (has_overlaps && ap.a_overlap) ask_about_overlaps(ap, all, ray);
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

/// The calling thread's next free Answer, as long as this lives.
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

inline rt_i& prepared(rt_i* rtip) {
    if (!rtip || !rtip->model) throw Error(Status::usage, "the model is not prepared: call rt_prep_parallel() first");
    return *rtip;
}

/// Calls each(partition) for the ray's partitions in order, until it returns false. True: it was called for all. Of
/// overlaps the first region has the part. Any thread. Throws Error: usage.
template <class Each>
bool shoot(rt_i* rtip, const xray& ray, const Each& each) {
    prepared(rtip);
    const Borrowed answer;
    rtip->model->partitions(ray_of(ray), answer->rows, fields(false), whole_line);
    answer->start(answer->rows, 0, answer->rows.ray_splits[1]);
    const partition& head = answer->make_ring(*rtip, ray);
    for (const partition* p = head.pt_forw; p != &head; p = p->pt_forw)
        if (!each(*p)) return false;
    return true;
}

/// As rt_shootray() of each ray, in order; all of the processor or the GPU trace. The application is told with the ray
/// in a_ray and its number in a_x. Returns how many rays a_hit was called for. Throws Error: usage, out_of_memory,
/// device_fault.
inline std::size_t shoot_many(application* ap, const xray* rays, std::size_t count) {
    rt_i& rtip = prepared(ap->a_rt_i);
    constexpr std::size_t most = 1 << 17;
    const Borrowed answer;
    std::vector<Ray> part;
    std::size_t hits = 0;
    for (std::size_t first = 0; first < count; first += most) {
        const bool overlaps = ap->a_overlap != nullptr;
        part.clear();
        for (std::size_t i = first; i < std::min(count, first + most); ++i) part.push_back(ray_of(rays[i]));
        {
            const std::lock_guard lock(rtip.renderer_mutex);
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

/// Reads a model (.g, .asc, .json); its title goes into `title`, cut to `length`. RTI_NULL: it cannot be read, and
/// standard error says why.
inline rt_i* rt_dirbuild(const char* file, char* title, int length) {
    try {
        auto rtip = std::make_unique<rt_i>();
        rtip->scene = csgrt::load_scene(file);
        if (title && length > 0)
            std::snprintf(title, static_cast<std::size_t>(length), "%s", rtip->scene.title.c_str());
        return rtip.release();
    } catch (const std::exception& error) {
        csgrt::librt::refuse("rt_dirbuild", error);
        return RTI_NULL;
    }
}

/// Adds an object, or a path to it, to what rt_prep_parallel() prepares. Below 0: there is none of that name.
inline int rt_gettree(rt_i* rtip, const char* name) {
    if (!csgrt::object_at(rtip->scene, name))
        return csgrt::librt::refuse("rt_gettree", std::runtime_error(std::string("no object '") + name + "'"));
    rtip->objects.emplace_back(name);
    return 0;
}

/// Several objects: all, or none and below 0.
inline int rt_gettrees(rt_i* rtip, int count, const char** names, int) {
    const std::size_t before = rtip->objects.size();
    for (int i = 0; i < count; ++i)
        if (rt_gettree(rtip, names[i]) < 0) {
            rtip->objects.resize(before);
            return -1;
        }
    return 0;
}

/// Compiles what was added; without anything the scene's top objects. `threads`: 0: one for each processor. Throws
/// csgrt::Error (scene) where librt ends the process.
inline void rt_prep_parallel(rt_i* rtip, int threads) {
    csgrt::Settings settings;
    settings.air = rtip->useair != 0;
    settings.threads = threads > 0 ? static_cast<unsigned>(threads) : 0;
    rtip->model.emplace(rtip->scene, rtip->objects, settings);
    const csgrt::Model& model = *rtip->model;
    csgrt::librt::copy(rtip->mdl_min, model.bounds().low);
    csgrt::librt::copy(rtip->mdl_max, model.bounds().high);
    rtip->nregions = model.regions().size();
    rtip->nsolids = model.solids().size();
    rtip->directories.resize(rtip->nsolids);
    rtip->solids.resize(rtip->nsolids);
    for (std::size_t i = 0; i < rtip->nsolids; ++i) {
        rtip->directories[i].d_namep = model.solids()[i].name.c_str();
        rtip->solids[i] = {rtip->directories[i].d_namep, &rtip->directories[i], static_cast<long>(i)};
    }
    static constexpr directory unknown{"?"};
    rtip->unknown_solid.st_dp = &unknown;
    rtip->regions.clear();
    for (const csgrt::RegionInfo& info : model.regions()) {
        region one{.reg_name = info.path.c_str(),
                   .reg_bit = static_cast<long>(rtip->regions.size()),
                   .reg_regionid = info.region_id,
                   .reg_aircode = info.air,
                   .reg_gmater = info.material_id,
                   .reg_los = info.los};
        const double color[] = {info.color.x, info.color.y, info.color.z};
        for (int i = 0; i < 3; ++i) one.reg_mater.ma_color[i] = static_cast<float>(color[i]);
        rtip->regions.push_back(one);
    }
    rtip->region_pointers.clear();
    for (region& one : rtip->regions) rtip->region_pointers.push_back(&one);
    rtip->Regions = rtip->region_pointers.data();
}
inline void rt_prep(rt_i* rtip) { rt_prep_parallel(rtip, 1); }

/// Shoots ap->a_ray through ap->a_rt_i: calls a_overlap about each overlap, then a_hit or a_miss, and returns its
/// result. Any thread. Throws csgrt::Error (usage) for a model that is not prepared, or a ray that is none.
inline int rt_shootray(application* ap) {
    rt_i& rtip = csgrt::librt::prepared(ap->a_rt_i);
    const csgrt::librt::Borrowed answer;
    const bool overlaps = ap->a_overlap != nullptr;
    rtip.model->partitions(csgrt::librt::ray_of(ap->a_ray), answer->rows, csgrt::librt::fields(overlaps),
                           csgrt::librt::whole_line);
    return answer->tell(*ap, answer->rows, overlaps, 0);
}

inline void rt_init_resource(resource* of, int cpu, rt_i*) { of->re_cpu = cpu; }
inline void rt_clean_resource(rt_i*, resource*) {}
inline void rt_silent_logoverlap(application*, const partition*, const bu_ptbl*, const partition*) {}
inline void rt_free_rti(rt_i* rtip) { delete rtip; }
