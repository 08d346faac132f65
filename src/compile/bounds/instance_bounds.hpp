// What is computed of each instance first, once for all that need it.
#pragma once

#include <span>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/bounds/bounds.hpp"
#include "compile/flatten/flatten.hpp"

namespace csgrt {

class Measured {
public:
    /// The arithmetic is done by several threads.
    Measured(const Scene& scene, const FlatScene& flat);

    std::vector<Box> boxes, brlcad_boxes;  ///< one an instance; see SolidBoxes
    /// The faces of an instance that is an arb: long double is slow, and the box needs them, too.
    std::span<const Plane> faces(std::size_t instance) const;

private:
    std::vector<std::uint32_t> first_face_;  ///< of each instance, within its chunk's
    std::vector<std::vector<Plane>> chunks_;
};

}  // namespace csgrt
