// Solids that outlines make.
#include <algorithm>
#include <cmath>

#include "compile/packer.hpp"
#include "compile/polyhedron.hpp"
#include "scene/sketch_curves.hpp"

namespace csgrt {

namespace {

std::uint32_t position(std::size_t size) {
    if (size > 0xffffffffu) throw Error(Status::scene, "the parameters of all solids together exceed 2^32 numbers");
    return static_cast<std::uint32_t>(size);
}

/// A sketch as kernels/geometry/curve.h has it: points relative to a center, in a unit that is a power of two, so that
/// they lie within -1 and 1 and are rounded once.
struct PackedSketch {
    std::uint32_t first_word = 0;
    double u = 0, v = 0, unit = 1;
};

class SketchWriter {
public:
    SketchWriter(CompiledScene& scene, const std::vector<CurvePiece>& pieces) : scene_(scene) {
        const CurvePoint& first = pieces.front().front();
        long double low_u = first.u, high_u = first.u, low_v = first.v, high_v = first.v;
        for (const CurvePiece& piece : pieces)
            for (const CurvePoint& p : piece) {
                low_u = std::min(low_u, p.u), high_u = std::max(high_u, p.u);
                low_v = std::min(low_v, p.v), high_v = std::max(high_v, p.v);
            }
        sketch_.u = static_cast<double>((low_u + high_u) / 2);
        sketch_.v = static_cast<double>((low_v + high_v) / 2);
        const long double half = std::max(high_u - low_u, high_v - low_v) / 2;
        if (half > 0) sketch_.unit = std::exp2(std::ceil(static_cast<double>(std::log2(half))));
    }

    PackedSketch write(const std::vector<CurvePiece>& pieces) {
        std::vector<std::uint32_t> words{position(scene_.reals.size()), 0, 0};
        for (const double x : {sketch_.u, sketch_.v, sketch_.unit}) scene_.reals.push_back(x);
        for (const CurvePiece& piece : pieces) {
            if (piece.size() != 2) continue;
            ++words[1];
            for (const CurvePoint& p : piece) point(p);
        }
        for (const CurvePiece& piece : pieces) {
            if (piece.size() == 2) continue;
            ++words[2];
            words.push_back(position(scene_.reals.size()));
            words.push_back(static_cast<std::uint32_t>(piece.size() - 1));
            for (const CurvePoint& p : piece) {
                point(p);
                scene_.reals.push_back(static_cast<double>(p.weight));
            }
        }
        sketch_.first_word = position(scene_.words.size());
        scene_.words.insert(scene_.words.end(), words.begin(), words.end());
        return sketch_;
    }

private:
    void point(const CurvePoint& p) {
        scene_.reals.push_back(static_cast<double>((p.u - sketch_.u) / sketch_.unit));
        scene_.reals.push_back(static_cast<double>((p.v - sketch_.v) / sketch_.unit));
    }

    CompiledScene& scene_;
    PackedSketch sketch_;
};

/// Writes the pieces, unless another place of the same solid has done so.
PackedSketch share(CompiledScene& scene, SharedParts& shared, const void* key, const std::vector<CurvePiece>& pieces) {
    const auto known = shared.find(key);
    if (known == shared.end()) {
        const PackedSketch sketch = SketchWriter(scene, pieces).write(pieces);
        shared.emplace(key, sketch.first_word);
        return sketch;
    }
    const double* reals = scene.reals.data() + scene.words[known->second];
    return {known->second, reals[0], reals[1], reals[2]};
}

}  // namespace

void Packer::operator()(const Ebm&) { throw Error(Status::scene, "solids of type 'ebm' cannot be rendered"); }

void Packer::operator()(const Extrude& s) {
    record.type = SOLID_EXTRUDE;
    std::vector<CurvePiece> pieces = curve_pieces(s.sketch);
    close_gaps(pieces);
    const PackedSketch sketch = share(scene, shared, &s.sketch, pieces);
    record.first_word = sketch.first_word;
    record.first_real = position(scene.reals.size());
    const Wide v = wide(s.v), a = wide(s.a), b = wide(s.b), h = wide(s.h);
    const long double u0 = sketch.u, v0 = sketch.v, unit = sketch.unit;
    frame(v + u0 * a + v0 * b + 0.5L * h, {unit * a, unit * b, 0.5L * h});

    const Wide along = transform_direction(matrix, h), across_a = transform_direction(matrix, a);
    const Wide across_b = transform_direction(matrix, b);
    Wide cap = glm::cross(across_a, across_b);
    if (glm::dot(cap, along) < 0) cap = -cap;
    face(plane_through(transform_point(matrix, v), -cap));
    face(plane_through(transform_point(matrix, v + h), cap));
    for (const CurvePiece& piece : pieces) {
        if (piece.size() != 2) continue;
        const Wide line = (piece[1].u - piece[0].u) * across_a + (piece[1].v - piece[0].v) * across_b;
        const Wide normal = glm::cross(line, along);
        face(plane_through(transform_point(matrix, v + piece[0].u * a + piece[0].v * b),
                           glm::dot(normal, normal) > 0 ? normal : cap));
    }
}

void Packer::operator()(const Revolve&) { throw Error(Status::scene, "solids of type 'revolve' cannot be rendered"); }

}  // namespace csgrt
