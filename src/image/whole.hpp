// A check that OpenImageIO has written a complete EXR: if memory runs out, it may leave out rows or attributes without
// an error.
#pragma once

#include <span>

#include <csgrt/image.hpp>

namespace csgrt {

/// Whether the header has the picture's matrices and csgrt's own attributes, and each block of rows is where the file's
/// table of offsets says. `exr`: the file, compressed as zip. The rows are not decoded.
bool is_whole(std::span<const unsigned char> exr, const Image& image);

}  // namespace csgrt
