// Description of the request of a check. The sentences are in the C++ header, too (tests/form/requests_test.cpp).
#pragma once

#include <csgrt/check.hpp>

#include "form/form.hpp"

namespace csgrt::form {

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

}  // namespace csgrt::form
