// Search for overlaps: pairs of regions, and the rays that are traced for them. checker.cpp has the candidates and what
// rays show, overlap_solids.cpp what distances to solids tell, overlap_cells.cpp the search by rays, overlap_depth.cpp
// depths along rays, overlap_certainty.cpp the balls that are excluded for certain.
#pragma once

#include <csgrt/check.hpp>

#include <array>
#include <chrono>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>

#include "analysis/boxes.hpp"
#include "analysis/estimates.hpp"
#include "analysis/frame.hpp"
#include "analysis/inscribed_ball.hpp"
#include "compile/bounds/distance_bounds.hpp"

namespace csgrt::analysis {

using Clock = std::chrono::steady_clock;

inline constexpr std::size_t rays_at_once = 1u << 18;
inline constexpr std::size_t climbs_of_pair = 2;  ///< from the deepest of the starting points
inline constexpr double near_enough = 0.9;        ///< the share of a depth along rays at which one by solids is taken
inline constexpr double settled = 0.97;           ///< the share of its bound at which a depth is good enough
inline constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Part of a ray that both regions of a pair claim.
struct SharedPart {
    std::size_t pair = 0;
    double in = 0, out = 0;
};

/// A part, and its ray, whose direction is a unit vector.
struct RayPart {
    Ray ray = {};
    double in = 0, out = 0;

    double length() const { return out - in; }
    Vec3 middle() const { return ray.origin + 0.5 * (in + out) * ray.direction; }
};

struct Pair {
    std::uint32_t first = 0, second = 0;
    Box box = {};        ///< of both regions' boxes
    double at_most = 0;  ///< mm: the diameter of a ball in the overlap
    bool is_found = false, is_measured = false;
    Box seen = no_box;
    RayPart chord = {};        ///< the longest one
    RayPart through = {};      ///< the longest one of some through the deepest point
    bool is_searched = false;  ///< by solids, as finely as the least depth needs
    std::array<double, least_batches> volumes = {};
    Ball ball = {};                    ///< the largest one that was found along rays
    Ball sure = {};                    ///< the largest one that lies in the overlap, by the regions' solids
    std::vector<RayPart> chords = {};  ///< the longest one of each grid

    /// Whether a ball that is a good deal larger than the sure one was found along rays.
    bool is_estimate() const { return sure.radius < near_enough * ball.radius || sure.radius == 0; }
    const Ball& deepest() const { return is_estimate() ? ball : sure; }
    /// Whether more rays can make little of the depth and its bound.
    bool is_settled() const { return 2 * sure.radius >= settled * at_most; }
};

struct Cell;   // of a pair's common box
struct Climb;  // to the deepest point of an overlap
struct Line;   // through a point of an overlap
class OverlapDepth;

struct OverlapSearch {
    OverlapSearch(Model m, const Settings& settings)
        : renderer(m, settings),
          model(std::move(m)),
          threads(settings.threads),
          rounding(100 * rounding_tolerance(settings.precision)) {}

    Renderer renderer;
    Model model;
    unsigned threads;
    std::optional<DistanceBounds> bounds;  ///< of the solids; made for the first depth
    double rounding;                       ///< of a boundary, relative to the size of the model, at most

    CheckRequest request;
    std::vector<Pair> pairs;                                 ///< candidates
    std::unordered_map<std::uint64_t, std::size_t> numbers;  ///< of the candidates, by their regions
    std::vector<std::uint32_t> unbounded;                    ///< regions
    std::function<bool(const CheckResult&)> look;
    std::uint64_t traced = 0, to_come = 0;  ///< rays
    double shortest = 0;                    ///< mm: rays show each longer part that two regions share
    Clock::time_point began, looked;

    // Rays that are traced at once, and their answer.
    std::vector<Ray> rays;
    std::vector<RayRange> ranges;
    Partitions rows;

    void find_candidates();
    void add_ray(const Vec3& origin, const Vec3& direction, const RayRange& range) {
        rays.push_back({origin, direction});
        ranges.push_back(range);
    }
    void add_rays(const Grid& grid) {
        for (std::uint64_t i = 0; i < grid.size(); ++i)
            if (const Ray ray = grid.ray(i); grid.meets(ray)) add_ray(ray.origin, ray.direction, {0, grid.length});
    }
    void drop_rays() {
        rays.clear();
        ranges.clear();
    }
    void tell();
    void trace();
    void shared_parts(std::size_t ray, std::vector<SharedPart>& parts) const;
    RayPart longest_part(std::size_t pair, std::size_t first, std::size_t end, double& sum) const;
    void take_sights();
    void shoot_model();
    void look_at(Cell& cell, std::size_t first_ray) const;
    /// Whether a part was found that is as long as a ball of the least depth would show.
    bool is_seen(const Pair& pair) const { return pair.is_found && pair.chord.length() >= request.min_depth; }
    /// Whether a search by cells has nothing to add.
    bool is_done(const Pair& pair) const { return is_seen(pair) || is_shallow(pair); }
    /// Whether no ball of half of the least depth is in the overlap.
    bool is_shallow(const Pair& pair) const { return pair.at_most < 0.5 * request.min_depth; }
    double depth_of(const Pair& pair) const { return std::min(2 * pair.deepest().radius, pair.at_most); }
    bool is_deep(const Pair& pair) const { return depth_of(pair) >= 0.5 * request.min_depth; }
    /// The diameter of the largest ball in an overlap, at most, of which a complete grid of parallel rays shows no
    /// longer part. `diagonal`: mm², of a cell of the grid, squared.
    double ball_at_most(double longest, double diagonal) const {
        return std::sqrt((longest + shortest) * (longest + shortest) + diagonal);
    }
    /// Takes from a complete grid of rays through a pair's common box that the pair is not found by it.
    void exclude(Pair& pair, double diagonal) const {
        if (!pair.is_found) pair.at_most = std::min(pair.at_most, ball_at_most(0, diagonal));
    }
    void exclude_by_cells(Pair& pair, const Box& cell) const;
    void search_cells();
    void measure(std::span<const std::size_t> which, double rays_of_grid);
    std::vector<Vec3> starts_of(std::size_t number) const;
    void shoot_lines(std::vector<Climb>& climbs, std::uint64_t round, bool beside,
                     const std::function<void(Climb&, std::vector<Line>&)>& take);
    void climb(std::span<const std::size_t> which);
    bool is_open(const Pair& pair, double diameter) const { return !is_deep(pair) && pair.at_most >= diameter; }
    double rays_for(double diameter) const;
    void refuse_what_is_too_fine() const;
    void make_certain();
    void measure_found();
    void for_overlaps(std::span<const std::size_t> which, const std::function<void(std::size_t, OverlapDepth&)>& work);
    void bound(Pair& pair, OverlapDepth& depth, const Ball& near) const;
    void search_by_solids(std::size_t number, OverlapDepth& depth, double diameter, std::size_t most_cells,
                          std::size_t promising_cells);
    void look_at_solids();
    void climb_by_solids(std::span<const std::size_t> which);
    void climb_by_rays(std::span<const std::size_t> which);
    void show(std::span<const std::size_t> which);
    bool allows(const AllowedOverlap& row, const Pair& pair) const;
    CheckResult result(bool is_complete, bool is_last = true) const;
    CheckResult run(const CheckRequest& wanted, std::function<bool(const CheckResult&)> on_look);
};

}  // namespace csgrt::analysis
