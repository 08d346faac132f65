// Rays through the points where a surface pinches or ends in a tip, along its axis and across, and as close beside
// them.
#include "build.hpp"

namespace csgrt::stress {
namespace {

/// 0, or 1e-13 to 1e-3 of any mantissa.
double little(Random& random) {
    if (random.below(6) == 0) return 0;
    const double digits = random.between(1, 10);
    return digits * random.power_of_ten(-13, -4);
}

/// A place where a solid's surface is singular.
struct Pinch {
    Vec3 point;
    Vec3 axis;   ///< through it, unit
    Vec3 along;  ///< across the axis, unit: of an edge, its direction
};

/// The profile of a body of revolution between two tips on the axis, around which it is turned.
Sketch lens(double radius, double height) {
    Sketch sketch;
    sketch.vertices = {{0, -height}, {radius, 0.25 * height}, {0, height}};
    sketch.curves = {Sketch::Line{0, 1}, Sketch::Line{1, 2}, Sketch::Line{2, 0}};
    sketch.reversed = {0, 0, 0};
    return sketch;
}

}  // namespace

/// Horn and near-horn tori, apexes and edge tops of cones, pointed particles, hyperboloids that all but are cones,
/// poles of superellipsoids and hearts, bodies of revolution with tips.
StressScene pinch(std::uint64_t seed, std::size_t times) {
    Builder to("pinch", seed, times);
    Random& random = to.random();
    // Every other solid stands upright at the origin, where the rays' offsets keep all their digits.
    const bool upright = seed / pinch_kinds % 2 == 0;
    const Vec3 z = upright ? Vec3{0, 0, 1} : random.direction(), x = upright ? Vec3{1, 0, 0} : any_across(z);
    const Vec3 y = cross(z, x), at = upright ? Vec3{} : 5 * random.in_cube();
    const double r = random.between(1, 4), q = random.between(1, 4), h = random.between(2, 6);
    const double share = random.between(0.2, 0.8), digits = random.between(1, 10);
    const double near = digits * random.power_of_ten(-15, -4);
    const double size = r + q + h;
    const std::uint64_t round = seed / pinch_kinds;
    std::vector<Pinch> pinches{{at, z, x}};
    Shape shape;
    switch (seed % pinch_kinds) {
        case 0:  // a torus that touches itself
            shape = Tor{at, z, r, r};
            break;
        case 1:  // one that all but does
            shape = Tor{at, z, r, r * (1 - near)};
            break;
        case 2:  // elliptical tori that touch themselves, or all but do: in the middle; and, leaning, below it
            if (round % 3 == 0) shape = Eto{at, z, r * x, r, 0.25 * q};
            if (round % 3 == 1) shape = Eto{at, z, h * z, r * (1 + near), r};
            if (round % 3 == 2) {
                // An ellipse of semi-axes c = (3/4, 1) and d = 5/16 sqrt 7 across is 1 wide to either side along the
                // radius; it is widest at the height 3/4 (1 - d^2 / c^2).
                shape = Eto{at, z, 0.75 * r * x + r * z, r, 0.3125 * std::sqrt(7) * r};
                pinches.front().point = at - 0.421875 * r * z;
            }
            break;
        case 3:  // cones with an apex, upright and leaning
            shape = Tgc{at - h * z, h * z, r * x, q * y, {}, {}};
            if (round % 4 >= 2) shape = Tgc{at - h * z - share * x, h * z + share * x, r * x, q * y, {}, {}};
            break;
        case 4:  // standing on it
            shape = Tgc{at, h * z, {}, {}, r * x, (round % 4 < 2 ? r : q) * y};
            break;
        case 5:  // a top that is an edge
            shape = Tgc{at - h * z, h * z, r * x, q * y, share * r * x, {}};
            if (round % 4 >= 2) shape = Tgc{at - h * z, h * z, r * y, q * x, {}, share * q * x};
            pinches.push_back({at + random.between(-1, 1) * share * (round % 4 < 2 ? r : q) * x, z, x});
            break;
        case 6:  // a top that all but is an edge, or a point
            shape = Tgc{at - h * z, h * z, r * x, q * y, (round % 4 < 2 ? share : near) * r * x, near * q * y};
            break;
        case 7:  // particles with a point
            if (round % 4 < 2)
                shape = Part{at - (h + r) * z, (h + r) * z, r, 0};
            else
                shape = Part{at, (h + r) * z, 0, r};
            break;
        case 8:  // hyperboloids that all but are cones
            shape = Ehy{at - h * z, h * z, x, r, q, near * h};
            break;
        case 9:  // and of one sheet
            shape = Hyp{at - h * z, 2 * h * z, r * x, q, std::max(near, 1e-9)};
            break;
        case 10: {  // stars and double cones
            const double n = round % 3 == 0 ? 2 : random.between(2, 4), e = round % 3 == 1 ? 1 : random.between(1, 4);
            shape = Superell{at, r * x, q * y, h * z, n, e};
            pinches = {{at + h * z, z, x}, {at - h * z, z, x}, {at + r * x, x, y}, {at + q * y, y, z}, {at, z, x}};
            break;
        }
        case 11:  // a heart's dimples
            shape = Hrt{at, r * x, q * y, h * z, 1};
            pinches = {{at + h * z, z, x}, {at - h * z, z, x}};
            break;
        default:  // turned about an axis that the outline ends on
            shape = Revolve{at, z, x, 6.283185307179586, lens(r, h)};
            pinches = {{at + h * z, z, x}, {at - h * z, z, x}};
            break;
    }
    const Tree thing = leaf(to.solid(shape));
    switch (round % 3) {
        case 0:
            to.region(thing);
            break;
        case 1:
            to.region(operate(Operator::difference, {leaf(to.solid(ball(at, 3 * size))), thing}));
            break;
        default:
            to.region(thing);
            to.region(leaf(to.solid(ball(at + 4 * size * x, size))));
            break;
    }
    for (int i = 0; i < to.rays(60); ++i) {
        const Pinch& p = pinches[random.below(static_cast<std::uint32_t>(pinches.size()))];
        const Vec3 side = cross(p.axis, p.along);
        const auto around = [&] {
            const double a = random.between(-1, 1), b = random.between(-1, 1);
            return unit((a + (a < 0 ? -0.1 : 0.1)) * p.along + b * side);
        };
        Vec3 d = random.sign() * p.axis;
        switch (i % 6) {
            case 3:  // across the axis
                d = around();
                break;
            case 4:
                d = random.sign() * p.along;
                break;
            case 5:
                d = random.direction();
                break;
            default:
                break;
        }
        const double tilt = little(random), off = little(random), back = random.between(2, 4);
        const Vec3 lean = i % 6 < 3 ? around() : random.direction(), beside = i % 6 < 3 ? around() : random.direction();
        // Leaning about the pinch itself, or about where the ray starts.
        d = d + tilt * lean;
        const Vec3 through = p.point + off * size * beside;
        to.ray_through(through, d, back * size);
    }
    return to.take();
}

}  // namespace csgrt::stress
