// Encoding: a picture as the bytes of a file.
#pragma once

#include <string>
#include <vector>

#include <csgrt/image.hpp>

namespace csgrt {

/// Encodes a picture. `format` is "exr" or "png". The same picture gives the same bytes: without a date or a machine's
/// name. Throws Error (usage) if the picture is not well formed (`name` says which), (file) if it cannot be encoded,
/// (interrupted) if `progress`, which is called with the done part, returns false.
std::vector<unsigned char> encode(const Image& image, const std::string& format, const std::string& name,
                                  const std::function<bool(double)>& progress = {});

}  // namespace csgrt
