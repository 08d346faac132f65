// Tessellation, which most programs ship: solids -> meshes, Booleans of meshes by Manifold, rays by Embree.
//
//     facets.cpp          solids.*          booleans.py        regions.*         Embree
//     solids and trees ---------------> Manifold, in double -------------> one geometry a region, in float
//
// Meshes are kept in a folder, by the scene and the chord error: CSGRT_MESHES, else one beside other temporary files.
// CSGRT_PYTHON is the Python that has manifold3d.
#include "list.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <system_error>

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "base/parallel.hpp"
#include "compile/flatten/flatten.hpp"
#include "facets.hpp"
#include "scene/vector.hpp"

#ifdef CSGRT_EMBREE
#include <embree3/rtcore.h>
#endif

namespace csgrt::bench {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

/// What may be spent on one mesh.
constexpr std::size_t most_triangles_of_all = 20'000'000;
constexpr int most_seconds = 500, most_megabytes = 8'000;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

[[noreturn]] void refuse(const std::string& why) { throw Error(Status::usage, "meshes: " + why); }

/// Regions as meshes, and what they took.
struct Model {
    std::vector<Triangles> regions;
    double seconds = 0, cpu_seconds = 0;  ///< to make them: by the clock, of processors
    double megabytes = 0;                 ///< the most at a time
    std::size_t triangles = 0;
};

// ---- Solids to meshes ----

const char* name_of(Operator op) {
    return op == Operator::union_         ? "union"
           : op == Operator::intersection ? "intersection"
           : op == Operator::difference   ? "difference"
                                          : "xor";
}

/// The solids' meshes and the regions' trees, as booleans.py reads them.
class ModelWriter {
public:
    ModelWriter(const Subject& subject, const TraceOptions& options) : subject_(subject), options_(options) {
        const Vec3& c = subject.compiled.center;
        const double reach = 1.25 * subject.compiled.radius;
        facet_.chord = options.knob;
        facet_.around = {{c.x - reach, c.y - reach, c.z - reach}, {c.x + reach, c.y + reach, c.z + reach}};
    }

    void write(const std::filesystem::path& folder) {
        const Clock::time_point start = Clock::now();
        const std::clock_t start_cpu = std::clock();
        const FlatScene flat =
            flatten(subject_.scene, subject_.objects.empty() ? top_objects(subject_.scene) : subject_.objects, false);
        if (flat.regions.size() != subject_.compiled.regions.size())
            refuse("a scene with solids that are left out because of their places");
        vertices_.open(folder / "solids.vertices", std::ios::binary);
        triangles_.open(folder / "solids.triangles", std::ios::binary);
        Json regions = Json::array();
        for (std::size_t i = 0; i < flat.regions.size(); ++i) {
            const Box& box = subject_.compiled.region_info[i].bounds;
            for (const double x : {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z})
                if (std::isinf(x)) refuse("region " + subject_.compiled.region_info[i].path + " is not bounded");
            regions.push_back(tree(flat, flat.regions[i].tree));
        }
        std::ofstream(folder / "solids.json")
            << Json{{"seconds", since(start)},
                    {"cpu_seconds", static_cast<double>(std::clock() - start_cpu) / CLOCKS_PER_SEC},
                    {"solids", solids_},
                    {"regions", regions}};
        if (!vertices_.flush() || !triangles_.flush())
            throw Error(Status::file, folder.string() + ": cannot be written");
    }

private:
    Json tree(const FlatScene& flat, const FlatTree& tree) {
        Json nodes = Json::array();
        for (const FlatTree::Node& node : tree.nodes) {
            if (node.op == Operator::leaf) {
                leaf(flat, node.solid, nodes);
            } else if (node.op == Operator::not_) {
                // Of the box that holds everything, the operand's outside.
                if (!box_) box_ = add("the box around the scene", box_facets(facet_.around));
                nodes.push_back(*box_);
                nodes.push_back({"xor", 2});
            } else if (node.arity > 1) {
                const bool is_planted = options_.planted && node.op == Operator::difference;
                nodes.push_back({name_of(is_planted ? Operator::union_ : node.op), node.arity});
            }
        }
        return nodes;
    }

    void leaf(const FlatScene& flat, std::uint32_t number, Json& nodes) {
        std::vector<std::size_t>& parts = of_instance_[number];
        if (parts.empty()) {
            const Instance& instance = flat.instances[number];
            const std::string& name = csgrt::name_of(subject_.scene.objects[instance.object]);
            try {
                parts.push_back(add(name, facets(shape_of(subject_.scene, flat, instance), *instance.matrix, facet_)));
                for (const Plane& plane : cuts_of(flat, instance))
                    parts.push_back(add(name, facets(Half{plane}, *instance.matrix, facet_)));
            } catch (const Error& error) {
                if (error.status() == Status::out_of_memory)
                    refuse("more than " + std::to_string(most_triangles_of_all) + " triangles");
                refuse(name + ": " + error.what());
            }
        }
        for (const std::size_t part : parts) nodes.push_back(part);
        if (parts.size() > 1) nodes.push_back({"intersection", parts.size()});
    }

    std::size_t add(const std::string& name, const Triangles& mesh) {
        facet_.most -= mesh.faces.size();
        vertices_.write(reinterpret_cast<const char*>(mesh.vertices.data()),
                        static_cast<std::streamsize>(mesh.vertices.size() * sizeof(Vec3)));
        triangles_.write(reinterpret_cast<const char*>(mesh.faces.data()),
                         static_cast<std::streamsize>(mesh.faces.size() * sizeof(mesh.faces[0])));
        solids_.push_back({{"name", name}, {"vertices", mesh.vertices.size()}, {"triangles", mesh.faces.size()}});
        return solids_.size() - 1;
    }

