// Kensler's state machine.
//
// Theory: of each operand only the next surface behind t_min is asked for, and whether the ray enters there, leaves
// there, or meets nothing. The two states and the order of the two surfaces say all about the node: one of the
// surfaces is its own, or one of them lies where the other operand hides it; then that operand is asked again behind
// it.
//
//     union            B enter            B exit               B miss
//     A enter          nearer             A nearer: pass A     A
//                                         else B
//     A exit           B nearer: pass B   pass the nearer      A
//                      else A
//     A miss           B                  B                    miss
//
//     intersection     B enter            B exit               B miss
//     A enter          pass the nearer    A nearer: A          miss
//                                         else pass B
//     A exit           B nearer: B        nearer               miss
//                      else pass A
//     A miss           miss               miss                 miss
//
// A - B is A and not B: of a complement's surfaces enter and exit change places, and a miss is an exit at infinity.
// Xor: the nearer one, flipped where the ray is in the other.
//
// "Behind" is t + epsilon: the surface just met must not be found again. What is thinner is not seen. In the source the
// farther of two exits is the union's; for operands with holes the nearer one has to be passed, as here.
//
// Source: A. Kensler, "Ray tracing CSG objects using single hit intersections", 2006, with the corrections of XRT's
// author; so in Ulyanov et al. 2017 and in Opticks. Cost: no lists a node; each surface passed asks a subtree again.
// Fails where surfaces lie closer than epsilon, and where epsilon is below the rounding of t.
#include "kensler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "each_ray.hpp"
#include "list.hpp"

namespace csgrt::bench {
namespace kensler_table {

Action action(Gate gate, Next a, double a_at, Next b, double b_at) {
    if (gate == Gate::xor_) {
        if (a == Next::miss && b == Next::miss) return Action::miss;
        if (a_at <= b_at) return b == Next::exit ? Action::take_a_flipped : Action::take_a;
        return a == Next::exit ? Action::take_b_flipped : Action::take_b;
    }
    if (gate == Gate::union_) {
        if (a == Next::miss) return b == Next::miss ? Action::miss : Action::take_b;
        if (b == Next::miss) return Action::take_a;
        if (a == Next::enter && b == Next::enter) return a_at <= b_at ? Action::take_a : Action::take_b;
        if (a == Next::enter) return a_at <= b_at ? Action::pass_a : Action::take_b;
        if (b == Next::enter) return b_at <= a_at ? Action::pass_b : Action::take_a;
        if (std::isinf(a_at)) return Action::take_a;
        return a_at <= b_at ? Action::pass_a : Action::pass_b;
    }
    if (a == Next::miss || b == Next::miss) return Action::miss;
    if (a == Next::enter && b == Next::enter) return a_at <= b_at ? Action::pass_a : Action::pass_b;
    if (a == Next::enter) return a_at < b_at ? Action::take_a : Action::pass_b;
    if (b == Next::enter) return b_at < a_at ? Action::take_b : Action::pass_a;
    return a_at <= b_at ? Action::take_a : Action::take_b;
}

}  // namespace kensler_table

namespace {

using namespace kensler_table;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// A stack of more levels than this, or more steps, and the ray is given up.
constexpr int most_levels = 2'000;
constexpr std::uint64_t most_steps = 20'000'000;

struct Surface {
    Next next = Next::miss;
    double t = infinity;
};

Surface complement(Surface s) {
    if (s.next == Next::miss) return {Next::exit, infinity};
    if (s.next == Next::enter) return {Next::exit, s.t};
    if (s.t == infinity) return {};
    return {Next::enter, s.t};
}

struct Shared : SharedScene {
    double epsilon;  ///< millimetres
};

class Worker : RegionWorker<Shared> {
public:
    explicit Worker(const Shared& shared) : RegionWorker(shared) {}

    void trace(const Ray& ray, Answer& answer) {
        if (!begin(ray)) return;
        intersect(ray, surfaces_, [](double t) { return t; });
        known_.assign(live_.nodes().size(), {});
        epsilon_ = shared_.epsilon / std::hypot(ray.direction.x, ray.direction.y, ray.direction.z);
        steps_ = 0;
        gives_up_ = false;
        answer_by(answer, epsilon_, [&](const LiveTrees::Root& root) {
            walk(root);
            return !gives_up_;
        });
        all_steps_ += steps_;
    }
    Counts counts() const { return {{"nodes asked a ray", {all_steps_}}}; }

private:
    /// What a node was last asked, and what it met: the same for every t_min up to there.
    struct Known {
        double from = infinity;
        Surface surface;
    };

