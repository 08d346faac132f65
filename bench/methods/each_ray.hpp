// The loop over rays of the methods that run on the processors: rays in pieces of 64, a worker for each thread.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "method.hpp"
#include "region_trees.hpp"
#include "scene_rays.hpp"

namespace csgrt::bench {

/// What these methods share among threads; each adds its own.
struct SharedScene {
    SharedScene(const Subject& subject, const TraceOptions& options)
        : rays(subject.compiled), trees(subject.compiled, options.planted), first_hits(options.first_hits) {}

    SceneRays rays;
    RegionTrees trees;
    bool first_hits;
};

/// A knob in diameters of the scene's sphere, in millimetres; in a scene without one it is millimetres itself.
inline double knob_length(const Subject& subject, const TraceOptions& options) {
    const double radius = subject.compiled.radius;
    return options.knob * (radius > 0 ? 2 * radius : 1);
}

/// Worker: made from `const Shared&`; void trace(const Ray&, Answer&) has its own memory; counts() are summed over the
/// workers of a trace and given as means of all rays.
template <class Shared, class Worker>
class EachRay final : public Tracer {
public:
    EachRay(std::unique_ptr<const Shared> shared, unsigned threads) : shared_(std::move(shared)), threads_(threads) {}

    std::vector<Answer> trace(const std::vector<Ray>& rays) override {
        std::vector<Answer> answers(rays.size());
        std::vector<std::unique_ptr<Worker>> idle;
        std::mutex mutex;
        const Clock::time_point start = Clock::now();
        for_chunks(rays.size(), 64, threads_, [&](std::size_t first, std::size_t last, std::size_t) {
            std::unique_ptr<Worker> worker;
            {
                const std::lock_guard lock(mutex);
                if (!idle.empty()) {
                    worker = std::move(idle.back());
                    idle.pop_back();
                }
            }
            if (!worker) worker = std::make_unique<Worker>(*shared_);
            for (std::size_t i = first; i < last; ++i) worker->trace(rays[i], answers[i]);
            const std::lock_guard lock(mutex);
            idle.push_back(std::move(worker));
        });
        seconds_ = seconds_since(start);
        figures_.clear();
        for (const auto& worker : idle)
            for (const auto& [name, count] : worker->counts())
                figures_[name] += static_cast<double>(count) / static_cast<double>(rays.size());
        return answers;
    }
    double seconds() const override { return seconds_; }
    std::map<std::string, double> figures() const override { return figures_; }

private:
    std::unique_ptr<const Shared> shared_;
    unsigned threads_;
    double seconds_ = 0;
    std::map<std::string, double> figures_;
};

template <class Worker, class Shared>
std::unique_ptr<Tracer> trace_each_ray(Shared shared, const TraceOptions& options) {
    return std::make_unique<EachRay<Shared, Worker>>(std::make_unique<const Shared>(std::move(shared)),
                                                     options.threads);
}

}  // namespace csgrt::bench
