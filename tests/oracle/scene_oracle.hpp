// Whole scenes by point membership: which regions hold which stretches of a ray, and how sure that is.
//
// Regions by BRL-CAD's rules: a combination with the region flag is one, with all that stands below it; a solid in no
// region is one of its own. Above regions unions only collect; A - B and A + B apply to every region of A, the latter
// once for every region of B; xor and complement make one region of all they hold. Such a region is called by the path
// of its leftmost start.
//
// The matrices on the way down are multiplied in 113 bits; only their product reaches a solid.
//
// A region holds only where at least one of its solids does: the complement of nothing is no material.
//
// A ray's bounds in all solids are merged; between two neighbouring ones no membership changes, so each region's tree
// is evaluated once there, by plain recursion, in three values: inside, outside, or within the solids' doubt (see
// intersect.hpp), widened by `slack` for a weaver that takes ends so close to each other for one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "scene_solid.hpp"
#include "solids/pipe.hpp"

namespace csgrt::oracle {

enum class Membership : std::uint8_t { outside, unsure, inside };

inline Membership both(Membership a, Membership b) { return a < b ? a : b; }
inline Membership either(Membership a, Membership b) { return a < b ? b : a; }
inline Membership opposite(Membership a) { return static_cast<Membership>(2 - static_cast<int>(a)); }
inline Membership one_of(Membership a, Membership b) { return either(both(a, opposite(b)), both(opposite(a), b)); }

/// A Boolean expression over solids.
struct Expression {
    Operator op = Operator::union_;  ///< a union of nothing is the empty set
    std::vector<Expression> operands;
    std::size_t solid = 0;  ///< leaf: index into the oracle's solids

    /// In any of the solids?
    template <class Of>
    Membership any(const Of& of) const {
        if (op == Operator::leaf) return of(solid);
        Membership value = Membership::outside;
        for (const Expression& operand : operands) value = either(value, operand.any(of));
        return value;
    }
    template <class Call>
    void each(const Call& call) const {
        if (op == Operator::leaf) call(solid);
        for (const Expression& operand : operands) operand.each(call);
    }
    /// `of(solid)` is the membership of a solid.
    template <class Of>
    Membership evaluate(const Of& of) const {
        if (op == Operator::leaf) return of(solid);
        if (operands.empty()) return Membership::outside;
        Membership value = operands.front().evaluate(of);
        if (op == Operator::not_) return opposite(value);
        for (std::size_t i = 1; i < operands.size(); ++i) {
            const Membership next = operands[i].evaluate(of);
            switch (op) {
                case Operator::intersection:
                    value = both(value, next);
                    break;
                case Operator::difference:
                    value = both(value, opposite(next));
                    break;
                case Operator::xor_:
                    value = one_of(value, next);
                    break;
                default:
                    value = either(value, next);
            }
        }
        return value;
    }
};

struct OracleRegion {
    std::string path;
    Expression tree;

    template <class Of>
    Membership evaluate(const Of& of) const {
        const Membership value = tree.evaluate(of);
        return value == Membership::outside ? value : both(value, tree.any(of));
    }
};

/// A stretch of a ray over which nothing changes, and the regions that hold it or may hold it, ascending.
struct Piece {
    struct Claim {
        std::uint32_t region = 0;
        bool certain = false;
    };
    double in = 0, out = 0;
    std::vector<Claim> claims;
};

/// An end of a solid's interval.
struct Event {
    double t = 0, tolerance = 0;
    Vec3 normal;          ///< outward from the solid; 0: more than one would do
    double rounding = 0;  ///< of the tolerance: what rounding the ray's and the solid's numbers can cause
    std::size_t solid = 0;
};

struct SceneAnswer {
    std::vector<Spans> regions;  ///< for every region its spans, exactly
    std::vector<Piece> pieces;   ///< the whole line, in order
    std::vector<Event> events;   ///< of all solids, in no order
    bool tie = false;            ///< rounding, or the slack, decides how many spans some region has, or where one ends
    bool solid_tie = false;      ///< rounding decides how many intervals some solid has
};

class SceneOracle {
public:
    /// `objects` of the scene, empty: its top objects. Air regions are left out. `skip_unsupported`: solids of unknown
    /// types are empty sets.
    explicit SceneOracle(const Scene& scene, const std::vector<std::string>& objects = {},
                         bool skip_unsupported = false, bool quick = false)
        : scene_(scene), skip_unsupported_(skip_unsupported), quick_(quick) {
        for (const std::string& name : objects.empty() ? top_objects(scene) : objects)
            for (OracleRegion& region : starts(name, QAffine{}, "")) regions_.push_back(std::move(region));
        regions_of_.resize(solids_.size());
        for (std::uint32_t r = 0; r < regions_.size(); ++r)
            regions_[r].tree.each([&](std::size_t solid) { regions_of_[solid].push_back(r); });
    }

