// Rays that just touch a surface, or just miss it: tangents, and rays along faces, along edges, through corners.
#include "build.hpp"

namespace csgrt::stress {
namespace {

/// How far beside: 0, or 1e-15 to 1e-2 to either side.
double beside(Random& random) {
    if (random.below(5) == 0) return 0;
    const double sign = random.sign();
    return sign * random.power_of_ten(-15, -2);
}

/// A direction across `n`, at random.
Vec3 across(const Vec3& n, Random& random) {
    const Vec3 x = any_across(n), y = unit(cross(n, x));
    for (;;) {
        const double a = random.between(-1, 1), b = random.between(-1, 1);
        if (a * a + b * b > 0.01) return unit(a * x + b * y);
    }
}

/// Touches a surface at `point`, of outward unit normal n, along `d`.
void touch(Builder& to, const Vec3& point, const Vec3& n, const Vec3& d, double size) {
    const double back = to.random().whole(1, 3) * size;
    to.ray_through(point + beside(to.random()) * size * n, d, back);
}

}  // namespace

/// A curved solid and another that stands behind or inside it; some touch each other.
StressScene tangent(std::uint64_t seed, std::size_t times) {
    Builder to("tangent", seed, times);
    Random& random = to.random();
    const Vec3 at = seed % 2 == 0 ? Vec3{} : 10 * random.in_cube();
    const Vec3 axis = seed % 4 < 2 ? Vec3{0, 0, 1} : random.direction();
    const Vec3 x = any_across(axis), y = unit(cross(axis, x));
    /// On the unit circle around the axis.
    const auto around = [&] {
        const double a = random.between(-1, 1), b = random.between(-1, 1);
        return unit((a + (a < 0 ? -0.1 : 0.1)) * x + b * y);
    };
    const double r = random.between(1, 5), height = random.between(4, 8);
    Tree first, other = leaf(to.solid(ball(at + 0.25 * r * axis, 0.5 * r)));
    const int count = to.rays(60);
    switch (seed / 4 % 6) {
        case 0: {  // a ball, and one that touches it
            first = leaf(to.solid(ball(at, r)));
            const Vec3 n = random.direction();
            other = leaf(to.solid(ball(at + (random.coin() ? 1.5 : 0.5) * r * n, 0.5 * r)));
            for (int i = 0; i < count; ++i) {
                const Vec3 normal = i % 3 == 0 ? n : random.direction();
                touch(to, at + r * normal, normal, across(normal, random), r);
            }
            break;
        }
        case 1: {  // a cylinder, along its wall too
            first = leaf(to.solid(cylinder(at, height * axis, r)));
            for (int i = 0; i < count; ++i) {
                const Vec3 n = around();
                const Vec3 d = i % 3 == 0 ? axis : across(n, random);
                touch(to, at + random.between(0.2, 0.8) * height * axis + r * n, n, d, r);
            }
            break;
        }
        case 2: {  // a torus: its outer and inner equators, and the circles that it lies on
            const double tube = random.between(0.1, 0.9) * r;
            first = leaf(to.solid(Tor{at, axis, r, tube}));
            for (int i = 0; i < count; ++i) {
                const Vec3 n = around(), middle = at + r * n;
                const int where = i % 4;
                if (where == 0) touch(to, middle + tube * n, n, across(n, random), r);
                if (where == 1) touch(to, middle - tube * n, -1 * n, unit(cross(axis, n)), r);
                if (where == 2) touch(to, middle + tube * axis, axis, across(axis, random), r);
                if (where == 3) {
                    const Vec3 normal = unit(n + random.between(-1, 1) * axis);
                    touch(to, middle + tube * normal, normal, across(normal, random), r);
                }
            }
            break;
        }
        case 3: {  // a cone: along its wall
            first = leaf(to.solid(cone(at, height * axis, r, 0.25 * r)));
            for (int i = 0; i < count; ++i) {
                const Vec3 n = around();
                const Vec3 down = unit(0.75 * r * n - height * axis);
                const Vec3 normal = unit(height * n + 0.75 * r * axis);
                const Vec3 point = at + r * n - random.between(0.2, 0.8) * (0.75 * r * n - height * axis);
                touch(to, point, normal, i % 2 == 0 ? down : across(normal, random), r);
            }
            break;
        }
        case 4: {  // an ellipsoid, thin one way
            const double flat = random.power_of_ten(-2, 0);
            const Vec3 a = r * x, b = 2 * r * y, c = flat * r * axis;
            first = leaf(to.solid(Ell{at, a, b, c}));
            for (int i = 0; i < count; ++i) {
                const Vec3 u = random.direction();
                const Vec3 n = unit(u.x / r * x + u.y / (2 * r) * y + u.z / (flat * r) * axis);
                touch(to, at + u.x * a + u.y * b + u.z * c, n, across(n, random), flat * r);
            }
            break;
        }
        default: {  // a cylinder that touches a plate, and rays along where they touch
            first = leaf(to.solid(cylinder(at, height * axis, r)));
            const Vec3 n = x;
            Arb plate;
            const double s[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
            for (std::size_t i = 0; i < 4; ++i) {
                plate.vertices[i] = at + r * n + s[i][0] * 2 * r * y + (s[i][1] + 1) * 0.5 * height * axis;
                plate.vertices[i + 4] = plate.vertices[i] + r * n;
            }
            other = leaf(to.solid(plate));
            for (int i = 0; i < count; ++i) {
                const Vec3 d = i % 2 == 0 ? axis : across(n, random);
                touch(to, at + r * n + random.between(0.2, 0.8) * height * axis, n, d, r);
            }
            break;
        }
    }
    switch (seed % 3) {
        case 0:
            to.region(first);
            to.region(other);
            break;
        case 1:
            to.region(operate(Operator::difference, {first, other}));
            break;
        default:
            to.region(operate(Operator::union_, {other, first}));
            break;
    }
    return to.take();
}

/// Boxes, wedges, pyramids, cylinders' rims and cones' tips.
StressScene edges(std::uint64_t seed, std::size_t times) {
    Builder to("edges", seed, times);
    Random& random = to.random();
    // On a grid, or anywhere.
    const Vec3 at = 5 * random.in_cube();
    const Matrix place = seed % 2 == 0 ? identity : translation(at) * rotation(random);
    const double a = random.whole(1, 4), b = random.whole(1, 4), c = random.whole(1, 4);
    std::vector<Vec3> corners;
    std::vector<std::array<std::size_t, 2>> lines;
    Tree first;
    const auto arb_of = [&](const std::array<Vec3, 8>& points) {
        Arb arb;
        for (std::size_t i = 0; i < 8; ++i) arb.vertices[i] = moved_point(place, points[i]);
        return leaf(to.solid(arb));
    };
    const std::array<Vec3, 8> block = box({-a, -b, -c}, {a, b, c}).vertices;
    switch (seed / 2 % 4) {
        case 0:
            corners.assign(block.begin(), block.end());
            lines = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
            first = arb_of(block);
            break;
        case 1:  // a pyramid
            corners = {block[0], block[1], block[2], block[3], {0, 0, c}};
            lines = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
            first = arb_of(
                {corners[0], corners[1], corners[2], corners[3], corners[4], corners[4], corners[4], corners[4]});
            break;
        case 2:  // a cone with a tip: corners are the tip and four points of the rim
            corners = {{0, 0, c}, {a, 0, -c}, {0, a, -c}, {-a, 0, -c}, {0, -a, -c}};
            lines = {{0, 1}, {0, 2}, {0, 3}, {0, 4}};
            first = leaf(to.solid(Tgc{moved_point(place, {0, 0, -c}), moved_direction(place, {0, 0, 2 * c}),
                                      moved_direction(place, {a, 0, 0}), moved_direction(place, {0, a, 0}),
                                      moved_direction(place, {0, 0, 0}), moved_direction(place, {0, 0, 0})}));
            break;
        default:  // a cylinder: points of both rims
            corners = {{a, 0, -c}, {0, a, -c}, {-a, 0, -c}, {a, 0, c}, {0, a, c}, {-a, 0, c}};
            lines = {{0, 3}, {1, 4}, {2, 5}};
            first = leaf(to.solid(Tgc{moved_point(place, {0, 0, -c}), moved_direction(place, {0, 0, 2 * c}),
                                      moved_direction(place, {a, 0, 0}), moved_direction(place, {0, a, 0}),
                                      moved_direction(place, {a, 0, 0}), moved_direction(place, {0, a, 0})}));
            break;
    }
    // The second shares the top with the first, and its corner if that is a block.
    const double part = seed / 2 % 4 == 0 ? 1 : 0.5;
    const Tree other = arb_of(box({0, 0, 0}, {part * a, part * b, c}).vertices);
    if (seed % 3 == 0) {
        to.region(operate(Operator::difference, {first, other}));
        to.region(other);
    } else {
        to.region(operate(seed % 3 == 1 ? Operator::union_ : Operator::xor_, {first, other}));
    }
    const double size = a + b + c;
    for (int i = 0; i < to.rays(60); ++i) {
        const auto [from, to_corner] = lines[random.below(static_cast<std::uint32_t>(lines.size()))];
        const Vec3 p = moved_point(place, corners[from]), q = moved_point(place, corners[to_corner]);
        const double by = beside(random);
        const Vec3 off = by * random.direction();
        const Vec3 along = random.coin() ? q - p : p - q;
        const double share = random.between(0.1, 0.9);
        switch (i % 5) {
            case 0:  // through a corner
                to.ray_through(p + off, random.direction(), 3 * size);
                break;
            case 1:  // through an edge
                to.ray_through(p + share * (q - p) + off, random.direction(), 3 * size);
                break;
            case 2:  // along an edge
                to.ray_through(p + off, along, 3);
                break;
            case 3:  // along a face or a rim: across an edge, in the plane of it and another corner
                to.ray_through(p + off,
                               moved_point(place, corners[random.below(static_cast<std::uint32_t>(corners.size()))]) +
                                   0.25 * (q - p) - p,
                               3);
                break;
            default:  // from corner to corner
                to.ray_through(p + off, moved_direction(place, random.axis()), 3 * size);
                break;
        }
    }
    return to.take();
}

}  // namespace csgrt::stress
