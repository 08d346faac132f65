// Scenes whose rays meet many segments.
#pragma once

#include <random>
#include <string>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "compile/model.hpp"
#include "sanitized.hpp"

namespace csgrt::test {

/// An operator over all solids, as one list, or as a comb to the left or to the right.
enum class Form { list, left, right };
inline Tree tree_of(const std::vector<std::string>& names, const std::vector<Operator>& ops, Form form) {
    Tree tree;
    const auto count = static_cast<std::uint32_t>(names.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        tree.nodes.push_back(leg(names[i]));
        if (form == Form::left && i > 0) tree.nodes.push_back(op(ops[i % ops.size()], 2));
    }
    if (form == Form::list) tree.nodes.push_back(op(ops[0], count));
    for (std::uint32_t i = count - 1; form == Form::right && i > 0; --i)
        tree.nodes.push_back(op(ops[(i - 1) % ops.size()], 2));
    return tree;
}

inline Combination region_of(const std::string& name, Tree tree) {
    Combination region{.name = name, .region = true};
    region.tree = std::move(tree);
    return region;
}

/// One region: balls in each other, the largest first. `copies`: each so many times.
inline Scene nested_balls(std::uint32_t count, const std::vector<Operator>& ops, Form form, std::uint32_t copies = 1) {
    Scene scene;
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < count; ++i) {
        names.push_back("s" + std::to_string(i));
        scene.objects.push_back(ball(names.back(), {}, 20 + 0.01 * (count - i / copies)));
    }
    scene.objects.push_back(region_of("r", tree_of(names, ops, form)));
    return scene;
}

/// `regions` regions over `solids` blocks and balls on a grid, so that faces and edges touch and rays along the axes
/// run in faces; with half-spaces, air and FASTGEN's ranks among them.
inline Scene deep_parts(std::uint32_t seed, std::uint32_t solids, std::uint32_t regions) {
    std::mt19937 engine(seed);
    const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
    Scene scene;
    std::vector<std::string> names;
    const auto place = [&](std::uint32_t count) { return static_cast<double>(random() % count); };
    for (std::uint32_t i = 0; i < solids; ++i) {
        names.push_back("s" + std::to_string(i));
        const Vec3 low{place(60), place(2), place(2)};
        const Vec3 high{low.x + 1 + place(60), low.y + 6 - place(2), low.z + 6 - place(2)};
        if (random() % 4 == 0)
            scene.objects.push_back(ball(names.back(), low, 2 + place(30)));
        else
            scene.objects.push_back(block(names.back(), low, high));
    }
    names.push_back("half");
    scene.objects.push_back(solid("half", Half{{{1, 0, 0}, 30}}));
    constexpr Operator all[] = {Operator::union_, Operator::intersection, Operator::difference, Operator::xor_};
    for (std::uint32_t i = 0; i < regions; ++i) {
        std::vector<std::string> own;
        std::vector<Operator> ops;
        for (std::uint32_t k = random() % (2 * solids / regions) + 2; k > 0; --k) {
            own.push_back(names[random() % names.size()]);
            ops.push_back(all[random() % 4]);
        }
        if (i + 1 < regions) own.front() = names[random() % solids];
        Combination region =
            region_of("r" + std::to_string(i), tree_of(own, ops, random() % 2 ? Form::left : Form::right));
        if (random() % 6 == 0) region.air = 1;
        if (random() % 9 == 0) region.fastgen = random() % 2 ? Fastgen::plate : Fastgen::volume;
        scene.objects.push_back(region);
    }
    return scene;
}

/// Rays along the grid of such parts: in faces, along edges and between.
inline std::vector<Ray> rays_along_grid() {
    std::vector<Ray> rays;
    constexpr int step = sanitized ? 4 : 1;
    for (int y = -1; y < 16; y += step)
        for (int z = -1; z < 16; z += step) rays.push_back({{-50, 0.5 * y, 0.5 * z}, {y % 2 ? 1.0 : 3.0, 0, 0}});
    for (int z = 0; z < 16; ++z) rays.push_back({{140, 0.4, 0.5 * z}, {-1, 0, 0}});
    return rays;
}

}  // namespace csgrt::test
