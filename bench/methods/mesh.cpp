// Tessellation, which most programs ship: solids -> meshes, Booleans of meshes by Manifold, rays by Embree.
//
//     facets.cpp          solids.*          booleans.py        regions.*         Embree
//     solids and trees ---------------> Manifold, in double -------------> one geometry a region, in float
//
#include "list.hpp"

#include <algorithm>
#include <limits>

#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "region_meshes.hpp"
#include "scene/vector.hpp"

#ifdef CSGRT_EMBREE
#include <embree3/rtcore.h>
#endif

namespace csgrt::bench {
#ifdef CSGRT_EMBREE
namespace {

struct Hit {
    float t;
    std::uint32_t region;
    bool enters;
};
/// Embree tells of every hit, and is told to go on.
struct Gatherer : RTCIntersectContext {
    std::vector<Hit> hits;
};
void gather(const RTCFilterFunctionNArguments* told) {
    const auto* ray = reinterpret_cast<const RTCRay*>(told->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(told->hit);
    const float along = hit->Ng_x * ray->dir_x + hit->Ng_y * ray->dir_y + hit->Ng_z * ray->dir_z;
    static_cast<Gatherer*>(told->context)->hits.push_back({ray->tfar, hit->geomID, along < 0});
    told->valid[0] = 0;
}

class MeshTracer : public Tracer {
public:
    MeshTracer(const Subject& subject, const TraceOptions& options)
        : center_(subject.compiled.center), radius_(subject.compiled.radius), options_(options) {
        rounding_ = static_cast<float>(0x1p-21 * radius_);
        const RegionMeshes model = region_meshes(subject, options);
        device_ = rtcNewDevice(("threads=" + std::to_string(thread_count(options.threads))).c_str());
        if (!device_) refuse_meshes("Embree does not start");
        rtcSetDeviceMemoryMonitorFunction(device_, count_memory, this);
        const Clock::time_point start = Clock::now();
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        for (std::uint32_t region = 0; region < model.regions.size(); ++region) add(region, model.regions[region]);
        rtcCommitScene(scene_);
        if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) {
            release();
            refuse_meshes("Embree cannot build its scene");
        }
        figures_ = {{"meshing s", model.seconds},
                    {"meshing CPU s", model.cpu_seconds},
                    {"meshing MB", model.megabytes},
                    {"triangles", static_cast<double>(model.triangles)},
                    {"mesh MB", static_cast<double>(memory_) / 1e6},
                    {"BVH s", seconds_since(start)}};
    }
    ~MeshTracer() override { release(); }
    MeshTracer(const MeshTracer&) = delete;
    MeshTracer& operator=(const MeshTracer&) = delete;

    std::vector<Answer> trace(const std::vector<Ray>& rays) override {
        const std::size_t chunk = 1024;
        std::vector<std::vector<Stretch>> found((rays.size() + chunk - 1) / chunk);
        std::vector<std::uint32_t> counts(rays.size());
        const Clock::time_point start = Clock::now();
        for_chunks(rays.size(), chunk, options_.threads, [&](std::size_t first, std::size_t last, std::size_t number) {
            Gatherer context;
            for (std::size_t i = first; i < last; i += lanes) {
                const std::size_t count = std::min(lanes, last - i);
                if (options_.first_hits && first_hits(&rays[i], count, context, &counts[i], found[number])) continue;
                for (std::size_t k = i; k < i + count; ++k) {
                    counts[k] = every_partition(rays[k], context, found[number]);
                    if (options_.first_hits) keep_first(counts[k], found[number]);
                }
            }
        });
        seconds_ = seconds_since(start);
        std::vector<Answer> answers(rays.size());
        for (std::size_t i = 0, at = 0; i < rays.size(); ++i) {
            if (i % chunk == 0) at = 0;
            const auto from = found[i / chunk].begin() + static_cast<std::ptrdiff_t>(at);
            answers[i].stretches.assign(from, from + counts[i]);
            at += counts[i];
        }
        return answers;
    }
    double seconds() const override { return seconds_; }
    std::map<std::string, double> figures() const override { return figures_; }

private:
    static constexpr std::size_t lanes = 8;

    static bool count_memory(void* self, ssize_t bytes, bool) {
        static_cast<MeshTracer*>(self)->memory_ += bytes;
        return true;
    }
    void release() {
        if (scene_) rtcReleaseScene(scene_);
        if (device_) rtcReleaseDevice(device_);
    }

    void add(std::uint32_t region, const Triangles& mesh) {
        if (mesh.faces.empty()) return;
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
        auto* faces = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.faces.size()));
        if (!vertices || !faces) refuse_meshes("Embree has not enough memory");
        for (const Vec3& v : mesh.vertices) {  // about the middle, where float is finest
            *vertices++ = static_cast<float>(v.x - center_.x);
            *vertices++ = static_cast<float>(v.y - center_.y);
            *vertices++ = static_cast<float>(v.z - center_.z);
        }
        for (const auto& face : mesh.faces) faces = std::copy(face.begin(), face.end(), faces);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene_, geometry, region);
        rtcReleaseGeometry(geometry);
    }

    /// A ray of float that starts before the scene, and where on the true ray that is.
    struct Start {
        double t;
        Vec3 origin, direction;
    };
    Start start_of(const Ray& ray) const {
        const double size = length(ray.direction);
        const Vec3 direction = (1 / size) * ray.direction, from = ray.origin - center_;
        const double t = -dot(from, direction) - 1.1 * radius_;
        return {t / size, from + t * direction, direction};
    }

    /// The nearest hits of rays that start before the scene; false if one does not.
    bool first_hits(const Ray* rays, std::size_t count, Gatherer& context, std::uint32_t* counts,
                    std::vector<Stretch>& found) const {
        alignas(32) int valid[lanes] = {};
        RTCRayHit8 packet;
        Start starts[lanes];
        for (std::size_t k = 0; k < count; ++k) {
            const Start& s = starts[k] = start_of(rays[k]);
            if (s.t < 0) return false;
            valid[k] = -1;
            packet.ray.org_x[k] = static_cast<float>(s.origin.x);
            packet.ray.org_y[k] = static_cast<float>(s.origin.y);
            packet.ray.org_z[k] = static_cast<float>(s.origin.z);
            packet.ray.dir_x[k] = static_cast<float>(s.direction.x);
            packet.ray.dir_y[k] = static_cast<float>(s.direction.y);
            packet.ray.dir_z[k] = static_cast<float>(s.direction.z);
            packet.ray.tnear[k] = packet.ray.time[k] = 0;
            packet.ray.tfar[k] = std::numeric_limits<float>::infinity();
            packet.ray.mask[k] = 0xffffffff;
            packet.ray.flags[k] = 0;
            packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
        }
        RTCIntersectContext coherent;
        rtcInitIntersectContext(&coherent);
        coherent.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect8(valid, scene_, &coherent, &packet);
        for (std::size_t k = 0; k < count; ++k) {
            counts[k] = packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
            if (!counts[k]) continue;
            const float along = packet.hit.Ng_x[k] * packet.ray.dir_x[k] + packet.hit.Ng_y[k] * packet.ray.dir_y[k] +
                                packet.hit.Ng_z[k] * packet.ray.dir_z[k];
            if (along >= 0) {  // it leaves what it did not enter: it touches an edge, or runs in a face
                counts[k] = every_partition(rays[k], context, found);
                keep_first(counts[k], found);
                continue;
            }
            const double t = starts[k].t + static_cast<double>(packet.ray.tfar[k]) / length(rays[k].direction);
            found.push_back({packet.hit.geomID[k], t, std::numeric_limits<double>::infinity()});
        }
        return true;
    }

    /// Of the last `count` stretches the first that does not end behind the ray's start.
    static void keep_first(std::uint32_t& count, std::vector<Stretch>& found) {
        const auto begin = found.end() - count;
        const auto first = std::find_if(begin, found.end(), [](const Stretch& s) { return s.out > 0; });
        count = first != found.end();
        if (count) *begin = {first->region, first->in, std::numeric_limits<double>::infinity()};
        found.erase(begin + count, found.end());
    }

    /// All hits in order; a region holds the ray from where it enters its mesh to where it leaves it. Hits that float
    /// cannot tell apart are one, so that regions which touch have no gap between them. On a common edge of two
    /// triangles there are two hits of one kind.
    std::uint32_t every_partition(const Ray& ray, Gatherer& context, std::vector<Stretch>& found) const {
        const Start s = start_of(ray);
        RTCRayHit hit;
        hit.ray = {static_cast<float>(s.origin.x),
                   static_cast<float>(s.origin.y),
                   static_cast<float>(s.origin.z),
                   0,
                   static_cast<float>(s.direction.x),
                   static_cast<float>(s.direction.y),
                   static_cast<float>(s.direction.z),
                   0,
                   std::numeric_limits<float>::infinity(),
                   0xffffffff,
                   0,
                   0};
        hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcInitIntersectContext(&context);
        context.filter = gather;
        context.hits.clear();
        rtcIntersect1(scene_, &context, &hit);
        std::sort(context.hits.begin(), context.hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
        const std::size_t before = found.size();
        const double size = length(ray.direction);
        std::vector<std::uint32_t> inside;  // ascending
        double from = 0;
        for (auto h = context.hits.begin(); h != context.hits.end();) {
            const double t = s.t + static_cast<double>(h->t) / size;
            const std::uint32_t owner = inside.empty() ? Stretch::gap : inside.front();
            for (const float one = h->t + rounding_; h != context.hits.end() && h->t <= one; ++h) {
                const auto at = std::lower_bound(inside.begin(), inside.end(), h->region);
                const bool is_inside = at != inside.end() && *at == h->region;
                if (h->enters && !is_inside) inside.insert(at, h->region);
                if (!h->enters && is_inside) inside.erase(at);
            }
            if (owner == (inside.empty() ? Stretch::gap : inside.front())) continue;
            if (owner != Stretch::gap) found.push_back({owner, from, t});
            from = t;
        }
        return static_cast<std::uint32_t>(found.size() - before);
    }

    Vec3 center_;
    double radius_;
    float rounding_;  ///< of distances from where rays start, some units in the last place
    TraceOptions options_;
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    ssize_t memory_ = 0;
    double seconds_ = 0;
    std::map<std::string, double> figures_;
};

}  // namespace
#endif

Method meshes() {
    Method m;
    m.name = "Meshes";
    m.source = "Manifold (Lalish 2022), Embree (Wald 2014)";
    m.about =
        "Solids become triangles, their Booleans are done by Manifold in double, one mesh a region, and Embree traces "
        "the meshes in float. Steps along curves are as long as the chord error allows. Embree builds its best "
        "hierarchy; first hits are traced in packets of eight neighbours, and every partition takes one traversal.";
    m.breaks =
        "coincident: surfaces that are one, but given in several ways, become different triangles, between which skins "
        "appear; slivers: what is thinner than the chord error goes or swells; scale: a model is smaller than the "
        "error, or needs more triangles than there is memory";
    m.knob = "chord error, mm";
    m.knob_values = {1, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001};
    m.exact = false;
    m.prepare = [](const Subject& subject, const TraceOptions& options) -> std::unique_ptr<Tracer> {
#ifdef CSGRT_EMBREE
        return std::make_unique<MeshTracer>(subject, options);
#else
        static_cast<void>(subject);
        static_cast<void>(options);
        refuse_meshes("built without Embree (Debian: libembree-dev)");
#endif
    };
    return m;
}

}  // namespace csgrt::bench
