// Descriptions of the request of a check and of its answer. The sentences are in the C++ header, too
// (tests/form/requests_test.cpp).
#pragma once

#include <csgrt/check.hpp>

#include "form/answers.hpp"

namespace csgrt::form {

static_assert(CheckRequest::most_effort == 1000, "two texts below say so");
template <>
inline constexpr auto of<CheckRequest> = Form{
    plain("check_request"),
    optional("min_depth", &CheckRequest::min_depth, number, positive(),
             "Millimetres: the diameter of the largest ball in an overlap from which on it counts.",
             {.concern = Concern::work,
              .name = "--min-depth",
              .value = "MM",
              .absent = "0.01",
              .expected = "a length in millimetres greater than 0"}),
    optional("certain", &CheckRequest::certain, number, not_negative(),
             "Millimetres, at least `min_depth`: each pair whose overlap holds a ball of this diameter is listed.",
             {.concern = Concern::work,
              .name = "--certain",
              .value = "MM",
              .absent = "no such promise",
              .expected = "a length in millimetres, 0 or more"}),
    optional("effort", &CheckRequest::effort, number,
             Bounds{0, CheckRequest::most_effort, false, true, "", "must be greater than 0 and at most 1000"},
             "How many times the usual number of cells of a candidate are searched.",
             {.concern = Concern::work,
              .name = "--effort",
              .value = "X",
              .absent = "1",
              .expected = "a number greater than 0, at most 1000"}),
    optional("seed", &CheckRequest::seed, amount, "Seed of the random numbers.",
             {.concern = Concern::work, .name = "--seed", .value = "N", .absent = "1"}),
    optional("allowed", &CheckRequest::allowed, special, "Pairs of regions whose overlaps are allowed."),
};

template <>
inline constexpr auto of<FoundOverlap> = Form{
    plain("found_overlap"),
    required("regions", &FoundOverlap::regions, List{count, 2, 2},
             "Indices of the regions, ascending: the first one owns it."),
    required("place", &FoundOverlap::place, vector,
             "Millimetres: the centre of the largest ball that was found in it."),
    required("depth", &FoundOverlap::depth, number,
             "Millimetres: the diameter of the largest ball that was found in it."),
    required("is_estimate", &FoundOverlap::is_estimate, flag,
             "Whether the ball was only measured along rays, and may be too large. Else it lies in the overlap, by the "
             "distances from the surfaces of the regions' solids."),
    required("depth_at_most", &FoundOverlap::depth_at_most, number,
             "Millimetres: no ball in it has a larger diameter."),
    required("volume", &FoundOverlap::volume, object<Estimate>, "In mm^3."),
    required("box", &FoundOverlap::box, box, "Millimetres: of the parts of rays that both claim."),
    required("ray", &FoundOverlap::ray, object<Ray>, "The ray, through the place, that shows it."),
    required("t_in", &FoundOverlap::t_in, number, "Where the ray goes in and out: millimetres along it."),
    required("t_out", &FoundOverlap::t_out, number),
    required("is_allowed", &FoundOverlap::is_allowed, flag, "Whether a row of the request's list allows it."),
    required("is_near_limit", &FoundOverlap::is_near_limit, flag,
             "Whether it is between half of the least depth and twice the least depth: another seed may decide "
             "otherwise."),
    required("is_new", &FoundOverlap::is_new, flag, "Whether it is not allowed, and at least the least depth deep."),
};

template <>
inline constexpr auto of<UnlistedPair> = Form{
    plain("unlisted_pair"),
    required("regions", &UnlistedPair::regions, List{count, 2, 2}, "Indices of the regions, ascending."),
    required("is_seen", &UnlistedPair::is_seen, flag, "Whether the two were found to overlap."),
    required("depth_at_most", &UnlistedPair::depth_at_most, number,
             "Millimetres: no ball in an overlap of the two has a larger diameter."),
};

template <>
inline constexpr auto of<CheckResult> = Form{
    plain("check_result"),
    required(
        "overlaps", &CheckResult::overlaps, listed,
        "At least half of the least depth deep, the deepest first. With CheckRequest::certain, less deep ones, too, "
        "if their `depth_at_most` is not below it."),
    required("unlisted", &CheckResult::unlisted, listed, "All other candidates, the largest `depth_at_most` first."),
    required("unused", &CheckResult::unused, listed, "Rows of the request's list that no overlap needs."),
    required("unbounded", &CheckResult::unbounded, listed,
             "Indices of regions without an end. Only their parts within the box of all others were searched."),
    required("new_overlaps", &CheckResult::new_overlaps, amount, "Number of overlaps that are new."),
    required("candidates", &CheckResult::candidates, amount, "Number of pairs of regions whose boxes overlap."),
    required("shallow", &CheckResult::shallow, amount,
             "Number of pairs that overlap by less than half of the least depth."),
    required("rays", &CheckResult::rays, amount, "Number of rays that were traced in all."),
    required("is_complete", &CheckResult::is_complete, flag,
             "False: the caller has ended the check. Depths that are not known then are 0."),
    required("seconds", &CheckResult::seconds, number, "Seconds that the call took."),
};

}  // namespace csgrt::form
