// From where a picture is taken.
#pragma once

#include <optional>

#include <csgrt/vector.hpp>

namespace csgrt {

/// The view is BRL-CAD's: a rectangle, centred on the model's box by default. The sides of that box are moved outward
/// to whole millimetres, unless its diagonal is less than one. Lengths and coordinates are millimetres, angles degrees.
/// Functions that take a Camera throw Error (usage) if its members contradict each other or are out of range.
///
/// An orthographic view has no eye. Its rays start on a plane in front of the whole model, so that all of the model is
/// seen however small the view is. That plane cuts half-spaces, which have no end.
struct Camera {
    double azimuth = 35;                   ///< of the direction from the model to the eye: from +x about z
    double elevation = 25;                 ///< of the same direction: above the xy plane
    double perspective = 0;                ///< angle of view across the picture's height, below 180; 0: orthographic
    std::optional<Vec3> center = {};       ///< the middle of the picture; default: the centre of the model's box
    std::optional<double> view_size = {};  ///< height of the view at `center`; default: the box's diagonal

    /// Where the eye is, in place of azimuth and elevation, which then have no effect: JSON, the command and Python,
    /// which know what was given, refuse them beside it. With a perspective it determines the size of the view as well,
    /// and `view_size` must be absent. An orthographic view takes only its direction from it.
    std::optional<Vec3> eye = {};
    std::optional<Vec3> look_at = {};  ///< another name of `center`, which must be absent if this is given
    /// The direction that points up in the picture; not parallel to the line of sight. Default: +z; in a view straight
    /// down or up, the direction that azimuth 0 has.
    std::optional<Vec3> up = {};
};

}  // namespace csgrt
