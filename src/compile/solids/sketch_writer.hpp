// Sketches as kernels/geometry/curve.h reads them.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/solids/packer.hpp"
#include "scene/solids/sketch_curves.hpp"

namespace csgrt {

struct StraightLine {
    long double u0 = 0, v0 = 0, u1 = 0, v1 = 0;
};
/// The straight pieces of a sketch, and the others.
struct SketchParts {
    std::vector<StraightLine> lines;
    std::vector<CurvePiece> curves;
};
SketchParts sketch_parts(std::vector<CurvePiece> pieces);

/// What points are told from: the middle of them all, or that height of the axis u = 0.
enum class SketchCenter : std::uint8_t { middle, axis };

struct PackedSketch {
    std::uint32_t first_word = 0;
    double u = 0, v = 0;  ///< the center
    double unit = 1;      ///< a power of two; in it, from the center, all points lie within -1 and 1
};

/// Writes the parts, unless another place of the same solid has done so. Where points are told from the middle, the
/// lines get a hierarchy of boxes and are put in the order of its leaves.
PackedSketch share_sketch(Shapes& scene, SharedParts& shared, const void* key, SketchParts& parts, SketchCenter center);

/// A size as a position in one of the tables. Throws Error (scene) beyond 32 bits.
std::uint32_t position_of(std::size_t size);

}  // namespace csgrt