    // Keeps the scene by reference; so a temporary will not do.
    explicit SceneOracle(Scene&&, const std::vector<std::string>& = {}, bool = false) = delete;

    const std::vector<OracleRegion>& regions() const { return regions_; }

    /// `slack` in millimetres.
    SceneAnswer shoot(const Ray& ray, double slack) const {
        const double speed = to_double(length(QVec(ray.direction)));
        SceneAnswer answer;
        std::vector<Sure> sets;  // of the solids that the ray may meet
        std::vector<quad> bounds;
        quad most = 0;
        double least = HUGE_VAL;  // radius of what is met
        for (std::size_t i = 0; i < solids_.size(); ++i) {
            if (solids_[i].reach.is_passed_by(ray.origin, ray.direction)) continue;
            const Answer one = solids_[i](ray);
            sets.push_back({i, {}, {}, {}});
            answer.solid_tie = answer.solid_tie || one.tie;
            double widest = 0;
            for (const Interval& interval : one.intervals) {
                sets.back().exact.push_back({{interval.in.t, 0}, {interval.out.t, 0}});
                for (const End& e : {interval.in, interval.out}) {
                    if (!std::isfinite(e.t)) continue;
                    const double rounding =
                        margin * one.delta / (e.cosine * speed) + 4 * double_epsilon * std::abs(e.t);
                    answer.events.push_back({e.t, e.tolerance, e.normal, std::min(rounding, e.tolerance), i});
                    widest = std::max(widest, e.tolerance);
                }
            }
            const quad by = quad(slack / speed) + quad(widest);
            most = larger(most, by);
            if (!one.intervals.empty()) least = std::min(least, solids_[i].reach.radius);
            Sure& set = sets.back();
            set.inner = resized(one.inner, -by);
            set.outer = resized(one.outer, by);
            for (const Spans* spans : {&set.inner, &set.exact, &set.outer})
                for (const Span& s : *spans)
                    for (const quad t : {s.in.at, s.out.at})
                        if (absolute(t) < infinity()) bounds.push_back(t);
            if (set.exact.empty() && set.outer.empty()) sets.pop_back();
        }
        std::sort(bounds.begin(), bounds.end());
        bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
        // What runs along a face may end anywhere on it: a thousandth of a solid is more than an end can be shifted.
        weave(sets, bounds, smaller(most, quad((slack + 1e-3 * least) / speed)), answer);
        return answer;
    }

    /// Is it the normal, to either side, of some surface of the solid that runs within `reach` millimetres of the
    /// point? On an edge that of either face will do.
    bool has_normal(std::size_t solid, const QVec& point, const QVec& normal, quad reach) const {
        const ImplicitSolid* s = solids_[solid].implicit.get();
        for (std::size_t k = 0; s != nullptr && k < s->surfaces.size(); ++k) {
            const QVec n = s->normal(k, point), local = s->to_local.point(point);
            if (smaller(length(n - normal), length(n + normal)) > quad(1e-6)) continue;
            const quad slope = length(s->to_local.transposed(s->surfaces[k]->gradient(local)));
            if (absolute(s->surfaces[k]->value(local)) <= slope * reach) return true;
        }
        return false;
    }

private:
    struct Sure {
        std::size_t index = 0;  ///< of the solid, or of the region
        Spans inner, exact, outer;
    };

