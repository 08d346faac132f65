// Checks in steps: pairs of regions whose boxes overlap; rays through the whole model; cells in the common boxes of the
// pairs that these rays have not found; then depth and volume of what was found.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>

#include <fnmatch.h>

#include "analysis/overlap_search.hpp"
#include "base/floating_point.hpp"
#include "base/parallel.hpp"

namespace csgrt {

namespace analysis {

namespace {

constexpr std::size_t part = 1024;                                  ///< rays that one thread reads in a row
constexpr double rays_of_model = 20'000;                            ///< of a grid through the whole model
constexpr std::uint64_t views = 3;                                  ///< turned frames of rays through the whole model
constexpr double rays_of_overlap = 24, more_rays_of_overlap = 192;  ///< of a grid through a pair's common box
constexpr auto between_looks = std::chrono::milliseconds(200);

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
    std::vector<std::uint32_t> order(boxes.size()), open;
    std::iota(order.begin(), order.end(), 0);
    for (const std::uint32_t r : order) {
        if (is_finite(boxes[r])) continue;
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
                least_side(both) >= 0.5 * request.min_depth && has_inside(both))
                pairs.push_back({.first = std::min(r, other), .second = std::max(r, other), .box = both});
        open.push_back(r);
    }
    std::ranges::sort(pairs, {}, [](const Pair& p) { return std::pair(p.first, p.second); });
    for (std::size_t i = 0; i < pairs.size(); ++i) numbers[std::uint64_t{pairs[i].first} << 32 | pairs[i].second] = i;
}

void OverlapSearch::trace() {
    renderer.partitions(rays, rows, {.overlaps = true}, {.each = ranges});
    traced += rays.size();
    if (!look || Clock::now() - looked < between_looks) return;
    looked = Clock::now();
    if (!look(result(false))) throw Error(Status::interrupted, "interrupted");
}

/// The parts of a ray that two regions share. A part may be several overlaps, if a third region begins or ends in it.
void OverlapSearch::shared_parts(std::size_t ray, std::vector<SharedPart>& parts) const {
    parts.clear();
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
                const auto before = std::ranges::find_if(
                    parts, [&](const SharedPart& p) { return p.pair == at->second && p.out == in; });
                if (before == parts.end())
                    parts.push_back({at->second, in, out});
                else
                    before->out = out;
            }
        }
    }
}

/// Takes from the traced rays what they show of any pair.
void OverlapSearch::take_sights() {
    struct Sight {
        std::size_t ray;
        SharedPart part;
    };
    std::vector<std::vector<Sight>> all((rays.size() + part - 1) / part);
    for_chunks(rays.size(), part, threads, [&](std::size_t first, std::size_t end, std::size_t chunk) {
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
        if (!pair.is_shallow(request.min_depth)) include(box, pair.box);
    if (!has_inside(box)) return;
    for (std::uint64_t view = 0; view < views; ++view) {
        Random random{request.seed, 0, view};
        drop_rays();
        for (const Grid& grid : grids_of(box, rays_of_model, random)) add_rays(grid);
        trace();
        take_sights();
    }
}

/// Measures the pairs that are found: volumes, the longest parts, and the largest ball that may be there. A ball of
/// diameter D that lies in an overlap is met by a ray of a complete grid in a part of at least sqrt(D^2 - g^2), where g
/// is the diagonal of the grid's cells, since a ray passes within g / 2 of its centre.
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
            std::vector<SharedPart> parts;
            for (; i < last; ++i)
                for (std::size_t ray = jobs[i].first; ray < jobs[i].end; ++ray) {
                    shared_parts(ray, parts);
                    for (const SharedPart& shared : parts) {
                        if (shared.pair != jobs[i].pair) continue;
                        sums[i] += shared.out - shared.in;
                        if (shared.out - shared.in > longest[i].length())
                            longest[i] = {rays[ray], shared.in, shared.out};
                    }
                }
        });
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            Pair& pair = pairs[jobs[i].pair];
            pair.volumes[jobs[i].replicate] += jobs[i].by * sums[i];
            const double length = longest[i].length();
            if (length > 0) pair.chords.push_back(longest[i]);
            pair.at_most = std::min(pair.at_most, std::sqrt(length * length + jobs[i].diagonal));
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
                const double diagonal = dot(grid.right, grid.right) + dot(grid.up, grid.up);
                jobs.push_back({i, replicate, grid.cell / 3, diagonal, first, rays.size()});
            }
        }
        if (rays.size() >= rays_at_once) flush();
    }
    flush();
}

