// Sketch writer: writes sketches as kernels/geometry/curve.h reads them.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/solids/packer.hpp"
#include "scene/solids/sketch_curves.hpp"

namespace csgrt {

/// A line from (u0, v0) to (u1, v1) in a sketch's plane.
struct StraightLine {
    long double u0 = 0, v0 = 0, u1 = 0, v1 = 0;
};
/// The parts of a sketch: its straight lines, and its curves.
struct SketchParts {
    std::vector<StraightLine> lines;
    std::vector<BezierCurve> curves;
};
SketchParts sketch_parts(std::vector<BezierCurve> curves);

/// The origin of a sketch's points: the middle of all points, or the point at the same height on the axis u = 0.
enum class SketchCenter : std::uint8_t { middle, axis };

/// A sketch in the scene's tables: its words, and the centre and unit of its numbers.
struct PackedSketch {
    std::uint32_t first_word = 0;
    double u = 0, v = 0;  ///< the center
    double unit = 1;      ///< a power of two; divided by it, all points lie within -1 and 1 of the center
};

/// Writes the parts, unless they are written for another instance of the same solid. If the center is the middle, the
/// lines get a hierarchy of boxes and are put in the order of its leaves.
PackedSketch share_sketch(Shapes& scene, SharedParts& shared, const void* key, SketchParts& parts, SketchCenter center);

/// A size as a position in one of the tables. Throws Error (scene) beyond 32 bits.
std::uint32_t position_of(std::size_t size);

}  // namespace csgrt
