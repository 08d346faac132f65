// View: the size, camera and channels of a picture.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <csgrt/camera.hpp>
#include <csgrt/solids.hpp>

namespace csgrt {

/// Groups of a picture's channels (see Image), one bit each.
namespace channel {
inline constexpr std::uint32_t color = 1;     ///< R G B A
inline constexpr std::uint32_t distance = 2;  ///< Z
inline constexpr std::uint32_t normal = 4;    ///< N.X N.Y N.Z
inline constexpr std::uint32_t ids = 8;       ///< region, solid
inline constexpr std::uint32_t counts = 16;   ///< depth, partitions, overlap: only with View::every_partition
inline constexpr std::uint32_t all = 31;      ///< all groups above
inline constexpr std::uint32_t display = 32;  ///< RGBA8: as in display_pixels()
inline constexpr std::uint32_t ghosts = 64;   ///< ghost: the first ghost that the ray passes before the visible surface
}  // namespace channel

/// The lights of a picture.
enum class Lighting : std::uint8_t {
    model,      ///< the model's; if it has none, BRL-CAD's light beside the eye
    headlight,  ///< BRL-CAD's light beside the eye
    studio      ///< a light above the eye's shoulder, a weaker one from the other side, and much ambient light
};

/// A rectangle of a picture's pixels, counted from the top left.
struct PixelRectangle {
    int left = 0, top = 0, width = 0, height = 0;
};

/// A picture to be drawn.
struct View {
    int width = 1024, height = 1024;  ///< Pixels. 1 to 32,768 each.
    Camera camera = {};
    /// Everything along each ray is computed; else first hits alone, several times faster, without the channels depth,
    /// partitions and overlap. A scene with plates (a bot of that mode) takes as long as if true.
    bool every_partition = true;
    std::uint32_t channels = channel::all;  ///< The groups of channels that the picture has, a bit each.
    /// Up to six planes, which cut away everything beyond them. They cut as half-spaces in the model's tree would.
    /// Where a plane cuts a region open, a hit has the region's colour, the plane's normal and no solid. Counts include
    /// solids beyond the planes through which the ray leaves. A plane's normal may have any length but 0.
    std::vector<Plane> clip = {};
    std::optional<PixelRectangle> part = {};  ///< The only pixels that are drawn, each as in the whole picture.
    /// Rays a pixel; the colours are their mean. 1 to 256, always in the same pattern. The other channels have the
    /// values of the ray through the pixel's middle.
    int samples = 1;
    bool transparent = false;  ///< No background: red, green, blue and alpha are 0 where a ray hits nothing.
    /// Black lines where the region, the surface's direction or its depth changes from pixel to pixel. The lines are a
    /// pixel wide, on the nearer side, smooth with several samples, and not on what is one or two pixels across. Pixels
    /// beyond the border of `part` have no effect, and coarse steps have no lines.
    bool edges = false;
    Lighting light = Lighting::model;  ///< Where light comes from.
};

}  // namespace csgrt
