// Cells of the common boxes of pairs: searched level by level, divided where both regions were seen.
#include <algorithm>
#include <cmath>

#include "analysis/overlap_search.hpp"
#include "base/parallel.hpp"

namespace csgrt::analysis {

struct Cell {
    std::size_t pair = 0;
    std::uint32_t number = 0;  ///< among the pair's cells
    Box box = {};
    double gap = nowhere;  ///< mm along a ray between the two regions; infinite: no ray met both
    bool is_met_by_first = false, is_met_by_second = false;
};

namespace {

// Cells have side x side rays along each axis, and are larger than their share of the box. After the levels at
// which all cells are divided, a level has few cells of each pair; of those in which the two touch, fewer.
constexpr std::uint32_t side = 5, cell_rays = 3 * side * side;
constexpr double enlarged = 1.4;
constexpr std::uint32_t levels = 7, levels_of_all = 1;
constexpr double cells_a_level = 192, touching_cells_a_level = 8;
constexpr double after_solids = 0.25;  ///< of these, for pairs that solids have not shown in cells as small

}  // namespace

/// Looks at the rays of a cell: which regions they meet, and how near to each other.
void OverlapSearch::look_at(Cell& cell, std::size_t first_ray) const {
    const Pair& pair = pairs[cell.pair];
    const auto first = static_cast<std::int32_t>(pair.first), second = static_cast<std::int32_t>(pair.second);
    struct Interval {
        double in, out;
    };
    std::vector<Interval> of_first, of_second;
    cell.gap = nowhere;
    for (std::size_t ray = first_ray; ray < first_ray + cell_rays; ++ray) {
        of_first.clear();
        of_second.clear();
        const auto add = [&](std::int32_t region, double in, double out) {
            if (region == first) of_first.push_back({in, out});
            if (region == second) of_second.push_back({in, out});
        };
        for (auto row = static_cast<std::size_t>(rows.ray_splits[ray]);
             row < static_cast<std::size_t>(rows.ray_splits[ray + 1]); ++row)
            add(rows.region_ids[row], rows.t_in[row], rows.t_out[row]);
        for (auto k = static_cast<std::size_t>(rows.overlap_splits[ray]);
             k < static_cast<std::size_t>(rows.overlap_splits[ray + 1]); ++k)
            for (auto c = rows.overlap_region_splits[k] + 1; c < rows.overlap_region_splits[k + 1]; ++c)
                add(rows.overlap_region_ids[static_cast<std::size_t>(c)], rows.overlap_t_in[k], rows.overlap_t_out[k]);
        cell.is_met_by_first |= !of_first.empty();
        cell.is_met_by_second |= !of_second.empty();
        for (const Interval& a : of_first)
            for (const Interval& b : of_second) cell.gap = std::min(cell.gap, std::max(b.in - a.out, a.in - b.out));
    }
}

/// Takes from cells that fill a pair's common box, one of which is given, that the pair was not found by their rays. A
/// ball's centre is in a cell, whose rays end beyond it, so they may show no more than their part beyond it.
void OverlapSearch::exclude_by_cells(Pair& pair, const Box& cell) const {
    const Vec3 size = cell.high - cell.low;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if ((enlarged - 1) / 2 * size.*axes[axis] < shortest) continue;
        const double u = enlarged / side * size.*axes[(axis + 1) % 3], v = enlarged / side * size.*axes[(axis + 2) % 3];
        exclude(pair, u * u + v * v);
    }
}

/// Searches the pairs that are not found, level by level. A level's cells are those of all pairs, so whether a pair is
/// found does not hang on the number of cells that are traced at once.
void OverlapSearch::search_cells() {
    std::vector<Cell> cells, children;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (!is_done(pairs[i])) cells.push_back({.pair = i, .box = pairs[i].box});
    const auto touches = [&](const Cell& cell) {
        return std::abs(cell.gap) <= 1e-6 * length(cell.box.high - cell.box.low);
    };
    for (std::uint32_t level = 0; level < levels && !cells.empty(); ++level) {
        constexpr std::size_t cells_at_once = rays_at_once / cell_rays;
        for (std::size_t begin = 0; begin < cells.size(); begin += cells_at_once) {
            const std::size_t end = std::min(cells.size(), begin + cells_at_once);
            rays.resize((end - begin) * cell_rays);
            ranges.resize(rays.size());
            for_chunks(end - begin, 16, threads, [&](std::size_t i, std::size_t last, std::size_t) {
                for (; i < last; ++i) {
                    const Cell& cell = cells[begin + i];
                    Random random{request.seed, 1, pairs[cell.pair].first, pairs[cell.pair].second, level, cell.number};
                    const Vec3 middle = center_of(cell.box), half = enlarged / 2 * (cell.box.high - cell.box.low);
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        double Vec3::*const d = axes[axis], Vec3::*const u = axes[(axis + 1) % 3],
                                            Vec3::*const v = axes[(axis + 2) % 3];
                        const double shift_u = random.next(), shift_v = random.next();
                        for (std::uint32_t k = 0; k < side * side; ++k) {
                            Ray ray{middle - half, {}};
                            ray.direction.*d = 1;
                            ray.origin.*u += 2 * half.*u * (k % side + shift_u) / side;
                            ray.origin.*v += 2 * half.*v * (k / side + shift_v) / side;
                            const std::size_t at = i * cell_rays + axis * side * side + k;
                            rays[at] = ray;
                            ranges[at] = {0, 2 * half.*d};
                        }
                    }
                }
            });
            trace();
            take_sights();
            for_chunks(end - begin, 16, threads, [&](std::size_t i, std::size_t last, std::size_t) {
                for (; i < last; ++i) look_at(cells[begin + i], i * cell_rays);
            });
        }
        children.clear();
        for (std::size_t first = 0, end = 0; first < cells.size(); first = end) {
            const std::size_t pair = cells[first].pair;
            while (end < cells.size() && cells[end].pair == pair) ++end;
            if (level <= levels_of_all) exclude_by_cells(pairs[pair], cells[first].box);
            if (is_done(pairs[pair])) continue;
            const double effort = request.effort * (pairs[pair].is_searched ? after_solids : 1),
                         most = std::max(1.0, cells_a_level * effort),
                         most_touching = std::max(1.0, touching_cells_a_level * effort);
            std::vector<const Cell*> kept;
            for (std::size_t i = first; i < end; ++i)
                if (level < levels_of_all || (cells[i].is_met_by_first && cells[i].is_met_by_second))
                    kept.push_back(&cells[i]);
            // Cells in which the two touch are searched last, and fewer of them: most models are full of contact.
            std::ranges::stable_sort(kept, {}, [&](const Cell* cell) { return std::pair(touches(*cell), cell->gap); });
            const std::size_t begin = children.size();
            for (const Cell* cell : kept) {
                if (level >= levels_of_all &&
                    static_cast<double>(children.size() - begin) >= (touches(*cell) ? most_touching : most))
                    break;
                for (const Box& box : parts_of(cell->box))
                    children.push_back({.pair = cell->pair, .box = box, .gap = cell->gap});
            }
            for (std::size_t i = begin; i < children.size(); ++i)
                children[i].number = static_cast<std::uint32_t>(i - begin);
        }
        std::swap(cells, children);
    }
}

}  // namespace csgrt::analysis
