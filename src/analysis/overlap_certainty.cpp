// Certainty: complete grids of parallel rays across the common boxes of pairs, so fine that no overlap that holds a
// ball of the wanted diameter is missed. docs/analysis.md has the proof.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "analysis/overlap_search.hpp"
#include "base/parallel.hpp"

namespace csgrt::analysis {

namespace {

// A grid's spacing times the root of 2, and the part of a ray in a ball that the grid shows at least, both relative to
// the ball's diameter: their squares sum to 1.
constexpr double of_diagonal = 0.9, of_part = 0.43;

constexpr std::size_t most_cells_of_certainty = 1u << 16;  ///< of a level, in a search by solids
constexpr std::size_t rays_of_piece = 4096;                ///< that one thread reads in a row

/// A grid along the longest axis of a box. Its cells fill the box's section, with one ray each, all at one place in
/// them: they are those rays of an endless lattice that meet the box.
struct GridAcross {
    GridAcross(const Box& of, double diameter) : box(of) {
        for (std::size_t k = 1; k < 3; ++k)
            if (size().*axes[k] > size().*axes[longest]) longest = k;
        for (std::size_t k = 0; k < 2; ++k)
            counts[k] = std::max(1.0, std::ceil(size().*side(k) * std::sqrt(2.0) / (of_diagonal * diameter)));
    }

    Vec3 size() const { return box.high - box.low; }
    double Vec3::*side(std::size_t k) const { return axes[(longest + 1 + k) % 3]; }
    double spacing(std::size_t k) const { return size().*side(k) / counts[k]; }
    double rays() const { return counts[0] * counts[1]; }
    double diagonal() const { return spacing(0) * spacing(0) + spacing(1) * spacing(1); }  ///< mm², squared

    Box box;
    std::size_t longest = 0;
    double counts[2] = {};
};

}  // namespace

/// The rays of the grids that exclude balls of a diameter in all pairs in which they may be.
double OverlapSearch::rays_for(double diameter) const {
    double sum = 0;
    for (const Pair& pair : pairs)
        if (is_open(pair, diameter)) sum += GridAcross(pair.box, diameter).rays();
    return sum;
}

void OverlapSearch::refuse_what_is_too_fine() const {
    if (request.certain == 0 || pairs.empty()) return;
    const auto refuse = [](const char* format, auto... values) {
        char text[200];
        std::snprintf(text, sizeof text, format, values...);
        throw Error(Status::usage, text);
    };
    const double needed = rays_for(request.certain);
    if (needed == 0) return;
    if (shortest > of_part * request.certain)
        refuse(
            "no overlap of %g mm is certain to be found: parts of rays up to %.3g mm may not be seen, so at least "
            "%.3g mm must be asked for",
            request.certain, shortest, 1.01 * shortest / of_part);
    constexpr auto most = static_cast<double>(CheckRequest::most_rays);
    if (needed <= most) return;
    double possible = request.certain;
    while (rays_for(possible) > most) possible *= 1.05;
    refuse("to be certain of %g mm may need %.2g rays, and %.2g are the most: %.3g mm is possible", request.certain,
           needed, most, 1.01 * possible);
}

/// Traces grids through the pairs that may hold a ball of the wanted diameter and are not found to be deep. A pair that
/// is found to be deep on the way needs no more of them.
void OverlapSearch::make_certain() {
    struct Job {
        std::size_t pair;
        double diagonal;  ///< mm², squared
        double longest = 0;
        bool is_whole = false;
    };
    struct Piece {
        std::size_t job, first, end;  ///< rays
        double longest = 0;
    };
    std::vector<Job> jobs;
    std::vector<Piece> pieces;
    const auto flush = [&] {
        trace();
        to_come -= rays.size();
        for_chunks(pieces.size(), 1, threads, [&](std::size_t i, std::size_t, std::size_t) {
            double sum = 0;
            pieces[i].longest = longest_part(jobs[pieces[i].job].pair, pieces[i].first, pieces[i].end, sum).length();
        });
        take_sights();
        for (const Piece& piece : pieces) jobs[piece.job].longest = std::max(jobs[piece.job].longest, piece.longest);
        for (const Job& job : jobs)
            if (double& at_most = pairs[job.pair].at_most; job.is_whole)
                at_most = std::min(at_most, ball_at_most(job.longest, job.diagonal));
        drop_rays();
        pieces.clear();
    };
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (is_open(pairs[i], request.certain)) open.push_back(i);
    for_overlaps(open, [this](std::size_t i, OverlapDepth& depth) {
        search_by_solids(i, depth, request.certain, most_cells_of_certainty, 0);
    });
    drop_rays();
    to_come = static_cast<std::uint64_t>(rays_for(request.certain));
    tell();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Pair& pair = pairs[i];
        if (!is_open(pair, request.certain)) continue;
        const GridAcross grid(pair.box, request.certain);
        Random random{request.seed, 4, pair.first, pair.second};
        const double shifts[] = {random.next(), random.next()};
        const auto columns = static_cast<std::uint64_t>(grid.counts[0]), all = static_cast<std::uint64_t>(grid.rays());
        double Vec3::*const d = axes[grid.longest], Vec3::*const u = grid.side(0), Vec3::*const v = grid.side(1);
        jobs.push_back({i, grid.diagonal()});
        std::uint64_t k = 0;
        while (k < all && (pair.is_measured || !is_seen(pair))) {
            const auto count = std::min<std::uint64_t>({rays_of_piece, all - k, rays_at_once - rays.size()});
            pieces.push_back({jobs.size() - 1, rays.size(), rays.size() + count});
            for (const std::uint64_t end = k + count; k < end; ++k) {
                Ray ray{grid.box.low, {}};
                ray.direction.*d = 1;
                ray.origin.*u += (static_cast<double>(k % columns) + shifts[0]) * grid.spacing(0);
                ray.origin.*v += (static_cast<double>(k / columns) + shifts[1]) * grid.spacing(1);
                add_ray(ray.origin, ray.direction, {0, grid.size().*d});
            }
            jobs.back().is_whole = k == all;
            if (rays.size() == rays_at_once) flush();
        }
        to_come -= all - k;
    }
    flush();
}

}  // namespace csgrt::analysis
