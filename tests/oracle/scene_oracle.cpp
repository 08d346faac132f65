#include "scene_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace csgrt::oracle {

SceneOracle::SceneOracle(const Scene& scene, const std::vector<std::string>& objects, bool skip_unsupported,
                         bool filtered, bool air)
    : scene_(scene), skip_unsupported_(skip_unsupported), filtered_(filtered), air_(air) {
    const std::vector<std::string> names = objects.empty() ? top_objects(scene) : objects;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool is_placed = objects.empty() && !scene.top_matrices.empty();
        for (OracleRegion& region : starts(names[i], is_placed ? to_affine(scene.top_matrices[i]) : QAffine{}, ""))
            regions_.push_back(std::move(region));
    }
    regions_of_.resize(solids_.size());
    for (std::uint32_t r = 0; r < regions_.size(); ++r)
        regions_[r].tree.each([&](std::size_t solid) { regions_of_[solid].push_back(r); });
    std::vector<BoundingSphere> spheres;
    for (std::size_t i = 0; i < solids_.size(); ++i) {
        if (solids_[i].bounds.radius == HUGE_VAL) {
            everywhere_.push_back(i);
            continue;
        }
        spheres.push_back(solids_[i].bounds);
        somewhere_.push_back(i);
    }
    tree_ = SphereTree(std::move(spheres));
}

SceneAnswer SceneOracle::shoot(const Ray& ray, double slack) const {
    const double speed = to_double(length(QVec(ray.direction)));
    SceneAnswer answer;
    std::vector<std::size_t> near = everywhere_;
    tree_.each(ray.origin, ray.direction, 0, [&](std::size_t i) { near.push_back(somewhere_[i]); });
    std::sort(near.begin(), near.end());
    std::vector<Sure> sets;  // of the solids that the ray may meet
    quad most = 0;
    double least = HUGE_VAL;  // radius of what is met
    for (const std::size_t i : near) {
        const Answer one = solids_[i](ray);
        if (one.intervals.empty() && one.outer.empty() && !one.tie) continue;
        sets.push_back({i, {}, {}, {}});
        answer.solid_tie = answer.solid_tie || one.tie;
        double widest = 0;
        for (const Interval& interval : one.intervals) {
            sets.back().exact.push_back({{interval.in.t, 0}, {interval.out.t, 0}});
            for (const End& e : {interval.in, interval.out}) {
                if (!std::isfinite(e.t)) continue;
                const double rounding = margin * one.delta / (e.cosine * speed) + 4 * double_epsilon * std::abs(e.t);
                answer.events.push_back({e.t, e.tolerance, e.normal, std::min(rounding, e.tolerance), i});
                widest = std::max(widest, e.tolerance);
            }
        }
        const quad by = quad(slack / speed) + quad(widest);
        most = larger(most, by);
        if (!one.intervals.empty()) least = std::min(least, solids_[i].bounds.radius);
        Sure& set = sets.back();
        set.inner = resized(one.inner, -by);
        set.outer = resized(one.outer, by);
        if (set.exact.empty() && set.outer.empty()) sets.pop_back();
    }
    // What runs along a face may end anywhere on it: a thousandth of a solid is more than an end can be shifted.
    weave(sets, regions_, regions_of_, smaller(most, quad((slack + 1e-3 * least) / speed)), answer);
    return answer;
}

bool SceneOracle::has_normal(std::size_t solid, const QVec& point, const QVec& normal, quad reach) const {
    const ImplicitSolid* s = solids_[solid].implicit.get();
    for (std::size_t k = 0; s != nullptr && k < s->surfaces.size(); ++k) {
        const QVec n = s->normal(k, point), local = s->to_local.point(point);
        if (smaller(length(n - normal), length(n + normal)) > quad(1e-6)) continue;
        const quad slope = length(s->to_local.transposed(s->surfaces[k]->gradient(local)));
        if (absolute(s->surfaces[k]->value(local)) <= slope * reach) return true;
    }
    return false;
}

const Object& SceneOracle::object(const std::string& name) const {
    if (const Object* found = scene_.find(name)) return *found;
    throw Error(Status::scene, "there is no object '" + name + "'");
}

Expression SceneOracle::composite(std::vector<PipePart> parts) {
    Expression outer, bores;
    for (PipePart& part : parts) {
        (part.bore ? bores : outer).operands.push_back({Operator::leaf, {}, solids_.size()});
        solids_.push_back(scene_solid(std::move(part.solid), filtered_));
    }
    return bores.operands.empty() ? outer : apply(Operator::difference, outer, bores);
}

Expression SceneOracle::leaf(const Solid& solid, const QAffine& place) {
    if (skip_unsupported_ && std::holds_alternative<Unsupported>(solid.shape)) return {};
    if (const auto* pipe = std::get_if<Pipe>(&solid.shape)) return composite(parts(*pipe, place));
    if (const auto* line = std::get_if<Cline>(&solid.shape)) return composite(parts(*line, place));
    const double skin = scene_.tolerance > 0 ? 2 * scene_.tolerance : 0.001;
    solids_.push_back(scene_solid(solid.shape, place, skin, filtered_));
    return {Operator::leaf, {}, solids_.size() - 1};
}

Expression SceneOracle::expression(const std::string& name, const QAffine& m) {
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

Expression SceneOracle::all_of(const Starts& starts) {
    Expression e;
    for (const OracleRegion& start : starts) e.operands.push_back(start.tree);
    return e;
}

SceneOracle::Starts SceneOracle::combine(Operator op, const Starts& left, const Starts& right) {
    Starts result;
    if (op == Operator::union_) {
        result = left;
        result.insert(result.end(), right.begin(), right.end());
    } else if (op == Operator::difference) {
        for (const OracleRegion& a : left) result.push_back({a.path, apply(op, a.tree, all_of(right)), a.rank});
    } else if (op == Operator::intersection) {
        for (const OracleRegion& a : left)
            for (const OracleRegion& b : right) result.push_back({a.path, apply(op, a.tree, b.tree), a.rank});
    } else if (left.empty() || right.empty()) {
        result = left.empty() ? right : left;
    } else {
        result.push_back({left.front().path, apply(op, all_of(left), all_of(right)), left.front().rank});
    }
    return result;
}

SceneOracle::Starts SceneOracle::starts(const std::string& name, const QAffine& m, const std::string& above) {
    const Object& found = object(name);
    const std::string path = above + "/" + name;
    const auto* combination = std::get_if<Combination>(&found);
    if (combination == nullptr || combination->region) {
        const bool is_air = combination != nullptr && combination->air != 0;
        if (is_air && !air_) return {};
        int rank = is_air ? 3 : 0;
        if (combination != nullptr && !is_air)
            rank = combination->fastgen == Fastgen::plate ? 1 : combination->fastgen == Fastgen::volume ? 2 : 0;
        return {{path, expression(name, m), rank}};
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
            result = {{result.front().path, Expression{Operator::not_, {all_of(result)}, 0}, result.front().rank}};
        for (std::size_t i = first + 1; i < stack.size(); ++i) result = combine(node.op, result, stack[i]);
        stack.resize(first);
        stack.push_back(std::move(result));
    }
    return stack.empty() ? Starts{} : stack.back();
}

}  // namespace csgrt::oracle
