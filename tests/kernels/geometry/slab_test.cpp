// A ray against a box of the hierarchy: no box is missed that a ray meets, not by rays along its sides, nor by
// directions whose components are nothing, next to nothing or below what a float holds.
#include "catch.hpp"

#include <array>
#include <cmath>
#include <iterator>

#include "compile/bvh/build.hpp"
#include "kernel_host/geometry.hpp"
#include "oracle/random.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

using Triple = std::array<double, 3>;

constexpr double small_parts[] = {0, -0.0, 1e-6, -1e-12, 1e-20, -1e-29, 1e-30, -1e-31, 1e-38, -1e-41, 1e-300, -5e-324};
constexpr double radii[] = {1, 0x1p-90, 1e-6, 1e6, 0x1p+90};

struct Case {
    double radius;
    Triple low, high, origin, direction;

    kernel::BvhNode node() const {
        const Box box{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
        return build_bvh({box}, {0, 0, 0}, radius, 0).nodes.front();
    }
    kernel::slab_ray ray() const {
        const kernel::wide3 o = kernel::make_wide3(origin[0], origin[1], origin[2]);
        return kernel::make_slab_ray(kernel::offset_from(kernel::make_wide3(0, 0, 0), o),
                                     kernel::make_vec3(direction[0], direction[1], direction[2]), radius,
                                     -kernel::REAL_INFINITY);
    }
};

// A box within the sphere, some of them flat, and a ray one or two of whose components are small.
Case random_case(oracle::Random& random) {
    Case c{};
    c.radius = radii[random.below(std::size(radii))];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double a = random.between(-0.57, 0.57), b = random.below(4) == 0 ? a : random.between(-0.57, 0.57);
        c.low[axis] = c.radius * std::fmin(a, b);
        c.high[axis] = c.radius * std::fmax(a, b);
        c.direction[axis] = random.between(-1, 1);
    }
    const std::size_t small = random.below(3), kept = random.below(3);
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (axis == small || (axis != kept && random.coin()))
            c.direction[axis] = small_parts[random.below(std::size(small_parts))];
    if (small == kept) c.direction[(small + 1) % 3] = random.sign();
    return c;
}

void start_before(Case& c, const Triple& target, double steps) {
    for (std::size_t axis = 0; axis < 3; ++axis) c.origin[axis] = target[axis] - steps * c.radius * c.direction[axis];
}

}  // namespace

TEST_CASE("geometry: a ray through a point of a box meets it, whatever its direction") {
    oracle::Random random(31);
    for (int i = 0; i < test::tries(40'000); ++i) {
        Case c = random_case(random);
        Triple target;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t where = random.below(4);
            target[axis] = where == 0   ? c.low[axis]
                           : where == 1 ? c.high[axis]
                                        : random.between(c.low[axis], c.high[axis]);
        }
        start_before(c, target, random.between(-2, 2));
        const kernel::slab_ray ray = c.ray();
        INFO("radius " << c.radius << ", direction " << c.direction[0] << ' ' << c.direction[1] << ' '
                       << c.direction[2]);
        REQUIRE(ray.hits_sphere);
        for (const float inverse : {ray.ix, ray.iy, ray.iz}) REQUIRE(std::isfinite(inverse));
        const kernel::BvhNode node = c.node();
        REQUIRE(kernel::box_is_hit(ray, node));
        float out = 0;
        const float in = kernel::box_passage(ray, node, &out);
        REQUIRE_FALSE(std::isnan(in));
        REQUIRE_FALSE(std::isnan(out));
        REQUIRE(kernel::box_entry(ray, node) == in);
        // No later than at the point itself.
        double length = 0;
        for (double d : c.direction) length += d * d;
        length = std::sqrt(length);
        double at = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) at += target[axis] * (c.direction[axis] / length);
        REQUIRE(in <= at + 1e-5 * c.radius);
    }
}

TEST_CASE("geometry: a ray along a side of a box, and beside it, misses it") {
    oracle::Random random(32);
    for (int i = 0; i < test::tries(40'000); ++i) {
        Case c = random_case(random);
        const std::size_t axis = random.below(3);
        Triple target;
        for (std::size_t k = 0; k < 3; ++k) target[k] = random.between(c.low[k], c.high[k]);
        target[axis] = random.coin() ? c.high[axis] + 4e-6 * c.radius : c.low[axis] - 4e-6 * c.radius;
        c.direction = {random.between(0.1, 1), random.between(-1, -0.1), random.between(0.1, 1)};
        const double components[] = {0, -0.0, 1e-20, -1e-31, 1e-300};
        c.direction[axis] = components[random.below(std::size(components))];
        start_before(c, target, random.between(-2, 2));
        INFO("radius " << c.radius << ", axis " << axis << ", direction " << c.direction[axis]);
        REQUIRE_FALSE(kernel::box_is_hit(c.ray(), c.node()));
    }
}