    double behind(double t) const { return std::max(t + epsilon_, std::nextafter(t, infinity)); }

    Surface ask(Operand operand, double t_min, int level) {
        if (operand == EMPTY_SET) return {};
        if (operand == FULL_SET) return {Next::exit, infinity};
        const Surface s = ask_node(operand >> 1, t_min, level);
        return operand & 1 ? complement(s) : s;
    }

    Surface ask_node(std::uint32_t index, double t_min, int level) {
        Known& known = known_[index];
        if (known.from <= t_min && t_min < known.surface.t) return known.surface;
        const LiveTrees::Node& node = live_.nodes()[index];
        if (++steps_ > most_steps || level > most_levels) {
            gives_up_ = true;
            return {};
        }
        Surface s;
        if (node.gate == Gate::leaf) {
            const std::span<const double> own = surfaces_of(node.solid, surfaces_);
            const auto at = std::upper_bound(own.begin(), own.end(), t_min);
            if (at != own.end()) s = {(at - own.begin()) % 2 ? Next::exit : Next::enter, *at};
        } else {
            s = combine(node, t_min, level + 1);
        }
        known_[index] = {t_min, s};
        return s;
    }

    Surface combine(const LiveTrees::Node& node, double t_min, int level) {
        Surface a = ask(node.left, t_min, level), b = ask(node.right, t_min, level);
        while (!gives_up_) {
            switch (action(node.gate, a.next, a.t, b.next, b.t)) {
                case Action::take_a:
                    return a;
                case Action::take_b:
                    return b;
                case Action::take_a_flipped:
                    return complement(a);
                case Action::take_b_flipped:
                    return complement(b);
                case Action::miss:
                    return {};
                case Action::pass_a:
                    a = ask(node.left, behind(a.t), level);
                    break;
                case Action::pass_b:
                    b = ask(node.right, behind(b.t), level);
                    break;
            }
            ++steps_;
        }
        return {};
    }

    /// Region after region along the ray. What is thinner than epsilon, a region or a gap in it, is not seen.
    void walk(const LiveTrees::Root& root) {
        Surface s = ask(root.operand, -infinity, 0);
        double in = -infinity;
        bool inside = s.next == Next::exit;
        while (!gives_up_ && s.next != Next::miss) {
            const Surface behind_it = s.t == infinity ? Surface{} : ask(root.operand, behind(s.t), 0);
            const bool enters = behind_it.next == Next::exit;
            if (!inside && s.t > nearest_) return;
            if (inside && !enters) {
                claimed_.push_back({root.region, in, s.t});
                if (shared_.first_hits && s.t > 0) {
                    keep_nearest(in, 2 * epsilon_);
                    return;
                }
            }
            if (!inside && enters) in = s.t;
            inside = enters;
            s = behind_it;
        }
    }

    std::vector<double> surfaces_;
    std::vector<Known> known_;
    double epsilon_ = 0;
    std::uint64_t steps_ = 0, all_steps_ = 0;
    bool gives_up_ = false;
};

}  // namespace

Method kensler() {
    Method m;
    m.name = "Kensler";
    m.source = "Kensler 2006; Ulyanov et al. 2017, Opticks";
    m.about =
        "Each node asks its operands for their next surface only, and again behind it, by epsilon, where the other "
        "operand hides it. For speed: the hierarchy's candidates, each solid intersected once a ray, subtrees without "
        "candidates left out, operators of many operands balanced, and each node keeps its last answer.";
    m.breaks =
        "slivers: shells and plates thinner than epsilon are not seen. far_origin at the fine end: epsilon is below "
        "the rounding of t. coincident, edges: surfaces that are one within rounding are met in either order. depth "
        "and deep_trees should hold, but cost.";
    m.knob = "epsilon, diameters of the scene's sphere";
    m.knob_values = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
    m.exact = false;
    m.prepare = [](const Subject& subject, const TraceOptions& options) -> std::unique_ptr<Tracer> {
        return trace_each_ray<Worker>(Shared{{subject, options}, knob_length(subject, options)}, options);
    };
    return m;
}

}  // namespace csgrt::bench
