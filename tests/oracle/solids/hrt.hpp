// Heart: p = v + x X + y Y + z Z with (x^2 + 9/4 y^2 + z^2 - 1)^3 <= x^2 z^3 +
// 9/80 y^2 z^3. Its cube root says the same and has a gradient where that has
// none: x^2 + 9/4 y^2 + z^2 - 1 <= z (x^2 + 9/80 y^2)^(1/3).
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

struct HrtFunction {
    quad terms() const { return 1; }
    double settled() const { return 1e-18; }
    int pieces() const { return 48; }
    std::vector<quad> breaks(const QVec& o, const QVec& d) const {
        const quad across = d.x * d.x + d.y * d.y * 9 / 80;
        if (!(across > 0)) return {};
        return {-(o.x * d.x + o.y * d.y * 9 / 80) / across};
    }
    static quad cube_root(quad x) {
        const quad c = std::cbrt(static_cast<long double>(x));
        return x == 0 ? c : c - (c * c * c - x) / (3 * c * c);
    }
    static quad base(const QVec& p) { return p.x * p.x + p.y * p.y * 9 / 80; }
    quad value(const QVec& p) const { return p.x * p.x + p.y * p.y * 9 / 4 + p.z * p.z - 1 - p.z * cube_root(base(p)); }
    QVec gradient(const QVec& p) const {
        const quad c = cube_root(base(p)), dimple = c > 0 ? 2 * p.z / (3 * c * c) : quad(0);
        return {(2 - dimple) * p.x, (quad(9) / 2 - dimple * 9 / 80) * p.y, 2 * p.z - c};
    }
};

inline ImplicitSolid implicit(const Hrt& hrt, const QAffine& place) {
    ImplicitSolid solid;
    add_frame(solid, place, {hrt.x, hrt.y, hrt.z, hrt.v});
    solid.add_curved(HrtFunction{});
    const QAffine& w = solid.to_world;
    solid.radius = to_double(length(w.x) * quad(1.2) + length(w.y) * quad(0.75) + length(w.z) * quad(1.3));
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
