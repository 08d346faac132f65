// What to draw: the size, camera and channels of a picture.
#pragma once

#include <cstdint>

#include <csgrt/camera.hpp>

namespace csgrt {

/// Groups of a picture's channels (see Image), one bit each.
namespace channel {
inline constexpr std::uint32_t color = 1;     ///< R G B A
inline constexpr std::uint32_t distance = 2;  ///< Z
inline constexpr std::uint32_t normal = 4;    ///< N.X N.Y N.Z
inline constexpr std::uint32_t ids = 8;       ///< region, solid
inline constexpr std::uint32_t counts = 16;   ///< depth, partitions, overlap: only with View::every_partition
inline constexpr std::uint32_t all = 31;
}  // namespace channel

/// A picture to be drawn.
struct View {
    int width = 1024, height = 1024;  ///< pixels, 1 to 32,768 each
    Camera camera = {};
    /// True: everything along each ray is computed. False: only the first hits, several times faster, and the picture
    /// has none of the channels of channel::counts. A scene with plates (a bot of that mode) takes as long as if true.
    bool every_partition = true;
    std::uint32_t channels = channel::all;  ///< the groups that the picture has, in the order of their bits
    bool transparent = false;  ///< true: R, G, B and A are 0 where a ray hits nothing, in place of the background
};

}  // namespace csgrt
