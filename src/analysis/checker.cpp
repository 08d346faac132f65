// Checks in steps: pairs of regions whose boxes overlap; what distances to their solids tell; rays through the whole
// model; cells in the common boxes of pairs that are not found yet; then depth and volume of what was found.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include <fnmatch.h>

#include "analysis/overlap_search.hpp"
#include "base/floating_point.hpp"
#include "base/parallel.hpp"

namespace csgrt {

namespace analysis {

namespace {

constexpr std::size_t rays_in_a_row = 1024;                         ///< rays that one thread reads in a row
constexpr double rays_of_model = 20'000;                            ///< of a grid through the whole model
constexpr std::uint64_t views = 3;                                  ///< turned frames of rays through the whole model
constexpr double rays_of_overlap = 24, more_rays_of_overlap = 192;  ///< of a grid through a pair's common box

}  // namespace

/// Sweeps over the boxes in the order in which they begin along x.
void OverlapSearch::find_candidates() {
    pairs.clear();
    numbers.clear();
    unbounded.clear();
    std::vector<Box> boxes;
    Box all = no_box;
    for (const RegionInfo& region : model.regions()) {
        boxes.push_back(region.bounds);
        if (!has_inside(region.bounds) || !is_finite(region.bounds)) continue;
        include(all, region.bounds);
    }
    const auto& ranks = compiled_scene(model).rank_ends;
    std::vector<std::uint32_t> order(boxes.size()), open;
    std::iota(order.begin(), order.end(), 0);
    for (const std::uint32_t r : order) {
        if (is_finite(boxes[r]) || boxes[r].low.x > boxes[r].high.x) continue;
        unbounded.push_back(r);
        boxes[r] = common(boxes[r], all);
    }
    std::ranges::stable_sort(order, {}, [&](std::uint32_t r) { return boxes[r].low.x; });
    for (const std::uint32_t r : order) {
        const Box& box = boxes[r];
        if (!has_inside(box)) continue;
        std::erase_if(open, [&](std::uint32_t other) { return boxes[other].high.x <= box.low.x; });
        for (const std::uint32_t other : open)
            if (const Box both = common(box, boxes[other]);
                least_side(both) >= 0.5 * request.min_depth && has_inside(both) && kernel::same_rank(ranks, r, other))
                pairs.push_back({.first = std::min(r, other),
                                 .second = std::max(r, other),
                                 .box = both,
                                 .at_most = least_side(both)});
        open.push_back(r);
    }
    // The tolerance joins boundaries that are nearer to the first of them than it is long.
    const double far = length(all.low) + length(all.high);
    shortest = 2 * renderer.statistics().tolerance + rounding * (length(all.high - all.low) + 1e-4 * far);
    std::ranges::sort(pairs, {}, [](const Pair& p) { return std::pair(p.first, p.second); });
    for (std::size_t i = 0; i < pairs.size(); ++i) numbers[std::uint64_t{pairs[i].first} << 32 | pairs[i].second] = i;
}

void OverlapSearch::tell() {
    looked = Clock::now();
    if (look && !look(result(false, false))) throw Error(Status::interrupted, "interrupted");
}

void OverlapSearch::trace() {
    renderer.partitions(rays, rows, {.overlaps = true}, {.each = ranges});
    traced += rays.size();
    if (Clock::now() - looked >= between_looks) tell();
}

/// The parts of a ray that two regions share. A part may be several overlaps, if a third region begins or ends in it.
void OverlapSearch::shared_parts(std::size_t ray, std::vector<SharedPart>& parts) const {
    parts.clear();
    double last = -nowhere;  // end of the last overlap
    for (auto k = static_cast<std::size_t>(rows.overlap_splits[ray]);
         k < static_cast<std::size_t>(rows.overlap_splits[ray + 1]); ++k) {
        const double in = rows.overlap_t_in[k], out = rows.overlap_t_out[k];
        const auto first = static_cast<std::size_t>(rows.overlap_region_splits[k]),
                   end = static_cast<std::size_t>(rows.overlap_region_splits[k + 1]);
        for (std::size_t a = first; a < end; ++a) {
            for (std::size_t b = a + 1; b < end; ++b) {
                const auto at = numbers.find(static_cast<std::uint64_t>(rows.overlap_region_ids[a]) << 32 |
                                             static_cast<std::uint64_t>(rows.overlap_region_ids[b]));
                if (at == numbers.end()) continue;
                const auto before =
                    in == last ? std::ranges::find_if(
                                     parts, [&](const SharedPart& p) { return p.pair == at->second && p.out == in; })
                               : parts.end();
                if (before == parts.end())
                    parts.push_back({at->second, in, out});
                else
                    before->out = out;
            }
        }
        last = out;
    }
}

/// The longest part of some traced rays that a pair shares. Adds the lengths of all parts to `sum`.
RayPart OverlapSearch::longest_part(std::size_t pair, std::size_t first, std::size_t end, double& sum) const {
    const auto first_region = static_cast<std::int32_t>(pairs[pair].first),
               second_region = static_cast<std::int32_t>(pairs[pair].second);
    RayPart longest;
    for (std::size_t ray = first; ray < end; ++ray) {
        RayPart part;
        for (auto k = static_cast<std::size_t>(rows.overlap_splits[ray]);
             k < static_cast<std::size_t>(rows.overlap_splits[ray + 1]); ++k) {
            const std::span claimants(rows.overlap_region_ids.data() + rows.overlap_region_splits[k],
                                      rows.overlap_region_ids.data() + rows.overlap_region_splits[k + 1]);
            if (!std::ranges::binary_search(claimants, first_region) ||
                !std::ranges::binary_search(claimants, second_region))
                continue;
            const double in = rows.overlap_t_in[k], out = rows.overlap_t_out[k];
            sum += out - in;
            part = {rays[ray], part.length() > 0 && part.out == in ? part.in : in, out};
            if (part.length() > longest.length()) longest = part;
        }
    }
    return longest;
}

/// Takes from the traced rays what they show of any pair.
void OverlapSearch::take_sights() {
    struct Sight {
        std::size_t ray;
        SharedPart part;
    };
    std::vector<std::vector<Sight>> all((rays.size() + rays_in_a_row - 1) / rays_in_a_row);
    for_chunks(rays.size(), rays_in_a_row, threads, [&](std::size_t first, std::size_t end, std::size_t chunk) {
        std::vector<SharedPart> parts;
        for (std::size_t ray = first; ray < end; ++ray) {
            shared_parts(ray, parts);
            for (const SharedPart& shared : parts) all[chunk].push_back({ray, shared});
        }
    });
    for (const auto& sights : all) {
        for (const auto& [ray, shared] : sights) {
            Pair& pair = pairs[shared.pair];
            const auto& [origin, d] = rays[ray];
            include(pair.seen, origin + shared.in * d);
            include(pair.seen, origin + shared.out * d);
            if (pair.is_found && shared.out - shared.in <= pair.chord.length()) continue;
            pair.is_found = true;
            pair.chord = {rays[ray], shared.in, shared.out};
        }
    }
}

void OverlapSearch::shoot_model() {
    Box box = no_box;
    for (const Pair& pair : pairs)
        if (!is_shallow(pair)) include(box, pair.box);
    if (!has_inside(box)) return;
    for (std::uint64_t view = 0; view < views; ++view) {
        Random random{request.seed, 0, view};
        drop_rays();
        const std::array<Grid, 3> grids = grids_of(box, rays_of_model, random);
        for (const Grid& grid : grids) add_rays(grid);
        trace();
        take_sights();
        for (const Grid& grid : grids)
            for (Pair& pair : pairs)
                if (!is_shallow(pair)) exclude(pair, grid.diagonal());
    }
}

/// Measures the pairs that are found: volumes, the longest parts, and the largest ball that may be there.
void OverlapSearch::measure(std::span<const std::size_t> which, double rays_of_grid) {
    struct Job {
        std::size_t pair;
        std::uint32_t replicate;
        double by;               ///< mm²: of a ray
        double diagonal;         ///< mm², squared
        std::size_t first, end;  ///< rays
    };
    std::vector<Job> jobs;
    const auto flush = [&] {
        if (rays.empty()) return;
        trace();
        std::vector<double> sums(jobs.size());
        std::vector<RayPart> longest(jobs.size());
        for_chunks(jobs.size(), 8, threads, [&](std::size_t i, std::size_t last, std::size_t) {
            for (; i < last; ++i) longest[i] = longest_part(jobs[i].pair, jobs[i].first, jobs[i].end, sums[i]);
        });
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            Pair& pair = pairs[jobs[i].pair];
            pair.volumes[jobs[i].replicate] += jobs[i].by * sums[i];
            if (longest[i].length() > 0) pair.chords.push_back(longest[i]);
            pair.at_most = std::min(pair.at_most, ball_at_most(longest[i].length(), jobs[i].diagonal));
        }
        take_sights();
        drop_rays();
        jobs.clear();
    };
    drop_rays();
    for (const std::size_t i : which) {
        pairs[i].volumes = {};
        pairs[i].chords.clear();
        for (std::uint32_t replicate = 0; replicate < least_batches; ++replicate) {
            Random random{request.seed,    2,         pairs[i].first,
                          pairs[i].second, replicate, static_cast<std::uint64_t>(rays_of_grid)};
            for (const Grid& grid : grids_of(pairs[i].box, rays_of_grid, random)) {
                const std::size_t first = rays.size();
                add_rays(grid);
                jobs.push_back({i, replicate, grid.cell / 3, grid.diagonal(), first, rays.size()});
            }
        }
        if (rays.size() >= rays_at_once) flush();
    }
    flush();
}

CheckResult OverlapSearch::result(bool is_complete, bool is_last) const {
    CheckResult result{.unbounded = unbounded,
                       .candidates = pairs.size(),
                       .rays = traced,
                       .rays_to_come = to_come,
                       .is_complete = is_complete};
    result.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    std::vector<bool> is_used(request.allowed.size());
    for (const Pair& pair : pairs) {
        const bool may_be_deep = !is_complete || (request.certain > 0 && pair.at_most >= request.certain);
        if (pair.is_found && !is_deep(pair)) ++result.shallow;
        if (!pair.is_found || !(is_deep(pair) || may_be_deep)) {
            if (is_last) result.unlisted.push_back({{pair.first, pair.second}, pair.is_found, pair.at_most});
            continue;
        }
        const bool has_ball = pair.through.length() > 0;
        const RayPart& shown = has_ball ? pair.through : pair.chord;
        FoundOverlap found{.regions = {pair.first, pair.second},
                           .place = has_ball ? pair.deepest().center : shown.middle(),
                           .depth = depth_of(pair),
                           .is_estimate = pair.is_estimate(),
                           .depth_at_most = pair.at_most,
                           .volume = estimate_of(pair.volumes),
                           .box = pair.seen,
                           .ray = shown.ray,
                           .t_in = shown.in,
                           .t_out = shown.out,
                           .is_near_limit = is_deep(pair) && depth_of(pair) < 2 * request.min_depth};
        for (std::size_t i = 0; i < request.allowed.size(); ++i) {
            if (!allows(request.allowed[i], pair)) continue;
            found.is_allowed = true;
            is_used[i] = true;
        }
        found.is_new = !found.is_allowed && found.depth >= request.min_depth;
        result.new_overlaps += found.is_new;
        result.overlaps.push_back(found);
    }
    for (std::size_t i = 0; i < is_used.size(); ++i)
        if (!is_used[i]) result.unused.push_back(request.allowed[i]);
    std::ranges::stable_sort(result.overlaps, std::greater{}, &FoundOverlap::depth);
    std::ranges::stable_sort(result.unlisted, std::greater{}, &UnlistedPair::depth_at_most);
    return result;
}

/// Whether a row allows a pair, in either order. A pattern fits a path, or the beginning of a path before a '/'.
bool OverlapSearch::allows(const AllowedOverlap& row, const Pair& pair) const {
    const auto fits = [this](const std::string& pattern, std::uint32_t region) {
        const std::string& path = model.regions()[region].path;
        return fnmatch(pattern.c_str(), path.c_str(), 0) == 0 ||
               fnmatch((pattern + (pattern.ends_with('/') ? "*" : "/*")).c_str(), path.c_str(), 0) == 0;
    };
    return (fits(row.first, pair.first) && fits(row.second, pair.second)) ||
           (fits(row.first, pair.second) && fits(row.second, pair.first));
}

/// Measures the pairs that were found since the last call.
void OverlapSearch::measure_found() {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i].is_found && !is_shallow(pairs[i]) && !std::exchange(pairs[i].is_measured, true))
            found.push_back(i);
    measure(found, rays_of_overlap);
    climb(found);
    std::vector<std::size_t> shallow;
    std::ranges::copy_if(found, std::back_inserter(shallow), [&](std::size_t i) {
        return pairs[i].is_estimate() && pairs[i].deepest().radius < request.min_depth;
    });
    measure(shallow, more_rays_of_overlap);
    climb(shallow);
    show(found);
}

