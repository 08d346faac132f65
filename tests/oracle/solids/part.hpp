// Particle: every point that lies in one of the balls around v + t h with radii r_v + t (r_h - r_v), 0 <= t <= 1. Those
// balls fill the two at the ends and the cone between that touches both. The distance to the nearest of them,
//   f(p) = min over t of |p - t h| - r_v - t (r_h - r_v),
// is convex. With p at q across and z along the axis the best t lies where the lines of touch end: with sine s =
// (r_v - r_h) / |h| at z - q s / sqrt(1 - s^2), cut to 0 .. |h|. In units of |h|, or of the radii if these are larger.
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

/// Of the hull's pieces: a ball about a point of the axis, and the cone that touches both.
struct PartBall {
    quad center, radius;
    quad terms() const { return 1; }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        const T up = z - T(center);
        return x * x + y * y + up * up - T(radius * radius);
    }
};
struct PartCone {
    quad at_zero, slope;
    quad terms() const { return 1; }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        const T wide = T(at_zero) + T(slope) * z;
        return x * x + y * y - wide * wide;
    }
};

struct PartFunction {
    quad h, r_v, r_h;  ///< the axis runs from 0 to h on z

    quad terms() const { return 1; }
    std::vector<quad> breaks(const QVec&, const QVec&) const { return {}; }
    int pieces() const { return 1; }
    double settled() const { return 1e-30; }

    /// The hull: the frustum between the circles where the cone touches both balls, and these, which meet it.
    std::vector<SurfaceSet> pieces_of_hull() const {
        const quad s = h > 0 ? (r_v - r_h) / h : quad(0), cosine2 = (1 - s) * (1 + s);
        const auto ball = [](quad z, quad r) {
            SurfaceSet piece;
            piece.push_back(std::make_unique<SurfaceOf<PartBall>>(PartBall{z, r}));
            return piece;
        };
        std::vector<SurfaceSet> all;
        if (!(cosine2 > 0) || !(h > 0)) {
            all.push_back(r_v >= r_h ? ball(0, r_v) : ball(h, r_h));
            return all;
        }
        SurfaceSet frustum;
        frustum.push_back(std::make_unique<SurfaceOf<PlaneFunction>>(PlaneFunction{{0, 0, -1}, -s * r_v}));
        frustum.push_back(std::make_unique<SurfaceOf<PlaneFunction>>(PlaneFunction{{0, 0, 1}, h + s * r_h}));
        const quad cosine = root(cosine2);
        frustum.push_back(std::make_unique<SurfaceOf<PartCone>>(PartCone{r_v / cosine, -s / cosine}));
        all.push_back(std::move(frustum));
        if (r_v > 0) all.push_back(ball(0, r_v));
        if (r_h > 0) all.push_back(ball(h, r_h));
        return all;
    }
    /// The z of the best ball's centre.
    quad best(const QVec& p) const {
        const quad s = h > 0 ? (r_v - r_h) / h : quad(0), cosine2 = (1 - s) * (1 + s);
        if (!(cosine2 > 0) || !(h > 0)) return r_v >= r_h ? quad(0) : h;
        const quad z = p.z - s * root((p.x * p.x + p.y * p.y) / cosine2);
        return z < 0 ? quad(0) : z > h ? h : z;
    }
    quad value(const QVec& p) const {
        const quad z = best(p);
        return length(p - QVec{0, 0, z}) - r_v - (h > 0 ? z / h * (r_h - r_v) : quad(0));
    }
    QVec gradient(const QVec& p) const {
        const QVec out = p - QVec{0, 0, best(p)};
        return dot(out, out) > 0 ? unit(out) : QVec{};
    }
};

inline ImplicitSolid implicit(const Part& part, const QAffine& place) {
    ImplicitSolid solid;
    const quad h = length(part.h), largest = larger(h, larger(part.r_v, part.r_h));
    const QVec axis = h > 0 ? unit(part.h) : QVec{0, 0, 1}, across = any_across(axis);
    add_frame(solid, place, {largest * across, largest * cross(axis, across), largest * axis, part.v});
    const quad r_v = h > 0 ? quad(part.r_v) : larger(part.r_v, part.r_h);  // without an axis: the larger ball
    solid.add_curved(PartFunction{h / largest, r_v / largest, part.r_h / largest});
    const QAffine& w = solid.to_world;
    const quad stretch = root(dot(w.x, w.x) + dot(w.y, w.y) + dot(w.z, w.z));
    solid.center = w.point({0, 0, h / largest / 2});
    solid.radius = to_double(length(w.z) * h / largest / 2 + stretch * larger(part.r_v, part.r_h) / largest);
    solid.size = solid.radius;
    return solid;
}

}  // namespace csgrt::oracle
