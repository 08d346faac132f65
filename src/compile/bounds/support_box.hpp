// Support box: the box of a solid, from its support function (its extent in a direction) in six directions.
#pragma once

#include "compile/linear.hpp"

namespace csgrt {

/// `support(x, y, z)`: the largest of x p.x + y p.y + z p.z over all points p
/// of the solid, in the frame of `axes`.
template <class Support>
Box support_box(const Matrix& m, const Wide& center, const WideMatrix& axes, const Support& support) {
    const Wide at = transform_point(m, center);
    const WideMatrix columns = linear_part(m) * axes;
    Wide low(0), high(0);
    for (int i = 0; i < 3; ++i) {
        high[i] = at[i] + support(columns[0][i], columns[1][i], columns[2][i]);
        low[i] = at[i] - support(-columns[0][i], -columns[1][i], -columns[2][i]);
    }
    return {narrow(low), narrow(high)};
}

}  // namespace csgrt
