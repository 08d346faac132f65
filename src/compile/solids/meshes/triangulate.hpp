// Flat faces with holes -> triangles, by cutting off ears (Meisters 1975; holes by bridges, Eberly 2002).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <csgrt/solids.hpp>

namespace csgrt {

/// Appends triangles that cover a face, whose largest loop is its outline and whose others are holes. They have the
/// loops' corners only, and every edge of the loops once: faces that share edges stay joined, whatever happens.
/// A face that is not flat is cut as it is seen along its mean normal. One that crosses itself there is covered by
/// parity.
void triangulate(const std::vector<Vec3>& vertices, const std::vector<std::vector<std::uint32_t>>& loops,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace csgrt
