// Bounds of instances: boxes and faces, which are computed once for all later steps of the compilation.
#pragma once

#include <span>
#include <vector>

#include <csgrt/scene.hpp>

#include "compile/bounds/bounds.hpp"
#include "compile/flatten/flatten.hpp"

namespace csgrt {

/// The boxes of all instances, and the faces of the arbs among them. Later steps only read them.
class InstanceBounds {
public:
    /// Measures all instances, on several threads.
    InstanceBounds(const Scene& scene, const FlatScene& flat);
    /// Measures an instance again, which has another matrix.
    void measure(const Scene& scene, const FlatScene& flat, std::uint32_t instance);

    std::vector<Box> boxes, brlcad_boxes;  ///< one an instance; see SolidBoxes
    /// The faces of an instance that is an arb. They are kept from the computation of the box, because long double is
    /// slow.
    std::span<const Plane> faces(std::size_t instance) const;

private:
    std::vector<Plane> set_boxes(const Scene& scene, const FlatScene& flat, std::size_t instance);

    std::vector<std::uint32_t> first_face_;  ///< of each instance, within its chunk's faces
    std::vector<std::vector<Plane>> chunks_;
};

}  // namespace csgrt
