// Arb form: is an arb the intersection of half-spaces, or must its faces be taken as a surface?
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

/// Whether its faces are flat, and it is not convex: it lies on both sides of one of them. A face is flat if its
/// vertices leave the plane by no more than the lesser of 0.0005 mm, BRL-CAD's tolerance, and 1e-6 of the arb's size. A
/// vertex lies on a side if rounding cannot have put it there. An arb with a face that is not flat is never concave: it
/// stays the intersection of half-spaces. For finite numbers.
bool is_concave(const Arb& arb);

/// The face of a concave arb that crosses itself: an index into arb_face_vertices.
std::optional<std::size_t> crossing_face(const Arb& arb);

/// Whether its faces are flat and enclose nothing: they lie on one another, for example because vertices are repeated
/// across the arb. For finite numbers.
bool is_without_volume(const Arb& arb);

/// The outlines of its faces, as numbers of vertices; of equal vertices the first. Faces of two vertices are left out.
std::vector<std::vector<std::uint32_t>> outlines_of(const Arb& arb);

}  // namespace csgrt
