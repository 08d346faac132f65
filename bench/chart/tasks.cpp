#include "tasks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <csgrt/csgrt.hpp>

#include "bench/workloads.hpp"
#include "compile/frame.hpp"
#include "stress/families.hpp"

namespace csgrt::bench {
namespace {

/// The truth tries every solid on every ray: of a scene with more solids than this the fewer rays are judged.
constexpr std::size_t plenty = 1000;

/// At least `count` rays: a square grid of pixels' centres of the scene's own view, as `render` shoots it.
std::vector<Ray> grid(const Scene& scene, const std::vector<std::string>& objects, std::size_t count) {
    View view;
    view.camera = scene.camera;
    view.camera.perspective = 0;
    const CompiledScene compiled = compile(scene, objects);
    const double solids = static_cast<double>(std::max(compiled.solids.size(), plenty));
    view.width = view.height = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count * plenty) / solids)));
    const PreparedFrame prepared = prepare_frame(compiled, view);
    const kernel::Frame& f = prepared.frame;
    std::vector<Ray> rays;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double across = x + 0.5 - 0.5 * view.width, up = 0.5 * view.height - y - 0.5;
            const auto at = [&](int k) { return f.eye[k] + across * f.u[k] + up * f.v[k]; };
            rays.push_back({{at(0), at(1), at(2)}, {f.w[0], f.w[1], f.w[2]}});
        }
    return rays;
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
    const std::size_t scenes = large ? 4 : std::max(least_scenes, (count + rays_a_scene - 1) / rays_a_scene);
    const std::size_t each = (count + scenes - 1) / scenes;
    for (std::size_t i = 0; i < scenes; ++i) {
        stress::StressScene made = stress::make(family, i * stride);
        Task task{std::move(made.scene), std::move(made.objects), {}};
        const std::size_t taken = std::min(each, made.rays.size());
        for (std::size_t k = 0; k < taken; ++k) task.rays.push_back(made.rays[k * made.rays.size() / taken]);
        workload.tasks.push_back(std::move(task));
    }
    return workload;
}

}  // namespace

std::vector<ChartWorkload> chart_workloads(const Sample& sample) {
    std::vector<ChartWorkload> all;
    const auto wanted = [&](const std::string& name) {
        return sample.only.empty() || std::find(sample.only.begin(), sample.only.end(), name) != sample.only.end();
    };
    const auto add = [&](const std::string& name, const std::string& family, const std::string& path,
                         const std::vector<std::string>& objects) {
        if (!wanted(name)) return;
        if (std::filesystem::exists(path))
            all.push_back(from_file(name, family, path, objects, sample.rays));
        else
            std::fprintf(stderr, "%s: left out, there is no %s\n", name.c_str(), path.c_str());
    };
    for (const Workload& workload : workloads())
        if (!workload.file.empty() && !workload.file.ends_with(".json"))
            add(workload.name, "models", sample.models + "/" + workload.file, workload.objects);
    // Of our own: many solids; tori; surfaces that coincide; a model far from the origin.
    for (const char* name : {"operators", "pipes", "coplanar", "far_origin"})
        add(std::string("scene ") + name, "scenes", sample.scenes + "/" + name + ".json", {});
    for (const std::string& family : stress::families())
        if (wanted(family)) all.push_back(from_family(family, sample.rays));
    return all;
}

}  // namespace csgrt::bench
