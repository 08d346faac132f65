// Families of rays at a solid: what scenes have, and what methods fail on.
#pragma once

#include <iterator>
#include <vector>

#include "intersect.hpp"
#include "random.hpp"

namespace csgrt::oracle {

enum class RayFamily { ordinary, tangent, edge, parallel, far, scaled, inside };
inline constexpr const char* ray_family_names[] = {"ordinary",   "tangent",  "edge-on",    "axis-parallel",
                                                   "far origin", "non-unit", "from inside"};
inline constexpr std::size_t ray_families = std::size(ray_family_names);

/// Points and directions that mean something to a solid, in the world: its
/// edges, corners, axes, generators.
struct Features {
    std::vector<QVec> points, directions;
};

Features features_of(const Shape& shape, const ImplicitSolid& solid);

/// Through corners, along edges, generators and axes, or a hair beside them.
Ray edge_ray(const Features& features, const quad& size, Random& random);

/// Makes rays at one solid.
class RayMaker {
public:
    RayMaker(const Shape& shape, const ImplicitSolid& solid, Random& random);

    Ray make(RayFamily family);

private:
    struct Touched {
        QVec point, normal;
    };
    struct Line {
        QVec origin, direction;
        QVec point(double t) const { return origin + quad(t) * direction; }
    };

    static Ray rounded(const QVec& o, const QVec& d);
    quad size() const { return quad(size_); }

    /// A point in or near the solid: half of the time between two of its
    /// features.
    QVec target();
    /// From `away` sizes around the solid.
    Ray ordinary(double away);
    Ray any();
    const QVec& random_point();

    /// Grazes a point of the surface within 1e-3 to 1e-12 of the size, on either
    /// side.
    Ray tangent();
    /// Exact zeros in the direction, and parallel to a feature's direction.
    Ray parallel();
    Ray inside();

    const ImplicitSolid& solid_;
    Features features_;
    Random& random_;
    double size_;
    Line last_;
    std::vector<Touched> touched_;
};

}  // namespace csgrt::oracle
