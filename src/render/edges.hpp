// Edges of pictures: where the region, the surface's direction or its depth changes from pixel to pixel.
#pragma once

#include <csgrt/image.hpp>

#include "compile/frame.hpp"

namespace csgrt {

/// The channels that edges are found in.
inline constexpr std::uint32_t edge_channels = channel::distance | channel::normal | channel::ids;

/// Makes the pixels of edges black in the channels R, G, B and RGBA8 of `picture`. Two neighbours in a row or a column
/// have an edge between them if their regions differ, if their normals are more than 30 degrees apart, or if each lies
/// two pixels' width or more off the other's tangent plane. The nearer of the two pixels is the edge. `surfaces`: a
/// picture of the same frame with the edge_channels, or `picture` itself.
void draw_edges(const PreparedFrame& prepared, const Image& surfaces, Image& picture);

}  // namespace csgrt