CheckResult OverlapSearch::run(const CheckRequest& wanted, std::function<bool(const CheckResult&)> on_look) {
    request = wanted;
    look = std::move(on_look);
    traced = to_come = 0;
    began = looked = Clock::now();
    find_candidates();
    try {
        look_at_solids();
        refuse_what_is_too_fine();
        shoot_model();
        search_cells();
        measure_found();
        if (request.certain > 0) {
            make_certain();
            measure_found();
        }
    } catch (const Error& error) {
        if (error.status() != Status::interrupted) throw;
        return result(false);
    }
    return result(true);
}

}  // namespace analysis

struct Checker::Impl : analysis::OverlapSearch {
    using OverlapSearch::OverlapSearch;
};

Checker::Checker(Model model, const Settings& settings) : impl_(std::make_unique<Impl>(std::move(model), settings)) {}
Checker::~Checker() = default;
Checker::Checker(Checker&&) noexcept = default;
Checker& Checker::operator=(Checker&&) noexcept = default;

const Renderer& Checker::renderer() const { return impl_->renderer; }

CheckResult Checker::check(const CheckRequest& request, const std::function<bool(const CheckResult&)>& look) {
    const FloatingPoint state;
    const auto refuse = [](const std::string& text) { throw Error(Status::usage, text); };
    if (!(request.min_depth > 0 && std::isfinite(request.min_depth)))
        refuse("the least depth of overlaps must be greater than 0 mm");
    if (!(request.effort > 0 && request.effort <= CheckRequest::most_effort))
        refuse("the effort of a check must be greater than 0 and at most " +
               std::to_string(static_cast<int>(CheckRequest::most_effort)));
    if (request.certain != 0 && !(request.certain >= request.min_depth && std::isfinite(request.certain)))
        refuse("the diameter that is certain to be found must be 0 or at least the least depth of overlaps");
    return impl_->run(request, state.of_host(look));
}

}  // namespace csgrt
