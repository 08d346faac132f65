// A scene of every form of one kind of solid, and rays of all families at them.
#pragma once

#include <string>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "oracle/rays.hpp"
#include "oracle/shapes.hpp"

namespace csgrt::test {

/// One region a solid: every form of the kind, as it is and under a few
/// matrices.
inline Scene scene_of(oracle::Kind kind, std::vector<Ray> &rays) {
  Scene scene;
  oracle::Random random(5);
  Combination all;
  all.name = "all";
  for (std::size_t i = 0; i < 30; ++i) {
    const oracle::Case one = oracle::make_case(kind, i, random);
    const std::string number = std::to_string(i);
    scene.objects.push_back(Solid{"s" + number, one.shape, {}});
    Combination region;
    region.name = "r" + number;
    region.region = true;
    region.tree.nodes.push_back(
        {Operator::leaf, 0, "s" + number, one.matrix, {}});
    scene.objects.push_back(region);
    all.tree.nodes.push_back({Operator::leaf, 0, "r" + number, identity, {}});
    const oracle::ImplicitSolid solid = oracle::implicit(one.shape, one.matrix);
    oracle::RayMaker maker(one.shape, solid, random);
    for (std::size_t k = 0; k < 21; ++k)
      rays.push_back(
          maker.make(static_cast<oracle::RayFamily>(k % oracle::ray_families)));
  }
  all.tree.nodes.push_back({Operator::union_, 30, "", identity, {}});
  scene.objects.push_back(all);
  return scene;
}

}  // namespace csgrt::test
