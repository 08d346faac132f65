// Pictures: float channels by name. Writing them is a component of its own (csgrt::image), the core needs no image library.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <csgrt/error.hpp>

namespace csgrt {

/// Channels in the order R G B A Z N.X N.Y N.Z region solid depth partitions overlap, as far as the view wants them; each
/// width x height floats, row by row from the TOP left. Z is the distance along the ray in millimetres (infinity: nothing hit),
/// region and solid are index + 1 (0: nothing), depth the number of segments on the ray.
struct Image {
    int width = 0, height = 0;
    std::vector<std::string> names;
    std::vector<std::vector<float>> channels;
    std::map<std::string, std::string> attributes;          ///< text for the header
    std::map<std::string, std::vector<float>> matrices;     ///< 4x4, row-major, p' = M p, for the header

    /// The channel of that name, or nullptr.
    const std::vector<float>* channel(const std::string& name) const {
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names[i] == name) return &channels[i];
        }
        return nullptr;
    }
};

/// Writes .exr (every channel, 32-bit float) or .png (R G B, 8 bits), by extension, to a temporary name that is
/// renamed when whole. "-" writes `format` ("exr" or "png") to standard output. Throws Error (file, usage).
CSGRT_API void write_image(const Image& image, const std::string& path, const std::string& format = "exr");

/// Reads an .exr with all its float channels, text attributes and matrices. Throws Error (file).
CSGRT_API Image read_image(const std::string& path);

}  // namespace csgrt
