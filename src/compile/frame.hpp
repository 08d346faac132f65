// Frame: everything that a kernel needs to know about one picture. It is made from a View and a CompiledScene.
#pragma once

#include <vector>

#include "compiled_scene.hpp"

namespace csgrt {

/// A frame in double precision, with its lights and the view's axes. Backends convert it to the precision of their
/// kernels.
struct PreparedFrame {
    kernel::Frame frame{};
    std::vector<kernel::LightRecord> lights;
    double eye_to_center = 0;  ///< millimetres; orthographic: from the rays' origins
    double view_size = 0;      ///< height of the picture at the centre, millimetres
    Vec3 right, up, back;      ///< the view's axes; `back` points to the eye
    Vec3 center;
    double aspect = 1;       ///< of the whole view: width / height
    std::uint64_t rays = 0;  ///< rays of the screen's pixels, filled up to whole tiles
    /// For each tile of the screen, the distance at and behind which its pixels may have anything, also the background.
    /// Empty: every pixel has its first hit. Only of first hits; the first channel is then the distance.
    std::vector<float> ends;
    /// The devices draw the picture's edges, by its channels of distances, normals and ids.
    bool edges = false;
};

/// The rays of a view that are drawn: every `step`-th column and line from the first ones on, moved by a fraction of a
/// pixel.
struct Sampling {
    int step = 1, column = 0, line = 0;  ///< step: a power of two; column and line: less than step
    double right = 0, down = 0;
};

/// Prepares BRL-CAD's view. A negative `tolerance` means the scene's tolerance. Throws Error (usage) for sizes and
/// angles that have no meaning.
PreparedFrame prepare_frame(const CompiledScene& scene, const View& view, double tolerance = -1,
                            const Sampling& sampling = {});

/// Sets the members of a frame that depend on the scene alone, for views and lists of rays. A negative `tolerance`
/// means the scene's tolerance.
void put_scene(const CompiledScene& scene, double tolerance, kernel::Frame& frame);

/// The model's box for BRL-CAD's default view: rounded outward to whole millimetres (at least one millimetre of
/// diagonal).
Box framing_box(const CompiledScene& scene);

}  // namespace csgrt
