// Overlaps by the regions' solids: where two regions have nothing in common, how deep they overlap, and a bound.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>

#include "analysis/overlap_search.hpp"
#include "analysis/region_depth.hpp"
#include "base/parallel.hpp"

namespace csgrt::analysis {

namespace {

// Cells of a common box, in levels: so many of a level are divided, or, of more cells, the most promising ones.
constexpr double most_solid_cells = 2048, promising_solid_cells = 256;
constexpr int most_levels = 24;
constexpr int unknown_levels = 3;  ///< if not all solids have bounds of distances

constexpr int rounds_by_solids = 16;       ///< of a climb
constexpr std::size_t most_supports = 20;  ///< planes that are compared for a bound

/// A box around a cell that holds the balls which are as large as the cell around its parts' centres.
Box twice(const Box& cell) {
    const double half = 0.5 * length(cell.high - cell.low);
    const Vec3 more = {half, half, half};
    return {cell.low - more, cell.high + more};
}

/// Millimetres: how thick an overlap is in a cell, at most, between planes that face each other.
struct Thickness {
    double of_sure = nowhere;  ///< planes with the overlap near the cell behind them
    double of_all = nowhere;   ///< planes that touch it there
};
Thickness thickness(OverlapDepth& depth, const Vec3& center, double half) {
    std::vector<TangentPlane> planes;
    depth.append_planes(center, 2 * half, planes);
    Thickness thick;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (!planes[i].is_near) continue;
        for (std::size_t k = i + 1; k < planes.size(); ++k) {
            if (!planes[k].is_near || dot(planes[i].normal, planes[k].normal) > -0.5) continue;
            const double between = planes[i].distance(center) + planes[k].distance(center) +
                                   (length(planes[i].normal + planes[k].normal) + 1e-12) * half +
                                   1e-15 * length(center);
            thick.of_all = std::min(thick.of_all, between);
            if (planes[i].is_sure && planes[k].is_sure) thick.of_sure = std::min(thick.of_sure, between);
        }
    }
    return thick;
}

}  // namespace

void OverlapSearch::for_overlaps(std::span<const std::size_t> which,
                                 const std::function<void(std::size_t, OverlapDepth&)>& work) {
    const CompiledScene& scene = compiled_scene(model);
    if (!bounds) bounds.emplace(scene);
    for_chunks(which.size(), 4, threads, [&](std::size_t i, std::size_t last, std::size_t) {
        for (; i < last; ++i) {
            OverlapDepth depth(scene, *bounds, pairs[which[i]].first, pairs[which[i]].second, pairs[which[i]].box);
            work(which[i], depth);
        }
    });
}

/// Bounds the depth by planes that touch convex bodies around the two regions, near a point.
void OverlapSearch::bound(Pair& pair, OverlapDepth& depth, const Ball& near) const {
    std::vector<TangentPlane> all, kept;
    for (int k = -3; k <= 3; ++k) {
        Vec3 point = near.center;
        if (k != 0) point.*axes[std::abs(k) - 1] += std::copysign(0.5 * near.radius, k);
        depth.append_supports(point, all);
    }
    std::ranges::stable_sort(all, {}, [&](const TangentPlane& p) { return p.distance(near.center); });
    for (const TangentPlane& plane : all) {
        const auto is_same = [&](const TangentPlane& p) { return length(p.normal - plane.normal) < 1e-6; };
        if (kept.size() < most_supports && std::ranges::none_of(kept, is_same)) kept.push_back(plane);
    }
    const double reach = length(pair.box.high - pair.box.low);
    pair.at_most = std::max(0.0, std::min(pair.at_most, diameter_behind(kept, near.center, reach)));
}

