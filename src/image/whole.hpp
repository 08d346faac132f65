// Whether a picture that OpenImageIO has written is all there: where memory ends, it may leave one unfinished and say
// nothing.
#pragma once

#include <span>
#include <string>

namespace csgrt {

/// `format` is "exr" (compressed as zip) or "png". True if every row stands where the file's own table says (EXR), or
/// its pieces follow each other to the last (PNG). What stands in the rows is not decoded.
bool is_whole(std::span<const unsigned char> file, const std::string& format, int height);

}  // namespace csgrt
