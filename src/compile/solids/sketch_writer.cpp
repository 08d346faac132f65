#include "compile/solids/sketch_writer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compile/bvh/build.hpp"
#include "kernel_host/geometry.hpp"

namespace csgrt {

static_assert(Limits::curve_degree < CURVE_SIZE && 2 * Limits::curve_degree < BERNSTEIN_SIZE);

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
    for (const BezierCurve& curve : parts.curves)
        for (const CurvePoint& p : curve) add(p.u, p.v);
    PackedSketch sketch;
    if (u.low > u.high) return sketch;  // the sketch is empty
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

/// Sorts the lines into the order of the hierarchy's leaves.
Hierarchy sort_lines(std::vector<StraightLine>& lines, const PackedSketch& sketch) {
    std::vector<Box> boxes;
    boxes.reserve(lines.size());
    for (const StraightLine& line : lines) {
        boxes.push_back(empty_box);
        // All boxes get the same depth, so that the surface area heuristic rates a box around many lines by its
        // circumference.
        const auto add = [&](long double u, long double v, double depth) {
            extend(boxes.back(), {static_cast<double>((u - sketch.u) / sketch.unit),
                                  static_cast<double>((v - sketch.v) / sketch.unit), depth});
        };
        add(line.u0, line.v0, -1);
        add(line.u1, line.v1, 1);
    }
    Hierarchy hierarchy = build_bvh(boxes, {}, 2, 0);
    std::vector<StraightLine> sorted;
    sorted.reserve(lines.size());
    for (const std::uint32_t i : hierarchy.order) sorted.push_back(lines[i]);
    lines = std::move(sorted);
    return hierarchy;
}

void write(Shapes& scene, const SketchParts& parts, const std::vector<kernel::BvhNode>& nodes, PackedSketch& sketch) {
    const auto number = [&](long double x) { scene.reals.push_back(static_cast<double>(x)); };
    const auto point = [&](long double u, long double v) {
        number((u - sketch.u) / sketch.unit);
        number((v - sketch.v) / sketch.unit);
    };
    sketch.first_word = position_of(scene.words.size());
    scene.words.push_back(position_of(scene.reals.size()));
    scene.words.push_back(position_of(parts.lines.size()));
    scene.words.push_back(position_of(parts.curves.size()));
    scene.words.push_back(position_of(scene.inner_nodes.size()));
    scene.words.push_back(position_of(nodes.size()));
    scene.inner_nodes.insert(scene.inner_nodes.end(), nodes.begin(), nodes.end());
    for (const StraightLine& line : parts.lines) {
        point(line.u0, line.v0);
        point(line.u1, line.v1);
    }
    for (const BezierCurve& curve : parts.curves) {
        scene.words.push_back(position_of(scene.reals.size()));
        scene.words.push_back(static_cast<std::uint32_t>(curve.size() - 1));
        for (const CurvePoint& p : curve) {
            point(p.u, p.v);
            number(p.weight);
        }
    }
}

}  // namespace

SketchParts sketch_parts(std::vector<BezierCurve> curves) {
    SketchParts parts;
    for (BezierCurve& curve : curves) {
        if (curve.size() == 2) {
            parts.lines.push_back({curve[0].u, curve[0].v, curve[1].u, curve[1].v});
        } else {
            parts.curves.push_back(std::move(curve));
        }
    }
    return parts;
}

std::uint32_t position_of(std::size_t size) {
    if (size > 0xffffffffu) throw Error(Status::scene, "the parameters of all solids together exceed 2^32 numbers");
    return static_cast<std::uint32_t>(size);
}

PackedSketch share_sketch(Shapes& scene, SharedParts& shared, const void* key, SketchParts& parts,
                          SketchCenter center) {
    PackedSketch sketch = place(parts, center);
    Hierarchy hierarchy;
    if (center == SketchCenter::middle && !parts.lines.empty()) hierarchy = sort_lines(parts.lines, sketch);
    const auto [known, is_new] = shared.emplace(key, 0u);
    if (is_new) {
        write(scene, parts, hierarchy.nodes, sketch);
        known->second = sketch.first_word;
    }
    sketch.first_word = known->second;
    return sketch;
}

}  // namespace csgrt