/// Makes a pair's box smaller and looks for a point in the overlap, in cells, until it is bounded by `diameter`. A cell
/// holds nothing of the overlap if its centre is outside by half of the cell's diagonal. A ball whose centre is in
/// another cell, and whose radius is more than half of its diagonal, holds the cell's centre; if this is outside, there
/// is no such ball. A smaller ball is no thicker than the overlap between planes that face each other near the cell.
void OverlapSearch::search_by_solids(std::size_t number, OverlapDepth& depth, double diameter, std::size_t most_cells,
                                     std::size_t promising_cells) {
    struct SolidCell {
        Box box;
        std::shared_ptr<OverlapDepth> depth;  ///< of the cell that it is a part of
        double in = 0;
    };
    Pair& pair = pairs[number];
    std::vector<SolidCell> cells = {{pair.box, std::make_shared<OverlapDepth>(depth), 0}}, kept;
    bool is_complete = true;
    double bound = 0;        // of the balls in cells that planes have ruled out
    Box ruled_out = no_box;  // around these cells
    for (int level = 0; level < most_levels; ++level) {
        Box box = ruled_out;
        double most = 0, kept_bound = 0;
        bool is_known = true;
        kept.clear();
        for (SolidCell& cell : cells) {
            const double half = 0.5 * length(cell.box.high - cell.box.low);
            const Vec3 center = center_of(cell.box);
            const Depth d = cell.depth->at(center);
            if (d.in > pair.sure.radius) pair.sure = {center, d.in};
            if (d.out >= half) continue;
            include(box, cell.box);
            const Thickness thick = thickness(*cell.depth, center, half);
            if (thick.of_sure < std::min(diameter, 2 * half)) {
                bound = std::max(bound, thick.of_sure);
                include(ruled_out, cell.box);
                continue;
            }
            // Curved parts of a boundary may give way to the ball between the planes that touch them.
            if (thick.of_all < std::min(diameter, 2 * half)) {
                bound = nowhere;
                include(ruled_out, cell.box);
                continue;
            }
            most = std::max(most, half);
            kept_bound = std::max(kept_bound, d.out >= 0 ? 2 * half : nowhere);
            is_known &= d.out >= 0 || d.in >= 0;
            cell.in = d.in;
            kept.push_back(std::move(cell));
        }
        if (is_complete) {
            if (has_inside(box)) pair.box = box;
            pair.at_most = std::min(pair.at_most, std::max(bound, kept_bound));
        }
        const bool is_inside = 2 * pair.sure.radius >= 0.5 * request.min_depth;
        if (!is_known && level >= unknown_levels) return;
        const bool is_fine = is_known && (kept.empty() || 2 * most < diameter);
        pair.is_searched |= is_fine;
        if (is_fine || (is_inside && kept.size() > promising_cells)) return;
        if (kept.size() > most_cells) {
            if (is_inside || promising_cells == 0) return;
            is_complete = false;
            std::ranges::stable_sort(kept, std::greater{}, &SolidCell::in);
            kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(promising_cells), kept.end());
        }
        cells.clear();
        for (const SolidCell& cell : kept) {
            const auto inner = std::make_shared<OverlapDepth>(cell.depth->in(twice(cell.box)));
            for (const Box& part : parts_of(cell.box)) cells.push_back({part, inner});
        }
    }
}

/// Takes what the solids alone tell of all pairs.
void OverlapSearch::look_at_solids() {
    std::vector<std::size_t> all(pairs.size());
    std::iota(all.begin(), all.end(), 0);
    const auto all_cells = static_cast<std::size_t>(most_solid_cells * request.effort),
               few_cells = static_cast<std::size_t>(std::max(1.0, promising_solid_cells * request.effort));
    for_overlaps(all, [&](std::size_t i, OverlapDepth& depth) {
        Pair& pair = pairs[i];
        bound(pair, depth, {center_of(pair.box), 0.25 * least_side(pair.box)});
        // Pairs that hold no ball of that size are searched only for whether they overlap.
        const double nothing = 1e-7 * length(pair.box.high - pair.box.low);
        if (pair.at_most > nothing)
            search_by_solids(i, depth, 0.5 * std::min(request.min_depth, pair.at_most), all_cells, few_cells);
        if (!(pair.sure.radius > 0)) return;
        pair.is_found = true;
        pair.chord = {{pair.sure.center, {1, 0, 0}}, -pair.sure.radius, pair.sure.radius};
        include(pair.seen, pair.sure.center);
    });
}

/// Finds the deepest point of each overlap: climbs from point to point, each as far as possible from the planes that
/// touch the boundary near the last one.
void OverlapSearch::climb_by_solids(std::span<const std::size_t> which) {
    for_overlaps(which, [this](std::size_t number, OverlapDepth& depth) {
        Pair& pair = pairs[number];
        std::vector<Ball> balls = {pair.sure};
        for (const Vec3& start : starts_of(number)) balls.push_back({start, depth.at(start).in});
        if (pair.ball.radius > 0) balls.push_back({pair.ball.center, depth.at(pair.ball.center).in});
        std::ranges::stable_sort(balls, std::greater{}, &Ball::radius);
        std::vector<TangentPlane> planes;
        for (Ball ball : std::span(balls).first(std::min(climbs_of_pair, balls.size()))) {
            for (int round = 0; round < rounds_by_solids && ball.radius > 0; ++round) {
                planes.clear();
                depth.append_planes(ball.center, nowhere, planes);
                const std::vector<TangentPlane> near = faced(planes, ball.center);
                Vec3 point = climbed(planes, near, ball.center, 10 * ball.radius, round % 2 == 0);
                double radius = depth.at(point).in;
                for (int half = 0; half < 6 && !(radius > ball.radius); ++half) {
                    point = 0.5 * (point + ball.center);
                    radius = depth.at(point).in;
                }
                if (radius > ball.radius) ball = {point, radius};
            }
            if (ball.radius > pair.sure.radius) pair.sure = ball;
        }
        bound(pair, depth, pair.deepest());
    });
}

}  // namespace csgrt::analysis
