// Arb form: decides whether an arb is compiled as an intersection of half-spaces or as the surface of its faces.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <csgrt/solids.hpp>

namespace csgrt {

/// The vertices of the six faces, in BRL-CAD's order.
inline constexpr std::array<std::array<std::uint32_t, 4>, 6> arb_face_vertices{
    {{3, 2, 1, 0}, {4, 5, 6, 7}, {4, 7, 3, 0}, {2, 6, 5, 1}, {1, 5, 4, 0}, {7, 6, 2, 3}}};

/// Whether the arb's faces are flat and the arb is concave, with vertices on both sides of a face. A face is flat if
/// its vertices are within 0.0005 mm (BRL-CAD's tolerance) and within 1e-6 of the arb's size from its plane. A vertex
/// is on a side of a plane only if rounding cannot have put it there. An arb with a face that is not flat does not
/// count as concave: it is an intersection of half-spaces. Numbers must be finite.
bool is_concave(const Arb& arb);

/// The face of a concave arb that crosses itself: an index into arb_face_vertices.
std::optional<std::size_t> crossing_face(const Arb& arb);

/// Whether the arb's faces are flat and enclose nothing because they lie on one another, for example because vertices
/// are repeated across the arb. Numbers must be finite.
bool is_without_volume(const Arb& arb);

/// The outlines of the arb's faces, as indices of vertices. Equal vertices have the index of the first of them. Faces
/// with fewer than three different vertices are left out.
std::vector<std::vector<std::uint32_t>> outlines_of(const Arb& arb);

}  // namespace csgrt
