// Triangulation of flat faces with holes, by cutting off ears (Meisters 1975; holes by bridges, Eberly 2002).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <csgrt/solids.hpp>

namespace csgrt {

/// Appends triangles that cover a face, whose largest loop is its outline and whose others are holes. The triangles
/// have only the loops' corners, and every edge of the loops once, so faces that share edges always stay joined. A face
/// that is not flat is cut as it is seen along its mean normal. A face that crosses itself in this view is covered by
/// parity.
void triangulate(const std::vector<Vec3>& vertices, const std::vector<std::vector<std::uint32_t>>& loops,
                 std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace csgrt
