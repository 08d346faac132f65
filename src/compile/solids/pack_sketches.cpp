// Pack sketches: packs solids that are made of sketches.
#include <algorithm>
#include <cmath>

#include "compile/solids/axis_frame.hpp"
#include "compile/solids/cell_outline.hpp"
#include "compile/solids/packer.hpp"
#include "compile/solids/polyhedron.hpp"
#include "compile/solids/sketch_writer.hpp"
#include "scene/range.hpp"

namespace csgrt {

namespace {

/// A prism's vectors in the model, after the solid's own matrix.
struct Prism {
    Wide v, a, b, h;
};

/// Is the sketch one loop of lines, in any order, that bounds a convex part of the plane?
bool is_convex(const SketchParts& parts) {
    constexpr std::size_t most = 16;  // an outline of more lines is quicker with its hierarchy
    const std::vector<StraightLine>& lines = parts.lines;
    if (!parts.curves.empty() || lines.size() < 3 || lines.size() > most) return false;
    long double turn = 0;
    std::size_t at = 0;
    for (std::size_t step = 0; step < lines.size(); ++step) {
        const StraightLine& line = lines[at];
        const auto next = std::find_if(lines.begin(), lines.end(),
                                       [&](const StraightLine& l) { return l.u0 == line.u1 && l.v0 == line.v1; });
        if (next == lines.end()) return false;
        at = static_cast<std::size_t>(next - lines.begin());
        if (at == 0 && step + 1 < lines.size()) return false;  // there is another loop
        const auto side = [&](long double u, long double v) {
            return (line.u1 - line.u0) * (v - line.v0) - (line.v1 - line.v0) * (u - line.u0);
        };
        if (turn == 0) turn = side(next->u1, next->v1);
        for (const StraightLine& other : lines)
            if (!(side(other.u0, other.v0) * turn >= 0)) return false;
    }
    return at == 0 && turn != 0;
}

void extrude(Packer& packer, const Prism& prism, SketchParts parts, const void* key) {
    const auto& [v, a, b, h] = prism;
    const Matrix& matrix = packer.matrix;
    const bool convex = is_convex(parts);
    packer.record.type = convex ? SOLID_ARB : SOLID_EXTRUDE;
    packer.is_polyhedron = convex;
    if (!convex) {
        const PackedSketch sketch = share_sketch(packer.scene, packer.shared, key, parts, SketchCenter::middle);
        packer.record.first_word = sketch.first_word;
        packer.record.first_real = position_of(packer.scene.reals.size());
        const long double u0 = sketch.u, v0 = sketch.v, unit = sketch.unit;
        packer.frame(v + u0 * a + v0 * b + 0.5L * h, {unit * a, unit * b, 0.5L * h});
    }

    const Wide along = transform_direction(matrix, h), across_a = transform_direction(matrix, a);
    const Wide across_b = transform_direction(matrix, b);
    Wide end = glm::cross(across_a, across_b);
    if (glm::dot(end, along) < 0) end = -end;
    packer.face(plane_through(transform_point(matrix, v), -end));
    packer.face(plane_through(transform_point(matrix, v + h), end));
    // A wall's plane has an inner side only if the outline is convex.
    Wide middle(0);
    for (const StraightLine& line : parts.lines)
        middle += (line.u0 * across_a + line.v0 * across_b) / static_cast<long double>(parts.lines.size());
    for (const StraightLine& line : parts.lines) {
        const Wide edge = (line.u1 - line.u0) * across_a + (line.v1 - line.v0) * across_b;
        Wide normal = glm::cross(edge, along);
        if (convex && glm::dot(normal, middle - (line.u0 * across_a + line.v0 * across_b)) > 0) normal = -normal;
        packer.face(plane_through(transform_point(matrix, v + line.u0 * a + line.v0 * b),
                                  glm::dot(normal, normal) > 0 ? normal : end));
    }
}

}  // namespace

void Packer::operator()(const Extrude& s) {
    extrude(*this, {wide(s.v), wide(s.a), wide(s.b), wide(s.h)}, sketch_parts(closed_curves(s.sketch)), &s.sketch);
}

void Packer::operator()(const Ebm& s) {
    extrude(*this,
            {transform_point(s.matrix, Wide(0)), transform_direction(s.matrix, Wide(1, 0, 0)),
             transform_direction(s.matrix, Wide(0, 1, 0)), transform_direction(s.matrix, Wide(0, 0, s.height))},
            {cell_outline(s), {}}, &s);
}

std::string note_on(const Revolve& s) {
    if (turn_of(s) != Turn::none) return {};
    return "it is empty: its angle is " + rounded_text(s.angle) + ", and ends of a turn that are no more than " +
           rounded_text(PlaneTable::gap) + " radians apart are one";
}

void Packer::operator()(const Revolve& s) {
    record.type = SOLID_REVOLVE;
    SketchParts parts = sketch_parts(turned_curves(s.sketch));
    const auto flat = [](const StraightLine& line) { return line.v0 == line.v1; };
    std::stable_partition(parts.lines.begin(), parts.lines.end(), flat);
    const PackedSketch sketch = share_sketch(scene, shared, &s.sketch, parts, SketchCenter::axis);
    record.first_word = sketch.first_word;
    record.first_real = position_of(scene.reals.size());

    const AxisFrame axes = axis_frame(s);
    const long double unit = sketch.unit;
    const Wide v = wide(s.v);
    frame(v + static_cast<long double>(sketch.v) * axes.z, {unit * axes.x, unit * axes.y, unit * axes.z});
    const Turn turn = turn_of(s);
    const bool less = turn == Turn::none || turn == Turn::less || turn == Turn::half;
    real(turn == Turn::whole ? REVOLVE_WHOLE : less ? REVOLVE_LESS : REVOLVE_MORE);

    const WideMatrix normals = glm::transpose(glm::inverse(linear_part(matrix)));
    if (turn != Turn::whole) {
        // The normals point away from the space between the two planes, which is the solid or the missing part.
        const Wide first = less ? -axes.y : axes.y;
        Wide second =
            std::cos(static_cast<long double>(s.angle)) * axes.y - std::sin(static_cast<long double>(s.angle)) * axes.x;
        if (!less) second = -second;
        if (turn == Turn::none) second = -first;
        if (turn == Turn::half) second = first;
        face(plane_through(transform_point(matrix, v), normals * first));
        face(plane_through(transform_point(matrix, v), normals * second));
    }
    for (const StraightLine& line : parts.lines)
        if (flat(line)) face(plane_through(transform_point(matrix, v + line.v0 * axes.z), normals * axes.z));
}

}  // namespace csgrt
