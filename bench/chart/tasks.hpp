// What the methods are tried on: scenes, each with the rays that are judged.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt::bench {

/// Part of a workload: a scene, what is drawn of it, and the rays that are judged.
struct Task {
    Scene scene;
    std::vector<std::string> objects;
    std::vector<Ray> rays;
};
struct ChartWorkload {
    std::string name;
    std::string family;  ///< "models", "scenes", "deep" or "stress"
    std::vector<Task> tasks;
    bool timed() const { return family != "stress"; }
};

/// The rays of a picture of the scene's own view with `side` x `side` pixels, orthographic, as render() shoots them.
std::vector<Ray> view_rays(const Scene& scene, const std::vector<std::string>& objects, int side);

struct Sample {
    std::string models, scenes;           ///< folders
    std::size_t rays = 0;                 ///< judged of each workload, about
    std::vector<std::string> only;        ///< names of workloads; empty: all
    std::vector<std::uint32_t> deep{50};  ///< sizes of the family "deep"
};

/// A workload that is made when its turn comes: all of them together are gigabytes.
struct WorkloadMaker {
    std::string name;
    std::function<ChartWorkload()> make;
};
/// Those whose files are there; of what is missing a line goes to standard error. Throws Error (usage) if `only` has an
/// unknown name.
std::vector<WorkloadMaker> chart_workloads(const Sample& sample);

}  // namespace csgrt::bench
