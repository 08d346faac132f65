// Encoding: a picture as the bytes of a file.
#pragma once

#include <string>
#include <vector>

#include <csgrt/image.hpp>

namespace csgrt {

/// Encodes a picture. `format` is "exr" or "png". The same picture always gives the same bytes, because they have no
/// date and no machine's name. Calls progress(done fraction). Throws Error (usage) if the picture is not well formed,
/// Error (file) if it cannot be encoded, and Error (interrupted) if `progress` returns false. `name`: the picture's,
/// for errors.
std::vector<unsigned char> encode(const Image& image, const std::string& format, const std::string& name,
                                  const std::function<bool(double)>& progress = {});

}  // namespace csgrt
