#include "tasks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <csgrt/csgrt.hpp>

#include "bench/workloads.hpp"
#include "compile/frame.hpp"
#include "stress/build.hpp"

namespace csgrt::bench {
namespace {

/// At least `count` rays.
std::vector<Ray> grid(const Scene& scene, const std::vector<std::string>& objects, std::size_t count) {
    return view_rays(scene, objects, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
}

ChartWorkload from_file(const std::string& name, const std::string& family, const std::string& path,
                        const std::vector<std::string>& objects, std::size_t count) {
    Task task{load_scene(path), objects, {}};
    task.rays = grid(task.scene, objects, count);
    ChartWorkload workload{name, family, {}};
    workload.tasks.push_back(std::move(task));
    return workload;
}

/// Of each scene at most so many rays, spread over its own; of each family at least so many scenes.
constexpr std::size_t rays_a_scene = 60, least_scenes = 13;
/// From one seed to the next: families go through their cases by the seed's remainders by 2, 3, 13 and others like
/// them.
constexpr std::uint64_t stride = 5;

ChartWorkload from_family(const std::string& family, std::size_t count) {
    ChartWorkload workload{family, "stress", {}};
    const bool large = family == "deep_trees" || family == "depth";  // 10^5 nodes, 10^4 segments: fewer of them
    if (large) count = std::max<std::size_t>(40, count / 100);
    const std::size_t scenes = large ? 4 : std::max(least_scenes, (count + rays_a_scene - 1) / rays_a_scene);
    const std::size_t each = (count + scenes - 1) / scenes, usual = 12;  // of a large one
    for (std::size_t i = 0; i < scenes; ++i) {
        stress::StressScene made = stress::make(family, i * stride, large ? (each + usual - 1) / usual : 1);
        Task task{std::move(made.scene), std::move(made.objects), {}};
        const std::size_t taken = std::min(each, made.rays.size());
        for (std::size_t k = 0; k < taken; ++k) task.rays.push_back(made.rays[k * made.rays.size() / taken]);
        workload.tasks.push_back(std::move(task));
    }
    return workload;
}

// ---- Depth: as many solids, one behind the other or one in the other, under one operator. ----

Tree leaves(const std::vector<std::string>& solids) {
    Tree tree;
    for (const std::string& solid : solids) tree.nodes.push_back({Operator::leaf, 0, solid, identity, {}});
    return tree;
}
Tree joined(Operator op, const std::vector<std::string>& solids) {
    Tree tree = leaves(solids);
    tree.nodes.push_back({op, static_cast<std::uint32_t>(solids.size()), {}, identity, {}});
    return tree;
}
/// The first less (the second less (the third ...)).
Tree alternating(const std::vector<std::string>& solids) {
    Tree tree = leaves(solids);
    for (std::size_t i = 1; i < solids.size(); ++i) tree.nodes.push_back({Operator::difference, 2, {}, identity, {}});
    return tree;
}

constexpr const char* deep_kinds[] = {"xor", "union", "difference", "coincident", "sheets"};

ChartWorkload deep(const std::string& name, const std::string& kind, std::uint32_t size, std::size_t count) {
    stress::Builder to("deep", size, 1);
    std::vector<std::string> solids;
    for (std::uint32_t i = 0; i < size; ++i) {
        const double at = i;
        if (kind == "sheets")  // across x
            solids.push_back(
                to.solid(stress::box({at, -0.25 * size, -0.25 * size}, {at + 0.5, 0.25 * size, 0.25 * size})));
        else if (kind == "coincident")
            solids.push_back(to.solid(stress::ball({0, 0, 0}, 10)));
        else  // balls, the largest first
            solids.push_back(to.solid(stress::ball({0, 0, 0}, 2 + 0.01 * (size - i))));
    }
    to.region(kind == "difference" ? alternating(solids)
                                   : joined(kind == "xor" ? Operator::xor_ : Operator::union_, solids));
    stress::StressScene made = to.take();
    if (kind == "sheets") {  // as many segments on a ray: nearly along x
        made.scene.camera.azimuth = 1;
        made.scene.camera.elevation = 1;
    }
    Task task{std::move(made.scene), std::move(made.objects), {}};
    task.rays =
        grid(task.scene, task.objects, std::max<std::size_t>(16, std::min<std::size_t>(count, 2'000'000 / size)));
    ChartWorkload workload{name, "deep", {}};
    workload.tasks.push_back(std::move(task));
    return workload;
}

}  // namespace

std::vector<Ray> view_rays(const Scene& scene, const std::vector<std::string>& objects, int side) {
    View view;
    view.camera = scene.camera;
    view.camera.perspective = 0;
    view.width = view.height = side;
    const CompiledScene compiled = compile(scene, objects);
    const PreparedFrame prepared = prepare_frame(compiled, view);
    const kernel::Frame& f = prepared.frame;
    std::vector<Ray> rays;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double across = x + 0.5 - 0.5 * side, up = 0.5 * side - y - 0.5;
            const auto at = [&](int k) { return f.eye[k] + across * f.u[k] + up * f.v[k]; };
            rays.push_back({{at(0), at(1), at(2)}, {f.w[0], f.w[1], f.w[2]}});
        }
    return rays;
}

std::vector<WorkloadMaker> chart_workloads(const Sample& sample) {
    std::vector<WorkloadMaker> all;
    std::vector<std::string> unknown = sample.only;
    const auto add = [&](const std::string& name, std::function<ChartWorkload()> make, const std::string& path = {}) {
        std::erase(unknown, name);
        if (!sample.only.empty() && std::find(sample.only.begin(), sample.only.end(), name) == sample.only.end())
            return;
        if (path.empty() || std::filesystem::exists(path))
            all.push_back({name, std::move(make)});
        else
            std::fprintf(stderr, "%s: left out, there is no %s\n", name.c_str(), path.c_str());
    };
    const std::size_t rays = sample.rays;
    const auto add_file = [&](const std::string& name, const std::string& family, const std::string& path,
                              const std::vector<std::string>& objects) {
        add(
            name, [=] { return from_file(name, family, path, objects, rays); }, path);
    };
    for (const Workload& workload : workloads())
        if (!workload.file.empty() && !workload.file.ends_with(".json"))
            add_file(workload.name, "models", sample.models + "/" + workload.file, workload.objects);
    // Of our own: many solids; tori; surfaces that coincide; a model far from the origin.
    for (const char* name : {"operators", "pipes", "coplanar", "far_origin"})
        add_file(std::string("scene ") + name, "scenes", sample.scenes + "/" + name + ".json", {});
    for (const std::uint32_t size : sample.deep)
        for (const std::string kind : deep_kinds) {
            const std::string name = "deep " + kind + " " + std::to_string(size);
            add(name, [=] { return deep(name, kind, size, rays); });
        }
    for (const std::string& family : stress::families()) add(family, [=] { return from_family(family, rays); });
    if (!unknown.empty())
        throw Error(Status::usage, "--workloads: there is no " + unknown.front() + " (bench/chart/tasks.cpp)");
    return all;
}

}  // namespace csgrt::bench
