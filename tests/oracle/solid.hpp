// A solid as the judge sees it: an affine image of the set where every one of a few functions is not positive.
//
// Most are polynomials. Each is written once, from its textbook definition, as a function template of (x, y, z) in the
// solid's own frame (solids/<solid>.hpp). Called with numbers it gives the value, with Jets the gradient, with
// Polynomials its restriction to a ray. The others give value and gradient by themselves (ray_function.hpp).
#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "ray_function.hpp"
#include "polynomial.hpp"
#include "quad.hpp"
#include "filter_numbers.hpp"

namespace csgrt::oracle {

/// A value and its gradient.
struct Jet {
    quad value = 0;
    QVec gradient;

    Jet() = default;
    Jet(quad constant) : value(constant) {}
    Jet(quad v, const QVec& g) : value(v), gradient(g) {}
    friend Jet operator+(const Jet& a, const Jet& b) { return {a.value + b.value, a.gradient + b.gradient}; }
    friend Jet operator-(const Jet& a, const Jet& b) { return {a.value - b.value, a.gradient - b.gradient}; }
    friend Jet operator*(const Jet& a, const Jet& b) {
        return {a.value * b.value, a.value * b.gradient + b.value * a.gradient};
    }
};

/// One function f of a solid; inside is f <= 0. Points are in the solid's own frame.
class Surface {
public:
    virtual ~Surface() = default;
    /// How large f's terms are near the surface before they cancel: evaluated in double, along a ray, f is in doubt by
    /// this many units in the last place of 1, and the surface by that over the gradient's length. It matters where the
    /// gradient all but vanishes: near an apex, on slivers. 0: planes, whose evaluation the displacement `delta`
    /// covers.
    virtual quad terms() const = 0;
    /// The same at a point, no more than terms(): where all terms fade as f does, at a pinch or a tip, so does their
    /// rounding. Taken for constant there it would hide what a solver that evaluates f well can tell.
    virtual quad terms_at(const QVec&) const { return terms(); }
    virtual double terms_at_in_double(double, double, double) const { return to_double(terms()); }  ///< for the filter
    virtual quad value(const QVec& p) const = 0;
    virtual QVec gradient(const QVec& p) const = 0;
    virtual Polynomial along(const QVec& origin, const QVec& direction) const = 0;
    /// Instead of `along` where f is no polynomial; else null. It must not outlive the surface.
    virtual std::unique_ptr<RayFunction> ray_function(const QVec&, const QVec&) const { return nullptr; }

    /// Of a plane, whose function is normal . p - distance; else null.
    virtual const QVec* plane_normal() const { return nullptr; }

    // The same function in the numbers of the floating-point filter.
    virtual bool is_polynomial() const { return false; }
    virtual PolynomialOf<BoundedDouble> bounded_along(const Triple<BoundedDouble>&,
                                                      const Triple<BoundedDouble>&) const {
        return {};
    }
    virtual PolynomialOf<DoubleDouble> double_double_along(const Triple<DoubleDouble>&,
                                                           const Triple<DoubleDouble>&) const {
        return {};
    }
    virtual Triple<BoundedDouble> bounded_gradient(const Triple<BoundedDouble>&) const { return {}; }
    /// If f is no polynomial, but the distance to a convex union of sets that polynomials bound: these; else none.
    virtual std::vector<std::vector<std::unique_ptr<Surface>>> pieces() const { return {}; }
};
using SurfaceSet = std::vector<std::unique_ptr<Surface>>;

template <class F>
class SurfaceOf final : public Surface {
public:
    explicit SurfaceOf(F f) : f_(std::move(f)) {}
    quad terms() const override { return f_.terms(); }
    quad terms_at(const QVec& p) const override {
        if constexpr (fading)
            return smaller(f_.terms(), f_.terms_at(p.x, p.y, p.z));
        else
            return f_.terms();
    }
    double terms_at_in_double(double x, double y, double z) const override {
        if constexpr (fading)
            return std::min(to_double(f_.terms()), f_.terms_at(x, y, z));
        else
            return to_double(f_.terms());
    }
    quad value(const QVec& p) const override { return f_(p.x, p.y, p.z); }
    QVec gradient(const QVec& p) const override {
        return f_(Jet(p.x, {1, 0, 0}), Jet(p.y, {0, 1, 0}), Jet(p.z, {0, 0, 1})).gradient;
    }
    Polynomial along(const QVec& o, const QVec& d) const override { return along_line<Polynomial>(o, d); }
    const QVec* plane_normal() const override {
        if constexpr (requires(const F& f) { f.normal; })
            return &f_.normal;
        else
            return nullptr;
    }
    bool is_polynomial() const override { return true; }
    PolynomialOf<BoundedDouble> bounded_along(const Triple<BoundedDouble>& o,
                                              const Triple<BoundedDouble>& d) const override {
        return along_line<PolynomialOf<BoundedDouble>>(o, d);
    }
    PolynomialOf<DoubleDouble> double_double_along(const Triple<DoubleDouble>& o,
                                                   const Triple<DoubleDouble>& d) const override {
        return along_line<PolynomialOf<DoubleDouble>>(o, d);
    }
    Triple<BoundedDouble> bounded_gradient(const Triple<BoundedDouble>& p) const override {
        const BoundedDouble no(0.0), one(1.0);
        return f_(BoundedJet{p.x, {one, no, no}}, BoundedJet{p.y, {no, one, no}}, BoundedJet{p.z, {no, no, one}})
            .gradient;
    }

private:
    static constexpr bool fading = requires(const F& f, quad x) { f.terms_at(x, x, x); };

    template <class P, class V>
    P along_line(const V& o, const V& d) const {
        return f_(P::linear(o.x, d.x), P::linear(o.y, d.y), P::linear(o.z, d.z));
    }

