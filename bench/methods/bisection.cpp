// Interval bisection.
//
// Theory: a solid is where f < 0, a union is min(f, g), an intersection max(f, g), a complement -f, so a tree has an
// f, too. Interval arithmetic says in which range f is on a piece of the ray. Where 0 is not in that range, the whole
// piece is certainly outside, or inside; else it is halved, down to 2^-k of the ray's length in the scene's sphere. No
// stack: a piece is its level and its number, and the next one follows from the number's last bits. Results are rounded
// outward, so a piece that is called empty is empty: a miss is certified, for the numbers that the kernels have of the
// solids.
//
// A piece of the last level whose range has 0 in it holds a surface, or may hold one. Between outside and inside the
// end is in the middle of such pieces; between inside and inside they are nothing; between outside and outside they are
// a region if they are more than two. The sources take a single one for a hit. That finds what is thinner than a piece,
// but where a solid and what is taken from it share a face f is 0, too, and a skin is left at every k: of the stress
// family coincident 29 % of the rays are wrong then, of the model truck 7 %, and none by the rule here.
//
// Only the sign of f counts, and of min and max it follows from the operands' signs, so those are what is computed. A
// solid whose sign is known on a piece is not asked again within it.
//
// Source: Hijazi, Knoll, Schott, Kensler, Hansen, Hagen, "CSG operations of arbitrary primitives with interval
// arithmetic and real-time ray casting", 2010; Knoll et al. 2009. Cost: k evaluations of f a surface and more; where f
// stays near 0, 2^k. Fails where a ray grazes a surface within 2^-k, or runs along one, and on what is thinner.
#include <algorithm>
#include <cmath>
#include <limits>

#include "each_ray.hpp"
#include "list.hpp"
#include "ray_domain.hpp"
#include "ray_forms.hpp"

namespace csgrt::bench {
namespace {

/// More pieces than this, and the ray is given up.
constexpr std::uint64_t most_pieces = std::uint64_t{1} << 18;

struct Shared : SharedScene {
    unsigned levels;
};

class Worker : RegionWorker<Shared> {
public:
    explicit Worker(const Shared& shared) : RegionWorker(shared) {}

    void trace(const Ray& ray, Answer& answer) {
        const CompiledScene& scene = shared_.rays.scene();
        const std::uint64_t asked_before = asked_;
        undecided_ = false;
        if (begin(ray)) {
            domain_ = search_domain(scene, ray);
            if (solids_.size() > forms_.size()) forms_.resize(solids_.size());
            known_.assign(solids_.size(), {});
            for (std::size_t i = 0; i < solids_.size(); ++i) {
                forms_[i].set(scene, solids_[i], ray);
                known_[i].within = in_box(scene.solid_boxes[solids_[i]], ray, domain_);
            }
            piece_ = std::ldexp(domain_.to - domain_.from, -static_cast<int>(shared_.levels));
            answer_by(answer, 2 * piece_, [&](const LiveTrees::Root& root) { return search(root); });
        }
        if (answer.answered && answer.stretches.empty()) {
            ++misses_;
            if (!undecided_) ++certified_;
        }
        pieces_ += asked_ - asked_before;
    }
    Counts counts() const {
        return {{"pieces a ray", {pieces_}},
                {"misses, share of rays", {misses_}},
                {"certified misses, share of rays", {certified_}}};
    }

private:
    struct Known {
        Domain within;             ///< outside the solid's box it is outside
        double from = 1, to = -1;  ///< where the sign is known
        int sign = 0;
    };

    int sign_of(std::uint32_t solid, double from, double to) {
        Known& k = known_[solid];
        if (k.from <= from && to <= k.to) return k.sign;
        if (to < k.within.from || from > k.within.to) return 1;
        const int sign = forms_[solid].sign(from, to);
        if (sign != 0) k = {k.within, from, to, sign};
        return sign;
    }

    int sign_of(const LiveTrees::Root& root, double from, double to) {
        ++asked_;
        return live_.function_of<signed char>(root, 1, signs_, [&](std::uint32_t candidate) {
            return static_cast<signed char>(sign_of(candidate, from, to));
        });
    }

