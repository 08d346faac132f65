// What the kernels' geometry says about one solid: a scene of one region that holds it, compiled, each ray on the host.
#pragma once

#include <memory>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "oracle/judge.hpp"
#include "reference/intersect.hpp"

namespace csgrt {

/// Compiles the placed solid. Throws Error if validation refuses it.
inline CompiledScene compile_alone(const Shape& shape, const Matrix& matrix) {
    Scene scene;
    scene.objects.push_back(Solid{"solid", shape, {}});
    Combination region;
    region.name = "region";
    region.region = true;
    region.tree.nodes.push_back({Operator::leaf, 0, "solid", matrix, {}});
    scene.objects.push_back(region);
    return compile(scene, {"region"});
}

/// A function from rays to the solid's segments; see oracle::run_campaign.
inline auto kernel_answer(const Shape& shape, const Matrix& matrix) {
    auto scene = std::make_shared<CompiledScene>(compile_alone(shape, matrix));
    return [scene](const Ray& ray) {
        std::vector<oracle::Segment> segments;
        for (const SolidSegment& s : intersect_solid(*scene, 0, ray))
            segments.push_back({s.in, s.out, s.in_normal, s.out_normal});
        return segments;
    };
}

}  // namespace csgrt
