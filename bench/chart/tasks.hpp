// What the variants are tried on: scenes, each with the rays that are judged.
#pragma once

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
    std::string family;  ///< "models", "scenes" or "stress"
    std::vector<Task> tasks;
    bool timed() const { return family != "stress"; }
};

struct Sample {
    std::string models, scenes;     ///< folders
    std::size_t rays = 0;           ///< judged of each workload, about
    std::vector<std::string> only;  ///< names of workloads; empty: all
};

/// Those whose files are there; of what is missing a line goes to standard error.
std::vector<ChartWorkload> chart_workloads(const Sample& sample);

}  // namespace csgrt::bench
