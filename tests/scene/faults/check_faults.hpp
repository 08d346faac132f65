// What is said of one solid.
#pragma once

#include "catch.hpp"

#include <limits>

#include "scene/faults/solids.hpp"

namespace csgrt {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// Sound, and closed.
inline Bot tetrahedron() {
    return {.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}},
            .faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

inline void check_sound(const Shape& shape) {
    const auto faults = solid_faults(shape);
    INFO((faults.empty() ? std::string() : faults[0]));
    CHECK(faults.empty());
}

inline void check_fault(const Shape& shape, const std::string& part_of_message, std::size_t count = 1) {
    const auto faults = solid_faults(shape);
    INFO(part_of_message);
    REQUIRE(faults.size() == count);
    INFO(faults[0]);
    CHECK(faults[0].find(part_of_message) != std::string::npos);
}

}  // namespace csgrt
