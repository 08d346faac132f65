// Wholeness: whether a picture that OpenImageIO has written is complete. If memory runs out, it may leave a picture
// unfinished without an error.
#pragma once

#include <span>
#include <string>

namespace csgrt {

/// Whether a file is complete. `format` is "exr" (compressed as zip) or "png". True if every row stands where the
/// file's own table says (EXR), or its chunks follow each other to the last (PNG). The contents of the rows are not
/// decoded.
bool is_whole(std::span<const unsigned char> file, const std::string& format, int height);

}  // namespace csgrt