    /// Every span longer by `by` at both ends (shorter if negative).
    static Spans resized(Spans spans, quad by) {
        for (Span& s : spans) {
            s.in.at = s.in.at - by;
            s.out.at = s.out.at + by;
        }
        std::erase_if(spans, [](const Span& s) { return !(s.in.at < s.out.at); });
        return join(std::move(spans));
    }
    /// May an end be somewhere else altogether: where a ray runs along a face, another one decides?
    static bool leaps(const Spans& inner, const Spans& outer, quad far) {
        for (std::size_t i = 0; i < inner.size(); ++i)
            if (inner[i].in.at - outer[i].in.at > far || outer[i].out.at - inner[i].out.at > far) return true;
        return false;
    }
    static bool holds(const Spans& spans, quad t) {
        return std::any_of(spans.begin(), spans.end(), [&](const Span& s) { return s.in.at < t && t < s.out.at; });
    }

    /// `most`: by what the ends of any set were moved, as far as it is no leap.
    void weave(const std::vector<Sure>& sets, const std::vector<quad>& bounds, quad most, SceneAnswer& answer) const {
        // Regions none of whose solids are met hold nothing.
        std::vector<Sure> found;
        for (const Sure& set : sets)
            for (const std::uint32_t r : regions_of_[set.index]) found.push_back({r, {}, {}, {}});
        std::sort(found.begin(), found.end(), [](const Sure& a, const Sure& b) { return a.index < b.index; });
        const auto same = [](const Sure& a, const Sure& b) { return a.index == b.index; };
        found.erase(std::unique(found.begin(), found.end(), same), found.end());
        const auto extend = [](Spans& spans, quad in, quad out) {
            if (!spans.empty() && spans.back().out.at == in)
                spans.back().out.at = out;
            else
                spans.push_back({{in, 0}, {out, 0}});
        };
        std::vector<Membership> sure(solids_.size(), Membership::outside), exact = sure;
        for (std::size_t i = 0; i <= bounds.size(); ++i) {
            const quad in = i == 0 ? -infinity() : bounds[i - 1], out = i == bounds.size() ? infinity() : bounds[i];
            quad middle = (in + out) / 2;
            if (bounds.empty())
                middle = 0;
            else if (i == 0)
                middle = out - (1 + absolute(out));
            else if (i == bounds.size())
                middle = in + (1 + absolute(in));
            for (const Sure& set : sets) {
                exact[set.index] = holds(set.exact, middle) ? Membership::inside : Membership::outside;
                sure[set.index] = holds(set.inner, middle)   ? Membership::inside
                                  : holds(set.outer, middle) ? Membership::unsure
                                                             : Membership::outside;
            }
            Piece piece{to_double(in), to_double(out), {}};
            for (Sure& one : found) {
                const OracleRegion& region = regions_[one.index];
                const Membership m = region.evaluate([&](std::size_t s) { return sure[s]; });
                if (m == Membership::inside) extend(one.inner, in, out);
                if (m != Membership::outside) {
                    extend(one.outer, in, out);
                    piece.claims.push_back({static_cast<std::uint32_t>(one.index), m == Membership::inside});
                }
                if (region.evaluate([&](std::size_t s) { return exact[s]; }) == Membership::inside)
                    extend(one.exact, in, out);
            }
            answer.pieces.push_back(std::move(piece));
        }
        answer.regions.resize(regions_.size());
        for (Sure& one : found) {
            answer.tie = answer.tie || !nested_one_to_one(one.inner, one.exact, one.outer) ||
                         leaps(one.inner, one.outer, 8 * most);
            answer.regions[one.index] = std::move(one.exact);
        }
    }

    // ---- From the scene to expressions ----

    const Object& object(const std::string& name) const {
        if (const Object* found = scene_.find(name)) return *found;
        throw Error(Status::scene, "there is no object '" + name + "'");
    }

