#include "region_meshes.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <system_error>

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "base/clock.hpp"
#include "compile/flatten/flatten.hpp"

namespace csgrt::bench {
namespace {

using Json = nlohmann::ordered_json;
/// What may be spent on one mesh.
constexpr std::size_t most_triangles_of_all = 20'000'000;
constexpr int most_seconds = 500, most_megabytes = 8'000;

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
            refuse_meshes("a scene with solids that are left out because of their places");
        vertices_.open(folder / "solids.vertices", std::ios::binary);
        triangles_.open(folder / "solids.triangles", std::ios::binary);
        Json regions = Json::array();
        for (std::size_t i = 0; i < flat.regions.size(); ++i) {
            const Box& box = subject_.compiled.region_info[i].bounds;
            for (const double x : {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z})
                if (std::isinf(x)) refuse_meshes("region " + subject_.compiled.region_info[i].path + " is not bounded");
            regions.push_back(tree(flat, flat.regions[i].tree));
        }
        std::ofstream(folder / "solids.json")
            << Json{{"seconds", seconds_since(start)},
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
                    refuse_meshes("more than " + std::to_string(most_triangles_of_all) + " triangles");
                refuse_meshes(name + ": " + error.what());
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
    if (status == 124 << 8) refuse_meshes("the Booleans take more than " + std::to_string(most_seconds) + " s");
    std::ifstream in(told);
    std::string line, last = "the Booleans fail without a word, so most likely for memory";
    while (std::getline(in, line))
        if (!line.empty()) last = line;
    refuse_meshes(last);
}

template <class T>
std::vector<T> read_all(const std::filesystem::path& path) {
    std::vector<T> all(std::filesystem::file_size(path) / sizeof(T));
    std::ifstream in(path, std::ios::binary);
    in.read(reinterpret_cast<char*>(all.data()), static_cast<std::streamsize>(all.size() * sizeof(T)));
    if (!in) throw Error(Status::file, path.string() + ": cannot be read");
    return all;
}

}  // namespace

void refuse_meshes(const std::string& why) { throw Error(Status::usage, "meshes: " + why); }

RegionMeshes region_meshes(const Subject& subject, const TraceOptions& options) {
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
    RegionMeshes model;
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

}  // namespace csgrt::bench
