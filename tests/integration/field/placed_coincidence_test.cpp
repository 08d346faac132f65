// Solids that share surfaces in a frame of their own, placed far away and turned: what coincides there coincides
// wherever the frame is put. Judged by the oracle, for which a skin that only rounding has made is none.
#include "integration/field/judge.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::test;
using namespace csgrt::stress;

namespace {

constexpr std::size_t kinds = 6;

/// A - B, A and B, and B alone of one kind, where faces of the two coincide: 10^6 to 10^10 mm away. `turned`: about
/// some axis.
StressScene placed(std::uint64_t seed, int rays) {
    Builder to("placed", seed, 1);
    Random& random = to.random();
    const double far = random.power_of_ten(6, 10) * random.between(0.2, 1);
    const Matrix place = translation(far * random.direction()) * (seed % 2 ? rotation(random) : identity);
    const double a = random.between(40, 60), b = random.between(20, 30), h = random.between(10, 30);
    const Vec3 up{0, 0, h};
    const std::uint64_t kind = seed / 2 % kinds;
    Shape first, second;
    switch (kind) {
        case 0:  // a corner of a block
            first = box({0, 0, 0}, {a, a, h});
            second = box({b, -b, 0}, {a, b, h});
            break;
        case 1:  // a hole through it
            first = box({-a, -a, 0}, {a, a, h});
            second = cylinder({}, up, b);
            break;
        case 2:  // a plug in a rod
            first = cylinder({}, up, a);
            second = cylinder({}, up, b);
            break;
        case 3:  // a cone on a cone
            first = cone({}, up, a, b);
            second = cone({0, 0, 0.5 * h}, {0, 0, 0.5 * h}, 0.5 * (a + b), b);
            break;
        case 4:  // one ball twice, cut by a block
            first = ball({}, a);
            second = ball({}, a);
            break;
        default:  // a slot
            first = box({-a, -a, 0}, {a, a, h});
            second = box({-b, -a, 0.5 * h}, {b, a, h});
            break;
    }
    const std::string one = to.solid(first), other = to.solid(second);
    const Operator op = seed % 3 == 0 ? Operator::intersection : Operator::difference;
    to.region(leaf(to.combination(operate(op, {leaf(one), leaf(other)})), place));
    to.region(leaf(other, place));
    for (int i = 0; i < rays; ++i) {
        // Through what is shared and what is left, from outside and along the faces' normals.
        Vec3 through{random.between(-a, a), random.between(-a, a),
                     i % 3 == 0 ? (random.coin() ? h : 0) : random.between(0, h)};
        if (i % 3 == 1 && kind == 0) through = {a, random.between(0, b), random.between(0, h)};
        if (i % 3 == 1 && kind == 5) through = {random.between(-b, b), random.sign() * a, random.between(0.5 * h, h)};
        if (i % 3 == 1 && (kind == 1 || kind == 2))
            through = {random.between(-0.5, 0.5) * b, random.between(-0.5, 0.5) * b, 0};
        const Vec3 d = i % 4 == 0 ? Vec3{0, 0, random.sign()} : random.slanted();
        to.ray_through(moved_point(place, through), moved_direction(place, d), 3 * a);
    }
    return to.take();
}

void require_placed(std::uint64_t seeds, int rays) {
    FieldTally tally;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) judge_field(placed(seed, rays), tally);
    require_all_right(tally, 3);
}

}  // namespace

TEST_CASE("what coincides coincides wherever its frame is placed", "[field][promise:coincidence]") {
    require_placed(4 * kinds, 20);
}
TEST_CASE("what coincides coincides wherever its frame is placed, many rays", "[.long][promise:coincidence]") {
    require_placed(100 * kinds, 170);
}