    /// What is in one of the outer parts and in none of the bores.
    Expression composite(std::vector<PipePart> parts) {
        Expression outer, bores;
        for (PipePart& part : parts) {
            (part.bore ? bores : outer).operands.push_back({Operator::leaf, {}, solids_.size()});
            solids_.push_back(scene_solid(std::move(part.solid), quick_));
        }
        return bores.operands.empty() ? outer : apply(Operator::difference, outer, bores);
    }

    Expression leaf(const Solid& solid, const QAffine& place) {
        if (skip_unsupported_ && std::holds_alternative<Unsupported>(solid.shape)) return {};
        if (const auto* pipe = std::get_if<Pipe>(&solid.shape)) return composite(parts(*pipe, place));
        if (const auto* line = std::get_if<Cline>(&solid.shape)) return composite(parts(*line, place));
        const double skin = scene_.tolerance > 0 ? 2 * scene_.tolerance : 0.001;
        solids_.push_back(scene_solid(solid.shape, place, skin, quick_));
        return {Operator::leaf, {}, solids_.size() - 1};
    }

    /// Everything below an object, as one expression.
    Expression expression(const std::string& name, const QAffine& m) {
        const Object& found = object(name);
        if (const auto* solid = std::get_if<Solid>(&found)) return leaf(*solid, m);
        std::vector<Expression> stack;
        for (const TreeNode& node : std::get<Combination>(found).tree.nodes) {
            if (node.op == Operator::leaf) {
                stack.push_back(expression(node.object, m * to_affine(node.matrix)));
                continue;
            }
            Expression e;
            e.op = node.op;
            e.operands.assign(stack.end() - node.arity, stack.end());
            stack.resize(stack.size() - node.arity);
            stack.push_back(std::move(e));
        }
        return stack.empty() ? Expression{} : stack.back();
    }

    using Starts = std::vector<OracleRegion>;

    static Expression all_of(const Starts& starts) {
        Expression e;
        for (const OracleRegion& start : starts) e.operands.push_back(start.tree);
        return e;
    }
    static Expression apply(Operator op, const Expression& a, const Expression& b) { return {op, {a, b}, 0}; }
    static Starts combine(Operator op, const Starts& left, const Starts& right) {
        Starts result;
        if (op == Operator::union_) {
            result = left;
            result.insert(result.end(), right.begin(), right.end());
        } else if (op == Operator::difference) {
            for (const OracleRegion& a : left) result.push_back({a.path, apply(op, a.tree, all_of(right))});
        } else if (op == Operator::intersection) {
            for (const OracleRegion& a : left)
                for (const OracleRegion& b : right) result.push_back({a.path, apply(op, a.tree, b.tree)});
        } else if (left.empty() || right.empty()) {
            result = left.empty() ? right : left;
        } else {
            result.push_back({left.front().path, apply(op, all_of(left), all_of(right))});
        }
        return result;
    }

    /// The regions below an object that stands in none.
    Starts starts(const std::string& name, const QAffine& m, const std::string& above) {
        const Object& found = object(name);
        const std::string path = above + "/" + name;
        const auto* combination = std::get_if<Combination>(&found);
        if (combination == nullptr || combination->region) {
            if (combination != nullptr && combination->air != 0) return {};
            return {{path, expression(name, m)}};
        }
        std::vector<Starts> stack;
        for (const TreeNode& node : combination->tree.nodes) {
            if (node.op == Operator::leaf) {
                stack.push_back(starts(node.object, m * to_affine(node.matrix), path));
                continue;
            }
            const std::size_t first = stack.size() - node.arity;
            Starts result = stack[first];
            if (node.op == Operator::not_ && !result.empty())
                result = {{result.front().path, Expression{Operator::not_, {all_of(result)}, 0}}};
            for (std::size_t i = first + 1; i < stack.size(); ++i) result = combine(node.op, result, stack[i]);
            stack.resize(first);
            stack.push_back(std::move(result));
        }
        return stack.empty() ? Starts{} : stack.back();
    }

    const Scene& scene_;
    const bool skip_unsupported_, quick_;
    std::vector<SceneSolid> solids_;
    std::vector<OracleRegion> regions_;
    std::vector<std::vector<std::uint32_t>> regions_of_;  ///< by solid
};

}  // namespace csgrt::oracle