    F f_;
};

/// F as RayFunctionOf wants it, and `terms`.
template <class F>
class CurvedSurface final : public Surface {
public:
    explicit CurvedSurface(F f) : f_(std::move(f)) {}
    quad terms() const override { return f_.terms(); }
    quad value(const QVec& p) const override { return f_.value(p); }
    QVec gradient(const QVec& p) const override { return f_.gradient(p); }
    Polynomial along(const QVec&, const QVec&) const override { throw std::logic_error("f is no polynomial"); }
    std::unique_ptr<RayFunction> ray_function(const QVec& o, const QVec& d) const override {
        return std::make_unique<RayFunctionOf<F>>(f_, o, d);
    }
    std::vector<SurfaceSet> pieces() const override {
        if constexpr (requires(const F& f) { f.pieces_of_hull(); })
            return f_.pieces_of_hull();
        else
            return {};
    }

private:
    F f_;
};

/// normal . p <= distance.
struct PlaneFunction {
    QVec normal;
    quad distance;
    quad terms() const { return 0; }
    template <class T>
    T operator()(const T& x, const T& y, const T& z) const {
        return T(normal.x) * x + T(normal.y) * y + T(normal.z) * z - T(distance);
    }
};

inline constexpr double ulps = 16;  ///< roundings that a solver may add up

struct ImplicitSolid {
    QAffine to_world;  ///< own frame -> world
    QAffine to_local;  ///< and back
    std::vector<std::unique_ptr<Surface>> surfaces;
    bool bounded = true;
    QVec center;        ///< world; unbounded: a point of the boundary
    double radius = 0;  ///< of a sphere around `center` that holds the solid; unbounded: 0
    double size = 0;    ///< what errors are measured in, millimetres: `radius`, or the placement of an unbounded solid
    double placement = 0;  ///< |M||v| + |translation|: how large the numbers were that gave the solid its place
    double condition = 1;  ///< by how much the solid's shape amplifies the rounding of its parameters; see add_frame

    template <class F>
    void add(F f) {
        surfaces.push_back(std::make_unique<SurfaceOf<F>>(std::move(f)));
    }
    template <class F>
    void add_curved(F f) {
        surfaces.push_back(std::make_unique<CurvedSurface<F>>(std::move(f)));
    }

    /// Is the point inside, its boundary included? To the last bits of 113-bit arithmetic.
    bool contains(const QVec& world) const {
        const QVec p = to_local.point(world);
        for (const auto& surface : surfaces)
            if (surface->value(p) > 0) return false;
        return true;
    }
    /// Unit normal of surface k at a point of the world, along the gradient: outward. Zero where the gradient vanishes.
    QVec normal(std::size_t k, const QVec& world) const {
        const QVec* plane = surfaces[k]->plane_normal();
        const QVec g = to_local.transposed(plane != nullptr ? *plane : surfaces[k]->gradient(to_local.point(world)));
        return dot(g, g) > 0 ? unit(g) : QVec{};
    }
    /// Rounding in the evaluation of f_k.
    quad noise(std::size_t k) const { return quad(ulps * double_epsilon) * surfaces[k]->terms(); }
    /// The same at a point (own frame).
    quad noise(std::size_t k, const QVec& local) const {
        return quad(ulps * double_epsilon) * surfaces[k]->terms_at(local);
    }
    /// By how much it displaces surface k near a point of the world, millimetres.
    quad blur(std::size_t k, const QVec& world) const {
        if (surfaces[k]->plane_normal() != nullptr) return 0;
        const QVec local = to_local.point(world);
        const quad slope = length(to_local.transposed(surfaces[k]->gradient(local)));
        const quad doubt = noise(k, local);
        return doubt < slope * quad(size) ? doubt / slope : quad(size);
    }
    /// The largest change of f_k when the point (own frame) moves by `distance` in the world, sampled along the axes.
    /// Unlike distance x |gradient| it holds at singular points (the apex of a cone), too.
    quad change(std::size_t k, const QVec& local, quad distance) const {
        if (const QVec* n = surfaces[k]->plane_normal()) {
            quad most = 0;
            for (const QVec* axis : {&to_local.x, &to_local.y, &to_local.z})
                most = larger(most, absolute(dot(*n, *axis)));
            return most * distance * quad(1.75);
        }
        const quad here = surfaces[k]->value(local);
        quad most = 0;
        for (const QVec& axis : {to_local.x, to_local.y, to_local.z})
            for (const quad step : {distance, -distance})
                most = larger(most, absolute(surfaces[k]->value(local + step * axis) - here));
        return most * quad(1.75);  // sqrt(3), rounded up: from the axes to any direction
    }
};

/// Places a solid whose own frame is `frame` (in the model's space) by the map `m`.
/// condition = || |m| |F| |(m F)^-1| ||, the amplification of componentwise rounding of the map and the frame into
/// displacements of the surface in the world (Skeel 1979): 1 to 3 for orthogonal axes of any lengths, larger under
/// shears.
inline void add_frame(ImplicitSolid& solid, const QAffine& m, const QAffine& frame) {
    solid.to_world = m * frame;
    solid.to_local = solid.to_world.inverse();
    solid.center = solid.to_world.origin;
    const QAffine rounding = componentwise_absolute(m) * componentwise_absolute(frame);
    solid.placement = to_double(length(rounding.origin));
    const QVec ones = componentwise_absolute(solid.to_local).direction({1, 1, 1});
    const QVec most = rounding.direction(ones);
    solid.condition = std::max(1.0, to_double(larger(larger(most.x, most.y), most.z)));
}

}  // namespace csgrt::oracle
