// Very far and very large or small.
#include "build.hpp"

namespace csgrt::stress {
namespace {

/// Some solids, all within 20 of the origin, in one or two regions.
void some_model(Builder& to, const Matrix& place) {
    Random& random = to.random();
    const int regions = random.whole(1, 2);
    for (int i = 0; i < regions; ++i) {
        std::vector<std::string> solids;
        const int count = random.whole(2, 4);
        for (int k = 0; k < count; ++k) solids.push_back(some_solid(to));
        const std::string together = to.combination(some_tree(solids, random));
        to.region(leaf(together, place));
    }
}

}  // namespace

/// Rays that start up to 10^8 sizes away; models that stand up to 10^8 sizes from the origin.
StressScene far_origin(std::uint64_t seed, std::size_t times) {
    Builder to("far_origin", seed, times);
    Random& random = to.random();
    const bool model_is_far = seed % 3 == 2;
    // Whole numbers of 2^-10, so that the sum with a place on a grid is exact; 2^27 is 1.3e8.
    const double far = std::ldexp(random.between(1, 2), static_cast<int>(seed / 3 % 9) * 3 + 3);
    Vec3 place;
    if (model_is_far) {
        const Vec3 d = random.direction();
        place = {std::round(far * d.x), std::round(far * d.y), std::round(far * d.z)};
    }
    some_model(to, translation(place));
    for (int i = 0; i < to.rays(60); ++i) {
        const Vec3 d = i % 5 == 0 ? random.axis() : random.direction();
        const double back = 20 * (model_is_far ? random.whole(0, 3) : far);
        const double length = seed % 2 == 0 ? 1 : random.power_of_ten(-4, 4);
        const Vec3 through = place + 6 * random.in_cube();
        to.ray(through - back * d, length * d);
    }
    return to.take();
}

/// A model of 10^-6 to 10^6 times the usual size, in whole powers of 10 or of 2.
StressScene scale(std::uint64_t seed, std::size_t times) {
    Builder to("scale", seed, times);
    Random& random = to.random();
    const int decades = static_cast<int>(seed % 13) - 6;
    const double by = seed / 13 % 2 == 0 ? random.power_of_ten(decades, decades)
                                         : std::ldexp(1.0, static_cast<int>(std::lround(decades * 3.25)));
    some_model(to, scaling(by));
    for (int i = 0; i < to.rays(60); ++i) {
        const Vec3 d = i % 5 == 0 ? random.axis() : random.direction();
        const Vec3 through = 6 * random.in_cube();
        to.ray(by * (through - (i % 4 == 2 ? 0 : 50) * d), (i % 3 == 0 ? by : 1) * d);
    }
    return to.take();
}

}  // namespace csgrt::stress
