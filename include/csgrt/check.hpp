// Check: pairs of regions that overlap, each with its place, its depth and a ray that shows it.
//
//     csgrt::Checker checker(csgrt::Model(scene));
//     for (const csgrt::FoundOverlap& o : checker.check({.min_depth = 0.1}).overlaps)
//         std::printf("%u %u: %g mm deep\n", o.regions[0], o.regions[1], o.depth);
//
// Two regions overlap where both claim a part of a ray and neither gives way by its rank (Overlap). Candidates are the
// pairs of one rank whose boxes overlap. Distances to their solids' surfaces tell in which cells of the common box the
// two have nothing in common, and how deep they overlap. Rays through the whole model, and through cells of what is
// left, find the overlaps of other solids, and measure the volumes. Random numbers are functions of the seed, and
// decisions have a fixed order: all devices and numbers of threads give the same bits.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <csgrt/measure.hpp>
#include <csgrt/model.hpp>
#include <csgrt/renderer.hpp>
#include <csgrt/settings.hpp>

namespace csgrt {

/// A pair of regions that may overlap, by patterns of their paths: * stands for any characters, and a path stands for
/// all regions below it, too. The order of the two does not matter.
struct AllowedOverlap {
    std::string first = {}, second = {};
    bool operator==(const AllowedOverlap&) const = default;
};

/// Reads a list of allowed overlaps: on each line two patterns of paths, separated by spaces or tabs; # begins a
/// comment. A pattern with spaces stands in quotation marks. Throws Error: file, scene (with the line).
CSGRT_API std::vector<AllowedOverlap> load_allowed_overlaps(const std::string& path);

/// What a check looks for.
struct CheckRequest {
    /// Millimetres: the diameter of the largest ball in an overlap from which on it counts.
    double min_depth = 0.01;
    /// Millimetres, at least `min_depth`: each pair whose overlap holds a ball of this diameter is listed. 0: no such
    /// promise.
    double certain = 0;
    /// How many times the usual number of cells of a candidate are searched.
    double effort = 1;
    /// Seed of the random numbers.
    std::uint64_t seed = 1;
    /// Pairs of regions whose overlaps are allowed.
    std::vector<AllowedOverlap> allowed = {};

    static constexpr double most_effort = 1000;
    static constexpr std::uint64_t most_rays = MeasureRequest::most_rays;  ///< for CheckRequest::certain
};

/// An overlap of two regions.
struct FoundOverlap {
    std::array<std::uint32_t, 2> regions = {};  ///< Indices of the regions, ascending: the first one owns it.
    Vec3 place = {};                            ///< Millimetres: the centre of the largest ball that was found in it.
    double depth = 0;                           ///< Millimetres: the diameter of the largest ball that was found in it.
    /// Whether the ball was only measured along rays, and may be too large. Else it lies in the overlap, by the
    /// distances from the surfaces of the regions' solids.
    bool is_estimate = true;
    double depth_at_most = 0;    ///< Millimetres: no ball in it has a larger diameter.
    Estimate volume = {};        ///< In mm^3.
    Box box = {};                ///< Millimetres: of the parts of rays that both claim.
    Ray ray = {};                ///< The ray, through the place, that shows it.
    double t_in = 0, t_out = 0;  ///< Where the ray goes in and out: millimetres along it.
    bool is_allowed = false;     ///< Whether a row of the request's list allows it.
    /// Whether it is between half of the least depth and twice the least depth: another seed may decide otherwise.
    bool is_near_limit = false;
    bool is_new = false;  ///< Whether it is not allowed, and at least the least depth deep.
};

/// A pair of regions whose boxes overlap, which is not among the overlaps that a check lists.
struct UnlistedPair {
    std::array<std::uint32_t, 2> regions = {};  ///< Indices of the regions, ascending.
    bool is_seen = false;                       ///< Whether the two were found to overlap.
    double depth_at_most = 0;  ///< Millimetres: no ball in an overlap of the two has a larger diameter.
};

/// The findings of a check.
struct CheckResult {
    /// At least half of the least depth deep, the deepest first. With CheckRequest::certain, less deep ones, too, if
    /// their `depth_at_most` is not below it.
    std::vector<FoundOverlap> overlaps = {};
    std::vector<UnlistedPair> unlisted = {};  ///< All other candidates, the largest `depth_at_most` first.
    std::vector<AllowedOverlap> unused = {};  ///< Rows of the request's list that no overlap needs.
    /// Indices of regions without an end. Only their parts within the box of all others were searched.
    std::vector<std::uint32_t> unbounded = {};
    std::uint64_t new_overlaps = 0;  ///< Number of overlaps that are new.
    std::uint64_t candidates = 0;    ///< Number of pairs of regions whose boxes overlap.
    std::uint64_t shallow = 0;       ///< Number of pairs that overlap by less than half of the least depth.
    std::uint64_t rays = 0;          ///< Number of rays that were traced in all.
    std::uint64_t rays_to_come = 0;  ///< Number still to trace for CheckRequest::certain, at most; before it begins 0.
    bool is_complete = true;         ///< False: the caller has ended the check. Depths that are not known then are 0.
    double seconds = 0;              ///< Seconds that the call took.
};

/// Searches a model for overlaps. Not copyable. One thread at a time.
class CSGRT_API Checker {
public:
    /// Throws as Renderer does.
    explicit Checker(Model model, const Settings& settings = {});
    ~Checker();
    Checker(Checker&&) noexcept;
    Checker& operator=(Checker&&) noexcept;

    /// Searches. Calls look(result so far), whose overlaps have no depths yet and which has nothing `unlisted`, between
    /// parts of the work, and before the first ray for CheckRequest::certain; if it returns false, or
    /// Settings::progress ends a call, the check ends with what it has. Throws Error: usage, out_of_memory,
    /// device_fault.
    CheckResult check(const CheckRequest& request = {}, const std::function<bool(const CheckResult&)>& look = {});

    /// The Renderer that traces, for its model, statistics and warnings. Valid as long as the Checker.
    const Renderer& renderer() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace csgrt