    /// False: too many pieces.
    bool search(const LiveTrees::Root& root) {
        const unsigned last = shared_.levels;
        const double piece = piece_;
        const auto border = [&](std::uint64_t number) { return domain_.from + static_cast<double>(number) * piece; };
        unsigned level = 0;
        std::uint64_t number = 0, pieces = 0;
        int before = 1;                 // the last decided sign
        double in = 0, open_since = 0;  // of a stretch; of a run of pieces that are not decided
        bool is_open = false, inside = false;
        const auto enter = [&](double t) {
            in = t;
            inside = true;
        };
        bool seen = false;  // a stretch that ends behind the ray's start
        const auto claim = [&](double since, double t) {
            if (!(t - since > 2 * piece)) return;
            claimed_.push_back({root.region, since, t});
            seen = seen || t > 0;
        };
        const auto leave = [&](double t) {
            claim(in, t);
            inside = false;
        };
        for (;;) {
            const double from = border(number << (last - level)), to = border((number + 1) << (last - level));
            const int sign = sign_of(root, from, to);
            if (++pieces > most_pieces) return false;
            if (sign == 0 && level < last) {
                ++level;
                number <<= 1;
                continue;
            }
            if (sign == 0 && !is_open) {
                is_open = undecided_ = true;
                open_since = from;
            }
            if (sign != 0) {
                const double middle = is_open ? 0.5 * (open_since + from) : from;
                if (sign < 0 && before > 0) enter(from == domain_.from ? -infinity : middle);
                if (sign > 0 && before < 0) leave(middle);
                if (sign > 0 && before > 0 && is_open) claim(open_since, from);
                before = sign;
                is_open = false;
                if (shared_.first_hits && !inside && seen) {
                    keep_nearest(claimed_.back().in, 2 * piece);
                    return true;
                }
                if (!inside && to > nearest_) return true;
            }
            ++number;
            while (level > 0 && !(number & 1)) {
                number >>= 1;
                --level;
            }
            if (level == 0 && number == 1) break;
        }
        if (inside) leave(is_open ? 0.5 * (open_since + domain_.to) : infinity);
        return true;
    }

    std::vector<RayForm> forms_;
    std::vector<Known> known_;
    std::vector<signed char> signs_;
    Domain domain_;
    double piece_ = 0;  ///< of the last level, its length
    bool undecided_ = false;
    std::uint64_t asked_ = 0, pieces_ = 0, misses_ = 0, certified_ = 0;
};

}  // namespace

Method bisection() {
    Method m;
    m.name = "interval bisection";
    m.source = "Hijazi et al. 2010, Knoll et al. 2009";
    m.about =
        "Halves the ray where the range of f, by interval arithmetic, has 0 in it, down to 2^-k of its length in the "
        "scene. For speed: the hierarchy's candidates, subtrees without candidates left out, polynomials along the "
        "ray in centred form, signs only, no stack, and a solid whose sign is known on a piece is not asked within "
        "it.";
    m.breaks =
        "tangent: a ray that passes within 2^-k of a surface meets it. coincident and coplanar: where an operand and "
        "what is taken from it share a face, f is 0 there and a skin is left. pinch, slivers: likewise. deep_trees "
        "costs much: every piece walks the tree.";
    m.knob = "k, bits of the ray's length";
    m.knob_values = {8, 12, 16, 20, 24};
    m.exact = false;
    m.prepare = [](const Subject& subject, const TraceOptions& options) -> std::unique_ptr<Tracer> {
        const std::string missing = type_without_form(subject.compiled);
        if (!missing.empty())
            throw Error(Status::usage,
                        "interval bisection: there is no implicit function of a solid of type " + missing);
        if (!(options.knob >= 1 && options.knob <= 48))
            throw Error(Status::usage, "interval bisection: needs from 1 to 48 bits");
        return trace_each_ray<Worker>(Shared{{subject, options}, static_cast<unsigned>(options.knob)}, options);
    };
    return m;
}

}  // namespace csgrt::bench
