// Boxes of convex polyhedra.
//
// A few planes: every two planes meet in a line, and the part of the line inside all other planes is an edge.
//
// Many planes: linear programming in three variables, after Seidel (1991). Planes are added one by one in random order.
// A plane that the best point so far satisfies changes nothing. Otherwise the new best point lies on the plane, and is
// found by the same method in one dimension less. The search begins inside a large cube; a solution that still touches
// the cube at the end is not bounded.

#include "compile/solids/polyhedron.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace csgrt {

namespace {

// The number of planes up to which n^3 is less than the cost of linear programming.
constexpr std::size_t few = 16;
// A limit relative to distances: an edge that is outside a plane by less than this counts as on the plane.
constexpr double on_edge = 1e-12;
// A limit relative to the cube: a point that is outside a plane by less than this counts as on the plane.
constexpr long double on_plane = 1e-15L;
// The angle (radians) below which two planes count as parallel: their intersection is noise, and is left out, so the
// box is larger.
constexpr double parallel = 1e-10;

/// A constraint sum n_i x_i <= d over N variables.
template <std::size_t N>
struct Constraint {
    std::array<long double, N> n;
    long double d;
};
template <std::size_t N>
using Point = std::array<long double, N>;

template <std::size_t N>
long double dot(const std::array<long double, N>& a, const std::array<long double, N>& b) {
    long double sum = 0;
    for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
    return sum;
}

/// The border of a constraint. On the border variable k, which has the largest coefficient, follows from the other
/// variables.
template <std::size_t N>
struct Border {
    Constraint<N> c;
    std::size_t k = 0;
    long double inverse;

    explicit Border(const Constraint<N>& constraint) : c(constraint) {
        for (std::size_t j = 1; j < N; ++j)
            if (std::fabs(c.n[j]) > std::fabs(c.n[k])) k = j;
        inverse = 1 / c.n[k];
    }

    /// The other constraint, restricted to this border.
    Constraint<N - 1> operator()(const Constraint<N>& other) const {
        Constraint<N - 1> result;
        const long double factor = other.n[k] * inverse;
        for (std::size_t j = 0, m = 0; j < N; ++j)
            if (j != k) result.n[m++] = other.n[j] - factor * c.n[j];
        result.d = other.d - factor * c.d;
        return result;
    }
    Point<N> lift(const Point<N - 1>& p) const {
        Point<N> result;
        long double rest = c.d;
        for (std::size_t j = 0, m = 0; j < N; ++j) {
            if (j == k) continue;
            result[j] = p[m++];
            rest -= c.n[j] * result[j];
        }
        result[k] = rest * inverse;
        return result;
    }
};

/// Appends a constraint with a normal of about unit length. Returns false if the constraint cannot be satisfied.
/// Appends nothing if the constraint always holds.
template <std::size_t N>
bool append(std::vector<Constraint<N>>& constraints, Constraint<N> c, long double reach) {
    const long double square = dot(c.n, c.n);
    if (square < static_cast<long double>(parallel * parallel)) return c.d >= -parallel * reach;
    if (square < 0.1L || square > 10) {
        const long double inverse = 1 / std::sqrt(square);
        for (long double& n : c.n) n *= inverse;
        c.d *= inverse;
    }
    constraints.push_back(c);
    return true;
}

/// The point of the cube |x_i| <= reach that satisfies the constraints and is farthest along `aim`.
template <std::size_t N>
std::optional<Point<N>> farthest(const std::vector<Constraint<N>>& constraints, const Point<N>& aim,
                                 long double reach) {
    Point<N> best;
    for (std::size_t i = 0; i < N; ++i) best[i] = aim[i] < 0 ? -reach : reach;
    if constexpr (N == 1) {
        long double low = -reach, high = reach;
        for (const Constraint<1>& c : constraints) {
            if (c.n[0] > 0) high = std::min(high, c.d / c.n[0]);
            if (c.n[0] < 0) low = std::max(low, c.d / c.n[0]);
        }
        if (low > high + on_plane * reach) return std::nullopt;
        best[0] = aim[0] < 0 ? std::min(low, high) : std::max(low, high);
    } else {
        std::vector<Constraint<N - 1>> there;
        for (std::size_t i = 0; i < constraints.size(); ++i) {
            if (dot(constraints[i].n, best) <= constraints[i].d + on_plane * reach) continue;
            const Border<N> border(constraints[i]);
            there.clear();
            for (std::size_t j = 0; j < i; ++j)
                if (!append(there, border(constraints[j]), reach)) return std::nullopt;
            for (const int side : {-1, 1}) {
                Constraint<N> face{{}, reach};
                face.n[border.k] = side;
                if (!append(there, border(face), reach)) return std::nullopt;
            }
            const auto lower = farthest<N - 1>(there, border({aim, 0}).n, reach);
            if (!lower) return std::nullopt;
            best = border.lift(*lower);
        }
    }
    return best;
}

/// The box of the part that lies in the cube of half-width `reach` around `center`.
std::optional<Box> box_within(const std::vector<Plane>& planes, const Wide& center, long double reach) {
    std::vector<Constraint<3>> constraints;
    for (const Plane& plane : planes) {
        const Wide n = wide(plane.normal);
        append<3>(constraints, {{n.x, n.y, n.z}, plane.distance - glm::dot(n, center)}, reach);
    }
    Wide low(0), high(0);
    for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) {
            Point<3> aim{};
            aim[static_cast<std::size_t>(axis)] = side;
            const auto point = farthest<3>(constraints, aim, reach);
            if (!point) return std::nullopt;
            (side < 0 ? low : high)[axis] = (*point)[static_cast<std::size_t>(axis)];
        }
    }
    return Box{narrow(center + low), narrow(center + high)};
}

