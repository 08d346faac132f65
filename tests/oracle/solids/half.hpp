// Half-space: normal . p <= distance. (Its place may be any affine map, so the normal is carried by the inverse's
// transpose.)
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

inline ImplicitSolid implicit(const Half& half, const QAffine& place) {
    ImplicitSolid solid;
    const QVec n = half.plane.normal;
    const quad reach = half.plane.distance / dot(n, n);
    add_frame(solid, place, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, reach * n});  // the frame's origin is on the plane
    solid.add(PlaneFunction{n, 0});
    solid.bounded = false;
    solid.size = solid.placement;
    return solid;
}

}  // namespace csgrt::oracle
