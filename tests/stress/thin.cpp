// Next to nothing: shells, slivers, and solids at the limits of their types.
#include "build.hpp"

namespace csgrt::stress {

/// Shells of 10^-9 to 10^-1 of their radius, plates and needles as thin, and wedges between faces that are nearly one.
StressScene slivers(std::uint64_t seed, std::size_t times) {
    Builder to("slivers", seed, times);
    Random& random = to.random();
    // Surfaces closer than 1e-10 of their solids' sizes are one when the scene is compiled: these stay above.
    const std::uint64_t kind = seed / 9 % 7;
    const int power = -static_cast<int>(1 + seed % 9);
    const double size = random.whole(1, 16), thin = size * random.power_of_ten(power, power);
    const Matrix turn = seed % 2 == 0 ? identity : rotation(random);
    const auto d = [&](double x, double y, double z) { return moved_direction(turn, {x, y, z}); };
    const auto arb = [&](const Arb& upright) {
        Arb turned = upright;
        for (Vec3& v : turned.vertices) v = moved_point(turn, v);
        return leaf(to.solid(turned));
    };
    /// The first less the second.
    const auto less = [&](const std::vector<Tree>& two) { return operate(Operator::difference, two); };
    switch (kind) {
        case 0:
            to.region(less({leaf(to.solid(ball({}, size))), leaf(to.solid(ball({}, size - thin)))}));
            break;
        case 1:
            to.region(less({leaf(to.solid(cylinder(d(0, 0, -size), d(0, 0, 2 * size), size))),
                            leaf(to.solid(cylinder(d(0, 0, -2 * size), d(0, 0, 4 * size), size - thin)))}));
            break;
        case 2:  // layers, each a region
            for (int i = 0; i < 4; ++i) to.region(arb(box({-size, -size, i * thin}, {size, size, (i + 1) * thin})));
            break;
        case 3:
            to.region(less({leaf(to.solid(Tor{{}, d(0, 0, 1), size, 0.25 * size})),
                            leaf(to.solid(Tor{{}, d(0, 0, 1), size, 0.25 * size - thin}))}));
            break;
        case 4:  // a needle, and a ball that it sticks in
            to.region(arb(box({-thin, -0.5 * thin, -size}, {thin, 0.5 * thin, size})));
            to.region(less({leaf(to.solid(ball({}, 0.5 * size))), leaf(to.solid(ball({}, 0.25 * size)))}));
            break;
        case 5: {  // a block less one whose top leans against its own
            Arb leaning = box({-2 * size, -2 * size, -2 * size}, {2 * size, 2 * size, 0});
            for (const std::size_t i : {4u, 5u, 6u, 7u})
                leaning.vertices[i].z = leaning.vertices[i].x > 0 ? thin : -thin;
            to.region(less({arb(box({-size, -size, -size}, {size, size, 0})), arb(leaning)}));
            break;
        }
        default:  // an eggshell between two ellipsoids
            to.region(
                less({leaf(to.solid(Ell{{}, size * d(1, 0, 0), 0.75 * size * d(0, 1, 0), 0.5 * size * d(0, 0, 1)})),
                      leaf(to.solid(Ell{{},
                                        (size - thin) * d(1, 0, 0),
                                        (0.75 * size - thin) * d(0, 1, 0),
                                        (0.5 * size - thin) * d(0, 0, 1)}))}));
            break;
    }
    for (int i = 0; i < to.rays(60); ++i) {
        Vec3 through = size * random.in_cube();
        if (kind == 4 && i % 2 == 0)  // at the needle
            through = moved_point(turn, {thin * random.between(-2, 2), thin * random.between(-1, 1), through.z});
        to.ray_through(through, i % 5 == 0 ? random.axis() : random.direction(), 4 * size);
    }
    return to.take();
}

/// Semi-axes and radii of very different lengths, tips that are all but points, sides that are all but parallel.
StressScene degenerate(std::uint64_t seed, std::size_t times) {
    Builder to("degenerate", seed, times);
    Random& random = to.random();
    const int power = -static_cast<int>(1 + seed / 14 % 6);
    const double e = random.power_of_ten(power, power);
    const Vec3 z = seed % 2 == 0 ? Vec3{0, 0, 1} : random.direction(), x = any_across(z), y = unit(cross(z, x));
    const double r = random.between(1, 4), h = random.between(2, 6);
    // Points of the solid: what rays are sent through.
    Vec3 reach = r * x + r * y + h * z;
    Shape shape;
    switch (seed % 14) {
        case 0:  // a disc
            shape = Ell{{}, r * x, r * y, e * z};
            reach = r * x + r * y + e * z;
            break;
        case 1:  // a needle
            shape = Ell{{}, e * x, e * y, h * z};
            reach = e * x + e * y + h * z;
            break;
        case 2:  // a cone that all but has a tip
            shape = cone({}, h * z, r, e * r);
            break;
        case 3:  // a cone that all but is a cylinder
            shape = cone({}, h * z, r, r * (1 - e));
            break;
        case 4:  // leaning far over
            shape = Tgc{{}, h * x + std::max(e, 1e-3) * h * z, r * x, r * y, r * x, r * y};
            reach = 2 * h * x + r * y + std::max(e, 1e-3) * h * z;
            break;
        case 5:  // a wire
            shape = Tor{{}, z, r, e * r};
            reach = r * x + r * y + e * r * z;
            break;
        case 6:  // a torus whose hole is all but closed, or closed
            shape = Tor{{}, z, r, seed / 14 % 6 == 0 ? r : r * (1 - e)};
            reach = 2 * r * x + 2 * r * y + r * z;
            break;
        case 7:  // the two balls all but one in the other
            shape = Part{{}, h * z, r + h * (1 - e), r};
            break;
        case 8:  // a hyperboloid that all but is a cone, or a paraboloid
            shape = Ehy{{}, h * z, x, r, 0.5 * r, seed % 4 < 2 ? e : 1 / e};
            break;
        case 9:  // a prism whose ends are all but one
            shape = Arb{{-1 * r * x - r * y, r * x - r * y, r * x + r * y, r * y - r * x, e * z - r * x - r * y,
                         e * z + r * x - r * y, e * z + r * x + r * y, e * z + r * y - r * x}};
            reach = r * x + r * y + e * z;
            break;
        case 10:  // a roof whose ridge is all but flat
            shape = Arb{{-1 * r * x - r * y, r * x - r * y, r * x + r * y, r * y - r * x, e * z - 0.5 * r * x,
                         e * z + 0.5 * r * x, e * z + 0.5 * r * x, e * z - 0.5 * r * x}};
            reach = r * x + r * y + e * z;
            break;
        case 11:  // a waist of next to nothing, or none to speak of
            shape = Hyp{{}, h * z, r * x, 0.5 * r, seed % 4 < 2 ? std::max(e, 1e-4) : 1 - e};
            break;
        case 12:  // a thin elliptical ring
            shape = Eto{{}, z, 0.5 * r * z, r, std::max(e, 1e-3) * r};
            reach = r * x + r * y + 0.5 * r * z;
            break;
        default:  // a flat elliptical cylinder
            shape = Tgc{{}, h * z, r * x, e * y, 0.5 * r * x, 0.5 * e * y};
            reach = r * x + e * y + h * z;
            break;
    }
    const Tree thing = leaf(to.solid(shape));
    if (seed % 3 == 0) {
        to.region(thing);
    } else {
        const Tree other = leaf(to.solid(ball(0.5 * r * x, 0.75 * r)));
        to.region(operate(seed % 3 == 1 ? Operator::difference : Operator::union_, {thing, other}));
    }
    const Vec3 size{dot(reach, x), dot(reach, y), dot(reach, z)};
    for (int i = 0; i < to.rays(60); ++i) {
        const Vec3 in = random.in_cube();
        const Vec3 through = size.x * in.x * x + size.y * in.y * y + size.z * in.z * z;
        const Vec3 d = i % 6 == 0 ? x : i % 6 == 1 ? y : i % 6 == 2 ? z : random.direction();
        to.ray_through(through, d, 20);
    }
    return to.take();
}

}  // namespace csgrt::stress
