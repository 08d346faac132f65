// A scene of every form of some kinds of solids, and rays of all families at them. One scene, because it is compiled
// for a device as one program.
#pragma once

#include <string>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "oracle/rays.hpp"
#include "oracle/shapes.hpp"

namespace csgrt::test {

/// One region a solid: every form of the kinds, as it is and under a few matrices; and a ray of each family at each.
inline Scene scene_of(const std::vector<oracle::Kind>& kinds, std::vector<Ray>& rays) {
    constexpr std::size_t solids_a_kind = 30;
    Scene scene;
    Combination all;
    all.name = "all";
    for (const oracle::Kind kind : kinds) {
        oracle::Random random(5);
        for (std::size_t i = 0; i < solids_a_kind; ++i) {
            const oracle::Case one = oracle::make_case(kind, i, random);
            const std::string number = std::to_string(static_cast<int>(kind)) + "." + std::to_string(i);
            scene.objects.push_back(Solid{"s" + number, one.shape, {}});
            Combination region{.name = "r" + number, .region = true};
            region.tree.nodes.push_back({Operator::leaf, 0, "s" + number, one.matrix, {}});
            scene.objects.push_back(region);
            all.tree.nodes.push_back({Operator::leaf, 0, "r" + number, identity, {}});
            const oracle::ImplicitSolid solid = oracle::implicit(one.shape, one.matrix);
            oracle::RayMaker maker(one.shape, solid, random);
            for (std::size_t k = 0; k < oracle::ray_families; ++k)
                rays.push_back(maker.make(static_cast<oracle::RayFamily>(k)));
        }
    }
    all.tree.nodes.push_back(
        {Operator::union_, static_cast<std::uint32_t>(kinds.size() * solids_a_kind), "", identity, {}});
    scene.objects.push_back(all);
    return scene;
}

/// scene_of's rays without the family of far origins, which it takes in turn with the others.
inline std::vector<Ray> near_only(const std::vector<Ray>& rays) {
    std::vector<Ray> near;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (i % oracle::ray_families != static_cast<std::size_t>(oracle::RayFamily::far)) near.push_back(rays[i]);
    return near;
}

}  // namespace csgrt::test
