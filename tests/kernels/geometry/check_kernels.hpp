// The kernels' answers for one kind of solid before the oracle.
#pragma once

#include "catch.hpp"

#include "oracle/campaign.hpp"
#include "sanitized.hpp"

namespace csgrt {

/// `rays` rays in equal parts of the seven families; 42 at each solid. `known`: how many of them may be wrong, because
/// docs/accuracy.md says so.
void check_kernels(oracle::Kind kind, std::size_t rays, std::uint64_t seed, std::size_t known = 0);

inline constexpr std::size_t short_run = test::tries(20'000);
inline constexpr std::size_t long_run = 1'000'000;

}  // namespace csgrt
