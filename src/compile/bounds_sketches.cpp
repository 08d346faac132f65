// Solids that outlines make.
#include <algorithm>

#include "compile/sketch_box.hpp"
#include "compile/tight_box.hpp"

namespace csgrt {

Box Tight::operator()(const Ebm&) const { return {}; }

Box Tight::operator()(const Extrude& s) const {
    const Wide v = transform_point(m, wide(s.v)), a = transform_direction(m, wide(s.a));
    const Wide b = transform_direction(m, wide(s.b)), h = transform_direction(m, wide(s.h));
    const std::vector<CurvePiece> pieces = curve_pieces(s.sketch);
    Wide low, high;
    for (int i = 0; i < 3; ++i) {
        const auto [least, greatest] = reach_of(pieces, a[i], b[i]);
        low[i] = v[i] + least + std::min(h[i], 0.0L);
        high[i] = v[i] + greatest + std::max(h[i], 0.0L);
    }
    return {narrow(low), narrow(high)};
}

Box Tight::operator()(const Revolve&) const { return {}; }

}  // namespace csgrt
