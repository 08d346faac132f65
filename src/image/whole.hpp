// Whether an EXR that OpenImageIO has written is all there: where memory ends, it may leave rows or attributes out and
// report nothing.
#pragma once

#include <span>

#include <csgrt/image.hpp>

namespace csgrt {

/// `exr`: the file, compressed as zip. True if the header has the picture's matrices and csgrt's own attributes, and
/// every row stands where the file's table of offsets says. What stands in the rows is not decoded.
bool is_whole(std::span<const unsigned char> exr, const Image& image);

}  // namespace csgrt
