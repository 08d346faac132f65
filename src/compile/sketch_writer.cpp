#include "compile/sketch_writer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace csgrt {

namespace {

struct Range {
    long double low = std::numeric_limits<long double>::infinity(), high = -low;

    void add(long double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

PackedSketch place(const SketchParts& parts, SketchCenter center) {
    Range u, v;
    const auto add = [&](long double pu, long double pv) {
        u.add(pu);
        v.add(pv);
    };
    for (const StraightLine& line : parts.lines) {
        add(line.u0, line.v0);
        add(line.u1, line.v1);
    }
    for (const CurvePiece& piece : parts.curves)
        for (const CurvePoint& p : piece) add(p.u, p.v);
    PackedSketch sketch;
    if (u.low > u.high) return sketch;  // nothing at all
    sketch.v = static_cast<double>((v.low + v.high) / 2);
    long double half = (v.high - v.low) / 2;
    if (center == SketchCenter::middle) {
        sketch.u = static_cast<double>((u.low + u.high) / 2);
        half = std::max(half, (u.high - u.low) / 2);
    } else {
        half = std::max({half, std::fabs(u.low), std::fabs(u.high)});
    }
    if (half > 0) sketch.unit = std::exp2(std::ceil(static_cast<double>(std::log2(half))));
    return sketch;
}

PackedSketch write(CompiledScene& scene, const SketchParts& parts, SketchCenter center) {
    PackedSketch sketch = place(parts, center);
    const auto number = [&](long double x) { scene.reals.push_back(static_cast<double>(x)); };
    const auto point = [&](long double u, long double v) {
        number((u - sketch.u) / sketch.unit);
        number((v - sketch.v) / sketch.unit);
    };
    sketch.first_word = position_of(scene.words.size());
    scene.words.push_back(position_of(scene.reals.size()));
    scene.words.push_back(position_of(parts.lines.size()));
    scene.words.push_back(position_of(parts.curves.size()));
    for (const double x : {sketch.u, sketch.v, sketch.unit}) number(x);
    for (const StraightLine& line : parts.lines) {
        point(line.u0, line.v0);
        point(line.u1, line.v1);
    }
    for (const CurvePiece& piece : parts.curves) {
        scene.words.push_back(position_of(scene.reals.size()));
        scene.words.push_back(static_cast<std::uint32_t>(piece.size() - 1));
        for (const CurvePoint& p : piece) {
            point(p.u, p.v);
            number(p.weight);
        }
    }
    return sketch;
}

}  // namespace

SketchParts sketch_parts(std::vector<CurvePiece> pieces) {
    SketchParts parts;
    for (CurvePiece& piece : pieces) {
        if (piece.size() == 2) {
            parts.lines.push_back({piece[0].u, piece[0].v, piece[1].u, piece[1].v});
        } else {
            parts.curves.push_back(std::move(piece));
        }
    }
    return parts;
}

std::uint32_t position_of(std::size_t size) {
    if (size > 0xffffffffu) throw Error(Status::scene, "the parameters of all solids together exceed 2^32 numbers");
    return static_cast<std::uint32_t>(size);
}

PackedSketch share_sketch(CompiledScene& scene, SharedParts& shared, const void* key, const SketchParts& parts,
                          SketchCenter center) {
    const auto known = shared.find(key);
    if (known != shared.end()) {
        const double* reals = scene.reals.data() + scene.words[known->second];
        return {known->second, reals[0], reals[1], reals[2]};
    }
    const PackedSketch sketch = write(scene, parts, center);
    shared.emplace(key, sketch.first_word);
    return sketch;
}

}  // namespace csgrt