CheckResult OverlapSearch::result(bool is_complete) const {
    CheckResult result{.unbounded = unbounded, .candidates = pairs.size(), .rays = traced, .is_complete = is_complete};
    result.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    std::vector<bool> is_used(request.allowed.size());
    for (const Pair& pair : pairs) {
        if (!pair.is_found) continue;
        const Ball& ball = pair.deepest();
        const RayPart& shown = pair.shown.length() > 0 ? pair.shown : pair.chord;
        const double depth = std::min(2 * ball.radius, pair.at_most);
        const bool is_deep = depth >= 0.5 * request.min_depth;
        if (!is_deep) ++result.shallow;
        if (!is_deep && is_complete) continue;  // else the depth may be unknown yet
        FoundOverlap found{.regions = {pair.first, pair.second},
                           .place = ball.center,
                           .depth = depth,
                           .is_estimate = pair.is_estimate(),
                           .depth_at_most = pair.at_most,
                           .volume = estimate_of(pair.volumes),
                           .box = pair.seen,
                           .ray = shown.ray,
                           .t_in = shown.in,
                           .t_out = shown.out,
                           .is_near_limit = depth < 2 * request.min_depth};
        if (!is_deep) found.place = pair.chord.middle();
        for (std::size_t i = 0; i < request.allowed.size(); ++i) {
            if (!allows(request.allowed[i], pair)) continue;
            found.is_allowed = true;
            is_used[i] = true;
        }
        found.is_new = !found.is_allowed && depth >= request.min_depth;
        result.new_overlaps += found.is_new;
        result.overlaps.push_back(found);
    }
    for (std::size_t i = 0; i < is_used.size(); ++i)
        if (!is_used[i]) result.unused.push_back(request.allowed[i]);
    std::ranges::stable_sort(result.overlaps, std::greater{}, &FoundOverlap::depth);
    return result;
}

/// Whether a row allows a pair, in either order. A pattern fits a path, or the beginning of a path before a '/'.
bool OverlapSearch::allows(const AllowedOverlap& row, const Pair& pair) const {
    const auto fits = [this](const std::string& pattern, std::uint32_t region) {
        const std::string& path = model.regions()[region].path;
        return fnmatch(pattern.c_str(), path.c_str(), 0) == 0 ||
               fnmatch((pattern + "/*").c_str(), path.c_str(), 0) == 0;
    };
    return (fits(row.first, pair.first) && fits(row.second, pair.second)) ||
           (fits(row.first, pair.second) && fits(row.second, pair.first));
}

CheckResult OverlapSearch::run(const CheckRequest& wanted, std::function<bool(const CheckResult&)> on_look) {
    request = wanted;
    look = std::move(on_look);
    traced = 0;
    began = looked = Clock::now();
    const auto lap = [&](const char* n) {
        static double last = 0;
        double now = double(clock()) / 1e6;
        fprintf(stderr, "%s %.2f s, rays %zu\n", n, now - last, (size_t)traced);
        last = now;
    };
    lap("begin");
    find_candidates();
    lap("cand");
    try {
        look_at_solids();
        lap("solids");
        {
            size_t s = 0, f = 0, d = 0, u = 0;
            for (auto& p : pairs) {
                s += p.is_shallow(request.min_depth);
                f += p.is_found;
                d += is_done(p);
                if (!is_done(p) && getenv("V"))
                    fprintf(stderr, "%s %s found %d excluded %g at_most %g\n", model.regions()[p.first].path.c_str(),
                            model.regions()[p.second].path.c_str(), p.is_found, p.excluded, p.at_most);
            }
            fprintf(stderr, "pairs %zu shallow %zu found %zu done %zu\n", pairs.size(), s, f, d);
        }
        shoot_model();
        lap("model");
        search_cells();
        lap("cells");
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < pairs.size(); ++i)
            if (pairs[i].is_found && !pairs[i].is_shallow(request.min_depth)) found.push_back(i);
        measure(found, rays_of_overlap);
        lap("measure");
        climb(found);
        lap("climb");
        std::vector<std::size_t> shallow;
        std::ranges::copy_if(found, std::back_inserter(shallow), [&](std::size_t i) {
            return !pairs[i].is_settled() && pairs[i].deepest().radius < request.min_depth;
        });
        measure(shallow, more_rays_of_overlap);
        lap("measure2");
        climb(shallow);
        lap("climb2");
        show(found);
        lap("show");
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
        refuse("the effort of a check must be greater than 0 and at most 1000");
    return impl_->run(request, state.of_host(look));
}

}  // namespace csgrt
