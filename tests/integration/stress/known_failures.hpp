// What goes wrong in the stress suite at the default settings today: no more than this may. What gets better stays
// within its bounds; tighten them then.
#pragma once

#include <array>
#include <string>

#include "integration/stress/speckles.hpp"

namespace csgrt::test {

/// In parts of a family's scenes; whatever is not named is 0.
struct Bounds {
    const char* family = "";
    std::size_t wrong = 0;
    std::array<std::size_t, changes.size()> disagreements{};  ///< in the order of `changes`
};

/// Nothing.
inline constexpr Bounds sample_bounds[] = {{}};
inline constexpr Bounds long_bounds[] = {{}};

}  // namespace csgrt::test