/// The box around all edges, if there are any. Distances are taken from `near`.
std::optional<Box> box_of_edges(const std::vector<Plane>& planes, const Vec3& near) {
    struct Side {
        glm::dvec3 n;
        double d;
    };
    std::vector<Side> sides;
    for (const Plane& plane : planes) {
        const glm::dvec3 n(plane.normal.x, plane.normal.y, plane.normal.z);
        sides.push_back({n, static_cast<double>(plane.distance - glm::dot(wide(plane.normal), wide(near)))});
    }
    Box box = empty_box;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const auto &a = sides[i], &b = sides[j];
            const glm::dvec3 across = glm::cross(a.n, b.n);
            const double square = glm::dot(across, across);
            if (square < parallel * parallel) continue;
            const glm::dvec3 on = (a.d * glm::cross(b.n, across) + b.d * glm::cross(across, a.n)) / square;
            const glm::dvec3 along = across / std::sqrt(square);
            const double slack = on_edge * (glm::length(on) + std::fabs(a.d) + std::fabs(b.d));
            double low = -infinity, high = infinity;
            for (std::size_t k = 0; k < sides.size() && low <= high + slack; ++k) {
                if (k == i || k == j) continue;
                const double rate = glm::dot(sides[k].n, along), above = glm::dot(sides[k].n, on) - sides[k].d;
                if (rate > parallel) {
                    high = std::min(high, -above / rate);
                } else if (rate < -parallel) {
                    low = std::max(low, -above / rate);
                } else if (above > slack) {
                    high = -infinity;
                }
            }
            if (!(low <= high + slack)) continue;
            if (low == -infinity || high == infinity) return whole_space;
            for (const double t : {low, high}) {
                const glm::dvec3 p = on + t * along;
                extend(box, {near.x + p.x, near.y + p.y, near.z + p.z});
            }
        }
    }
    if (is_empty(box)) return std::nullopt;
    return box;
}

}  // namespace

Box polyhedron_box(const std::vector<Plane>& planes, const Vec3& near) {
    if (planes.size() <= few)
        if (const std::optional<Box> box = box_of_edges(planes, near)) return *box;

    std::vector<Plane> shuffled = planes;
    std::uint64_t random = 0x9e3779b97f4a7c15u;  // a fixed seed: the same planes, the same box
    for (std::size_t i = shuffled.size(); i > 1; --i) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        std::swap(shuffled[i - 1], shuffled[(random >> 33) % i]);
    }

    // Where planes meet at a small angle, vertices may lie far beyond the points of the planes that are nearest to the
    // origin.
    long double foot = 0;
    for (const Plane& plane : planes) foot = std::max(foot, static_cast<long double>(std::fabs(plane.distance)));
    const long double reach = 1e6L * (foot > 0 ? foot : 1);
    std::optional<Box> box = box_within(shuffled, Wide(0), reach);
    if (!box) return empty_box;
    const double limit = static_cast<double>(0.999L * reach);
    const auto far = [&](const Vec3& p) {
        return std::fabs(p.x) > limit || std::fabs(p.y) > limit || std::fabs(p.z) > limit;
    };
    if (far(box->low) || far(box->high)) return whole_space;

    // The second search runs in a cube of the solid's own size: rounding is relative to the cube.
    const Wide center = 0.5L * (wide(box->low) + wide(box->high));
    const long double size = diagonal(*box) + 1e-9L * reach;
    const std::optional<Box> finer = box_within(shuffled, center, size);
    return finer ? *finer : *box;
}

}  // namespace csgrt
