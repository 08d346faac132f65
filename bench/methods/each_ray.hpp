// Parts of the methods that run on processors: the loop over rays with a worker for each thread, and the candidates and
// surfaces of a ray, for workers that search or sort along the ray.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "method.hpp"
#include "region_trees.hpp"
#include "scene_rays.hpp"
#include "stretches.hpp"

namespace csgrt::bench {

inline constexpr std::size_t rays_of_a_tile = 64;

/// A figure that a worker counts: the quotient of both, or where `of` is 0 the mean of all rays.
struct Count {
    std::uint64_t count = 0, of = 0;
};
using Counts = std::map<std::string, Count>;

/// Worker: made from `const Shared&`, with memory of its own. Either void trace(const Ray&, Answer&), or void
/// trace_tile(std::span<const Ray>, Answer*) for as many as rays_of_a_tile neighbours. `Counts counts() const` is
/// summed over the workers of a trace.
template <class Shared, class Worker>
class EachRay final : public Tracer {
public:
    EachRay(std::unique_ptr<const Shared> shared, unsigned threads) : shared_(std::move(shared)), threads_(threads) {}

    std::vector<Answer> trace(const std::vector<Ray>& rays) override {
        std::vector<Answer> answers(rays.size());
        std::vector<std::unique_ptr<Worker>> idle;
        std::mutex mutex;
        const Clock::time_point start = Clock::now();
        for_chunks(rays.size(), rays_of_a_tile, threads_, [&](std::size_t first, std::size_t last, std::size_t) {
            std::unique_ptr<Worker> worker;
            {
                const std::lock_guard lock(mutex);
                if (!idle.empty()) {
                    worker = std::move(idle.back());
                    idle.pop_back();
                }
            }
            if (!worker) worker = std::make_unique<Worker>(*shared_);
            if constexpr (requires { &Worker::trace_tile; })
                worker->trace_tile(std::span(rays).subspan(first, last - first), answers.data() + first);
            else
                for (std::size_t i = first; i < last; ++i) worker->trace(rays[i], answers[i]);
            const std::lock_guard lock(mutex);
            idle.push_back(std::move(worker));
        });
        seconds_ = seconds_since(start);
        Counts sums;
        for (const auto& worker : idle)
            for (const auto& [name, count] : worker->counts()) {
                sums[name].count += count.count;
                sums[name].of += count.of;
            }
        figures_.clear();
        for (const auto& [name, sum] : sums)
            figures_[name] = static_cast<double>(sum.count) / static_cast<double>(sum.of ? sum.of : rays.size());
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

/// The scene that the threads of a method share; each method adds its own members.
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

/// A ray among the regions: its candidates, the trees that are alive for them, and what the regions claim of it.
template <class Shared>
class RegionWorker {
protected:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    explicit RegionWorker(const Shared& shared) : shared_(shared), live_(shared.trees) {}

    /// False: no region is alive, and the ray meets nothing.
    bool begin(const Ray& ray) {
        shared_.rays.candidates(ray, -infinity, solids_);
        live_.build(solids_);
        nearest_ = infinity;
        claimed_.clear();
        return !live_.roots().empty();
    }
    /// walk(root) claims what the region has of the ray; false gives the ray up.
    template <class Walk>
    void answer_by(Answer& answer, double epsilon, const Walk& walk) {
        for (const LiveTrees::Root& root : live_.roots()) answer.answered = answer.answered && walk(root);
        if (answer.answered) answer.stretches = owners(claimed_, epsilon, shared_.first_hits);
    }
    /// Notes, for first hits, a stretch that ends behind the ray's start: what begins behind `in` + `slack` does not
    /// matter.
    void keep_nearest(double in, double slack) { nearest_ = std::min(nearest_, in + slack); }

    /// Where the ray meets each candidate's surfaces, by kept(distance): in, out, in, ...; ascending.
    template <class T, class Kept>
    void intersect(const Ray& ray, std::vector<T>& surfaces, const Kept& kept) {
        surfaces.clear();
        begin_.assign(1, 0);
        for (const std::uint32_t solid : solids_) {
            boundaries_.clear();
            shared_.rays.append_boundaries(solid, ray, -infinity, boundaries_);
            for (const kernel::Boundary& boundary : boundaries_) surfaces.push_back(kept(boundary.t));
            begin_.push_back(surfaces.size());
        }
    }
    /// The surfaces of one candidate.
    template <class T>
    std::span<const T> surfaces_of(std::uint32_t candidate, const std::vector<T>& surfaces) const {
        return std::span(surfaces).subspan(begin_[candidate], begin_[candidate + 1] - begin_[candidate]);
    }

    const Shared& shared_;
    LiveTrees live_;
    std::vector<std::uint32_t> solids_;  ///< the candidates
    std::vector<Stretch> claimed_;
    double nearest_ = infinity;  ///< first hits: what begins behind it does not matter

private:
    std::vector<kernel::Boundary> boundaries_;
    std::vector<std::size_t> begin_;  ///< of each candidate's surfaces
};

}  // namespace csgrt::bench
