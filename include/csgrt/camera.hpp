// Camera: the point of view of a picture.
#pragma once

#include <optional>

#include <csgrt/vector.hpp>

namespace csgrt {

/// A camera has BRL-CAD's view: a rectangle, centred on the model's box by default. The sides of this box are moved
/// outward to whole millimetres, unless its diagonal is less than 1 mm. Lengths and coordinates are millimetres, angles
/// degrees. Functions that take a Camera throw Error (usage) if its members contradict each other or are out of range.
///
/// An orthographic view has no eye. Its rays start on a plane in front of the whole model, so that the model is never
/// cut, however small the view is. The plane also cuts half-spaces, which extend to infinity.
struct Camera {
    double azimuth = 35;     ///< Degrees of the direction from the model to the eye: from +x about z.
    double elevation = 25;   ///< Degrees of the same direction above the xy plane.
    double perspective = 0;  ///< Degrees of the angle of view across the picture's height, below 180; 0: parallel.
    std::optional<Vec3> center = {};  ///< The middle of the picture; the middle of the model's box if not given.
    /// Height of the view at the middle of the picture; the diagonal of the model's box if not given. A parallel view,
    /// however small, shows everything before its plane.
    std::optional<double> view_size = {};
    /// The position of the eye, in place of azimuth and elevation, which have no effect then. With a perspective the
    /// eye gives the size of the view, too; a parallel view takes only its direction from the eye. JSON, the command
    /// and Python's keywords refuse angles together with an eye. `view_size` must be absent in a perspective.
    std::optional<Vec3> eye = {};
    std::optional<Vec3> look_at = {};  ///< Another name of the picture's middle. `center` must be absent then.
    /// The direction that points up in the picture; +z if not given, or in a view straight down or up the direction
    /// that azimuth 0 has. The direction must not be parallel to the line of sight.
    std::optional<Vec3> up = {};
};

}  // namespace csgrt