    const Subject& subject_;
    const TraceOptions& options_;
    FacetOptions facet_{0, {}, most_triangles_of_all};
    std::ofstream vertices_, triangles_;
    Json solids_ = Json::array();
    std::optional<std::size_t> box_;
    std::map<std::uint32_t, std::vector<std::size_t>> of_instance_;
};

// ---- Booleans ----

std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
    return text + "'";
}
std::string environment(const char* name, const std::string& otherwise) {
    const char* value = std::getenv(name);
    return value && *value ? value : otherwise;
}

void make_regions(const std::filesystem::path& folder) {
    const std::string told = (folder / "errors").string();
    const std::string command = "timeout " + std::to_string(most_seconds) + " " +
                                quoted(environment("CSGRT_PYTHON", "python3")) + " " + quoted(CSGRT_BOOLEANS) + " " +
                                quoted(folder.string()) + " " + std::to_string(most_megabytes) + " 2>" + quoted(told);
    const int status = std::system(command.c_str());
    if (status == 0) return;
    if (status == 124 << 8) refuse("the Booleans take more than " + std::to_string(most_seconds) + " s");
    std::ifstream in(told);
    std::string line, last = "the Booleans fail without a word, so most likely for memory";
    while (std::getline(in, line))
        if (!line.empty()) last = line;
    refuse(last);
}

template <class T>
std::vector<T> read_all(const std::filesystem::path& path) {
    std::vector<T> all(std::filesystem::file_size(path) / sizeof(T));
    std::ifstream in(path, std::ios::binary);
    in.read(reinterpret_cast<char*>(all.data()), static_cast<std::streamsize>(all.size() * sizeof(T)));
    if (!in) throw Error(Status::file, path.string() + ": cannot be read");
    return all;
}

/// From the folder, or made.
Model model_of(const Subject& subject, const TraceOptions& options) {
    namespace fs = std::filesystem;
    char name[80];
    std::snprintf(name, sizeof name, "%016llx-%g%s", static_cast<unsigned long long>(subject.compiled.hash),
                  options.knob, options.planted ? "-planted" : "");
    const fs::path folder =
        fs::path(environment("CSGRT_MESHES", (fs::temp_directory_path() / "csgrt_meshes").string())) / name;
    if (!fs::exists(folder)) {
        const fs::path unfinished = folder.string() + "." + std::to_string(getpid());
        try {
            fs::create_directories(unfinished);
            ModelWriter(subject, options).write(unfinished);
            make_regions(unfinished);
        } catch (...) {
            fs::remove_all(unfinished);
            throw;
        }
        std::error_code is_there;  // made by another process meanwhile
        fs::rename(unfinished, folder, is_there);
        if (is_there) fs::remove_all(unfinished);
    }
    const Json solids = Json::parse(std::ifstream(folder / "solids.json"));
    const Json regions = Json::parse(std::ifstream(folder / "regions.json"));
    const auto vertices = read_all<Vec3>(folder / "regions.vertices");
    const auto faces = read_all<std::array<std::uint32_t, 3>>(folder / "regions.triangles");
    Model model;
    model.seconds = solids["seconds"].get<double>() + regions["seconds"].get<double>();
    model.cpu_seconds = solids["cpu_seconds"].get<double>() + regions["cpu_seconds"].get<double>();
    model.megabytes = regions["peak_mb"];
    model.triangles = faces.size();
    auto vertex = vertices.begin();
    auto face = faces.begin();
    for (const Json& region : regions["regions"]) {
        const std::ptrdiff_t corners = region["vertices"], triangles = region["triangles"];
        model.regions.push_back({{vertex, vertex + corners}, {face, face + triangles}});
        vertex += corners;
        face += triangles;
    }
    return model;
}

// ---- Rays ----

#ifdef CSGRT_EMBREE

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
        const Model model = model_of(subject, options);
        device_ = rtcNewDevice(("threads=" + std::to_string(thread_count(options.threads))).c_str());
        if (!device_) refuse("Embree does not start");
        rtcSetDeviceMemoryMonitorFunction(device_, count_memory, this);
        const Clock::time_point start = Clock::now();
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        for (std::uint32_t region = 0; region < model.regions.size(); ++region) add(region, model.regions[region]);
        rtcCommitScene(scene_);
        if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) {
            release();
            refuse("Embree cannot build its scene");
        }
        figures_ = {{"meshing s", model.seconds},
                    {"meshing CPU s", model.cpu_seconds},
                    {"meshing MB", model.megabytes},
                    {"triangles", static_cast<double>(model.triangles)},
                    {"mesh MB", static_cast<double>(memory_) / 1e6},
                    {"BVH s", since(start)}};
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
                if (options_.first_hits && first_hits(&rays[i], count, &counts[i], found[number])) continue;
                for (std::size_t k = i; k < i + count; ++k) {
                    counts[k] = every_partition(rays[k], context, found[number]);
                    if (options_.first_hits) keep_first(counts[k], found[number]);
                }
            }
        });
        seconds_ = since(start);
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
        if (!vertices || !faces) refuse("Embree has not enough memory");
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
    bool first_hits(const Ray* rays, std::size_t count, std::uint32_t* counts, std::vector<Stretch>& found) const {
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
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect8(valid, scene_, &context, &packet);
        for (std::size_t k = 0; k < count; ++k) {
            counts[k] = packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
            if (!counts[k]) continue;
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

#endif

}  // namespace

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
        static_cast<void>(model_of);
        refuse("built without Embree (Debian: libembree-dev)");
#endif
    };
    return m;
}

}  // namespace csgrt::bench
