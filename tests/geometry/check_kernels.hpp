// The kernels' answers for one kind of solid before the oracle.
#pragma once

#include "catch.hpp"

#include "oracle/campaign.hpp"
#include "sanitized.hpp"

namespace csgrt {

/// `rays` rays in equal parts of the seven families; 42 at each solid.
void check_kernels(oracle::Kind kind, std::size_t rays, std::uint64_t seed);

// The sanitizers look at what is run, not at how often.
#ifdef CSGRT_SANITIZED
inline constexpr std::size_t short_run = 4'000;
#else
inline constexpr std::size_t short_run = 20'000;
#endif
inline constexpr std::size_t long_run = 1'000'000;

}  // namespace csgrt
