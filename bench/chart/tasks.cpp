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

/// At least `count` rays: a square grid of pixels' centres of the scene's own view, as `render` shoots it.
std::vector<Ray> grid(const Scene& scene, const std::vector<std::string>& objects, std::size_t count) {
    View view;
    view.camera = scene.camera;
    view.camera.perspective = 0;
    view.width = view.height = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
    const PreparedFrame prepared = prepare_frame(compile(scene, objects), view);
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

/// Scenes of the family from its first seed on until there are enough rays.
ChartWorkload from_family(const std::string& family, std::size_t count) {
    ChartWorkload workload{family, "stress", {}};
    std::size_t rays = 0;
    for (std::uint64_t seed = 0; rays < count; ++seed) {
        stress::StressScene made = stress::make(family, seed);
        rays += made.rays.size();
        workload.tasks.push_back({std::move(made.scene), std::move(made.objects), std::move(made.rays)});
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
        if (!workload.file.ends_with(".json"))
            add(workload.name, "models", sample.models + "/" + workload.file, workload.objects);
    // Of our own: many solids; tori; surfaces that coincide; a model far from the origin.
    for (const char* name : {"operators", "pipes", "coplanar", "far_origin"})
        add(std::string("scene ") + name, "scenes", sample.scenes + "/" + name + ".json", {});
    for (const std::string& family : stress::families())
        if (wanted(family)) all.push_back(from_family(family, sample.rays));
    return all;
}

}  // namespace csgrt::bench
