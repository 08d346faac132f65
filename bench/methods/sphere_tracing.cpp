// Sphere tracing with a Lipschitz bound.
//
// Theory: a function that changes by no more than the distance moved keeps its sign within |f| of a point. Union,
// intersection and complement, as min(f, g), max(f, g) and -f, keep that property, so a tree has such a bound when its
// solids have (distance_bounds.hpp). From its start in the scene's sphere the ray goes on by |f|, inside a region as
// well as outside, but never by less than epsilon: there a surface is crossed, and f changes its sign. The end lies
// where the straight line between the last two values is 0.
//
// The sources stop at |f| < epsilon and call that a hit; a sign that changes is the stricter test, and a ray that
// passes within epsilon of a surface does not meet it. Two changes within one step are not seen.
//
// Source: Hart, "Sphere tracing", 1996; Kalra and Barr 1989 for bounds of slopes. Cost: steps, about log(1 / epsilon) a
// surface that is met at an angle, 1 / epsilon where the ray runs along one. Fails on what is thinner than epsilon;
// where rays run along surfaces within epsilon it gives up.
#include <algorithm>
#include <cmath>
#include <limits>

#include "compile/bounds/distance_bounds.hpp"
#include "each_ray.hpp"
#include "list.hpp"
#include "ray_domain.hpp"
#include "ray_forms.hpp"

namespace csgrt::bench {
namespace {

/// More steps than this in one region, and the ray is given up.
constexpr std::uint64_t most_steps = 50'000;

struct Shared : SharedScene {
    DistanceBounds bounds;
    double epsilon;  ///< millimetres
};

class Worker : RegionWorker<Shared> {
public:
    explicit Worker(const Shared& shared) : RegionWorker(shared) {}

    void trace(const Ray& ray, Answer& answer) {
        if (!begin(ray)) return;
        const CompiledScene& scene = shared_.rays.scene();
        ray_ = ray;
        speed_ = std::hypot(ray.direction.x, ray.direction.y, ray.direction.z);
        epsilon_ = shared_.epsilon / speed_;
        domain_ = search_domain(scene, ray);
        within_.clear();
        for (const std::uint32_t solid : solids_) within_.push_back(in_box(scene.solid_boxes[solid], ray, domain_));
        answer_by(answer, 2 * epsilon_, [&](const LiveTrees::Root& root) { return march(root); });
    }
    Counts counts() const { return {{"steps a ray", {all_steps_}}}; }

private:
    /// The bound of the region at t, in units of the ray's parameter.
    double bound(const LiveTrees::Root& root, double t) {
        ++all_steps_;
        const Vec3 &o = ray_.origin, &d = ray_.direction;
        const Vec3 point{o.x + t * d.x, o.y + t * d.y, o.z + t * d.z};
        const auto leaf = [&](std::uint32_t candidate) { return shared_.bounds.at(solids_[candidate], point); };
        return live_.function_of(root, infinity, values_, leaf) / speed_;
    }

    /// False: too many steps.
    bool march(const LiveTrees::Root& root) {
        Domain d{infinity, -infinity};
        for (std::uint32_t i = root.first; i < root.last; ++i) {
            const LiveTrees::Node& node = live_.nodes()[i];
            if (node.gate != Gate::leaf || within_[node.solid].empty()) continue;
            d = {std::min(d.from, within_[node.solid].from), std::max(d.to, within_[node.solid].to)};
        }
        if (root.operand == FULL_SET) d = domain_;
        if (d.empty()) return true;
        // One look from the middle: most rays through a region's boxes pass it at a distance.
        const double half = 0.5 * (d.to - d.from);
        if (bound(root, d.from + half) > half) return true;
        double t = d.from, f = bound(root, t), in = -infinity;
        bool inside = f < 0;
        std::uint64_t steps = 0;
        while (t < d.to && (inside || t < nearest_)) {
            if (++steps > most_steps) return false;
            const double next = std::max(t + std::max(std::abs(f), epsilon_), std::nextafter(t, infinity));
            const double g = bound(root, next);
            if ((g < 0) != inside) {
                const double at = t + (next - t) * (std::abs(f) / (std::abs(f) + std::abs(g)));
                if (inside) {
                    claimed_.push_back({root.region, in, at});
                    if (shared_.first_hits && at > 0 && at - in > 2 * epsilon_) {
                        keep_nearest(in, 2 * epsilon_);
                        return true;
                    }
                }
                in = at;
                inside = !inside;
            }
            t = next;
            f = g;
        }
        if (inside) claimed_.push_back({root.region, in, infinity});
        return true;
    }

    std::vector<Domain> within_;  ///< by candidate: where the ray is in its box
    std::vector<double> values_;  ///< by node
    Ray ray_;
    Domain domain_;
    double speed_ = 1, epsilon_ = 0;
    std::uint64_t all_steps_ = 0;
};

}  // namespace

Method sphere_tracing() {
    Method m;
    m.name = "sphere tracing";
    m.source = "Hart 1996";
    m.about =
        "Goes on along the ray by a lower bound of the distance to the region's surface, at least by epsilon. For "
        "speed: the hierarchy's candidates, subtrees without candidates left out, each region only in its solids' "
        "boxes, a look from the middle of them first, and each solid's own bound.";
    m.breaks =
        "slivers and degenerate: what is thinner than epsilon is stepped over. tangent, pinch: what is met for less "
        "than epsilon, too. far_origin: points of the ray are rounded. It gives up rays along surfaces (coplanar, "
        "coincident, edges).";
    m.knob = "epsilon, diameters of the scene's sphere";
    m.knob_values = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
    m.exact = false;
    m.prepare = [](const Subject& subject, const TraceOptions& options) -> std::unique_ptr<Tracer> {
        const std::string missing = type_without_distance(subject.compiled);
        if (!missing.empty())
            throw Error(Status::usage,
                        "sphere tracing: there is no bound of the distance to a solid of type " + missing);
        return trace_each_ray<Worker>(
            Shared{{subject, options}, DistanceBounds(subject.compiled), knob_length(subject, options)}, options);
    };
    return m;
}

}  // namespace csgrt::bench
