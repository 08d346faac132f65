// Edges of pictures: where the region, the surface's direction or its depth changes from pixel to pixel.
#pragma once

#include <csgrt/image.hpp>

#include "compile/frame.hpp"

namespace csgrt {

/// The channels that edges are found in.
inline constexpr std::uint32_t edge_channels = channel::distance | channel::normal | channel::ids;

/// Makes the pixels of edges (kernels/shading/edge.h) black in the channels R, G, B and RGBA8 of `picture`. `surfaces`:
/// a picture of the same frame with the edge_channels, or `picture` itself.
void draw_edges(const PreparedFrame& prepared, const Image& surfaces, Image& picture);

}  // namespace csgrt
