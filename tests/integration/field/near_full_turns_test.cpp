// Turns that close, or all but close: revolves by angles at and near a full turn, half a turn and none, and pipes whose
// bends all but run straight on or turn back. Rays in the planes where the turn begins and ends, across them, through
// the axis and along it.
#include "integration/field/judge.hpp"
#include "formats/json/parse_text.hpp"
#include "oracle/scene_solid.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

constexpr double pi = 3.141592653589793;

// Between two distances from the axis and two heights; or down to the axis; or round. The inside reaches from 1 to 2
// from the axis.
Sketch some_profile(Random& random) {
    Sketch sketch;
    const auto lines = [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) sketch.curves.push_back(Sketch::Line{i, i + 1});
    };
    switch (random.below(4)) {
        case 0:
            sketch.vertices = {{1, -1}, {2, -1}, {2, 1}, {1, 1}};
            lines(0, 3);
            sketch.curves.push_back(Sketch::Line{3, 0});
            break;
        case 1:  // a cylinder, a cone on it
            sketch.vertices = {{0, -1}, {2, -1}, {2, 0.5}, {0, 1.5}};
            lines(0, 3);
            break;
        case 2:  // a ring
            sketch.vertices = {{1.5, 0}, {2, 0}};
            sketch.curves.push_back(Sketch::Arc{1, 0, -1, false, false});
            break;
        default:  // a bell
            sketch.vertices = {{0, -1}, {2, -1}, {2, 1}, {0.5, 1}, {0, 1.5}};
            lines(0, 1);
            sketch.curves.push_back(Sketch::Bezier{{1, 2, 3, 4}});
            break;
    }
    sketch.reversed.assign(sketch.curves.size(), 0);
    return sketch;
}

// At none, half or all of a turn, or off by as little as a bit and as much as 1e-8. In between, off the limit of what
// is one: 1e-10.
double some_angle(Random& random) {
    static constexpr double offs[] = {0, 0, 4e-16, 9e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 5e-11, 2e-9, 1e-8};
    const double at = pi * random.whole(0, 2), off = offs[random.below(std::size(offs))] * random.sign();
    if (at == 0) return off == 0 ? 1e-16 : std::abs(off);
    return std::min(at + off, 2 * pi);
}

/// One revolve by itself, at the origin or moved and turned, and rays of all kinds at its seam.
StressScene seams(std::uint64_t seed, std::size_t times) {
    Builder to("seams", seed, times);
    Random& random = to.random();
    const double angle = some_angle(random);
    Matrix place = identity;
    if (random.coin()) {
        const Vec3 by{random.whole(-4, 4) * 0.5, random.whole(-4, 4) * 0.25, 3};
        place = translation(by) * rotation(1, 1, random.coin() ? 1 : 0, 0);
    }
    to.region(leaf(to.solid(Revolve{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, angle, some_profile(random)}), place));

    for (int i = to.rays(24); i > 0; --i) {
        // Where the turn begins or ends, the far side of that, half-way through the gap, or anywhere.
        double turn = 0;
        switch (random.below(5)) {
            case 0:
                break;
            case 1:
                turn = angle;
                break;
            case 2:
                turn = angle / 2;
                break;
            case 3:
                turn = angle / 2 + pi;
                break;
            default:
                turn = random.between(0, 2 * pi);
                break;
        }
        Vec3 out{std::cos(turn), std::sin(turn), 0};
        if (turn == 0) out = {1, 0, 0};
        const Vec3 aside{-out.y, out.x, 0}, up{0, 0, 1};
        const double far = random.sign() * random.between(0.1, 1.9),
                     height = random.coin() ? 0 : random.between(-0.9, 1.4);
        const Vec3 at = far * out + height * up;
        Vec3 direction;
        switch (random.below(6)) {
            case 0:
                direction = random.sign() * out;
                break;  // through the axis
            case 1:
                direction = random.sign() * up;
                break;  // along it
            case 2:
                direction = random.between(-1, 1) * out + random.between(-1, 1) * up;
                break;  // in the plane
            case 3:
                direction = random.sign() * aside;
                break;  // straight across it
            case 4:
                direction = random.sign() * aside + random.between(-1, 1) * out + random.between(-1, 1) * up;
                break;
            default:
                direction = random.direction();
                break;
        }
        const Vec3 start = random.below(8) == 0 ? at - at.z * up - far * out : at;  // some from the axis on
        to.ray_through(moved_point(place, start), moved_direction(place, direction), random.below(4) == 0 ? 0 : 5);
    }
    return to.take();
}

/// A pipe that turns by very little, or nearly back.
StressScene bends(std::uint64_t seed, std::size_t times) {
    Builder to("bends", seed, times);
    Random& random = to.random();
    // Ends of straight parts that lean by less than 1e-9 are one plane, and no bend: not by numbers in between, on
    // which rules differ.
    const double lean =
        (random.below(4) ? random.power_of_ten(-9, -2) : random.power_of_ten(-16, -13)) * random.between(2, 9);
    const bool back = random.coin() && lean > 1e-5;
    const double bend = 1, reach = 8 + (back ? 4 / lean : 0);
    const Vec3 corner{0, 0, 0}, before{-reach, 0, 0};
    const Vec3 after = back ? Vec3{-reach * std::cos(lean), reach * std::sin(lean), 0} : Vec3{reach, reach * lean, 0};
    const double inner = random.coin() ? 0.5 : 0;
    to.region(leaf(to.solid(Pipe{{{before, 1, inner, bend}, {corner, 1, inner, bend}, {after, 1, inner, bend}}})));
    // The middle of the bend.
    const double tangent = back ? 2 * bend / lean : bend * lean / 2;
    for (int i = to.rays(24); i > 0; --i) {
        const double along = random.between(-1, 1);
        Vec3 at = back ? Vec3{2 * along - tangent, random.between(0, 2.5), 0} : Vec3{along * tangent, 0, 0};
        if (random.below(4) == 0) at = at + Vec3{random.between(-2, 2), 0, 0};
        at.z = random.below(3) ? 0 : random.between(-0.5, 0.5);
        Vec3 direction = random.direction();
        switch (random.below(4)) {
            case 0:
                direction = {0, random.sign(), 0};
                break;
            case 1:
                direction = {0, random.between(-1, 1), random.between(-1, 1)};
                break;
            case 2:
                direction = {random.sign(), back ? 0 : random.between(-1, 1),
                             random.below(2) ? 0 : random.between(-1, 1)};
                break;
            default:
                break;
        }
        to.ray_through(at, direction, 10);
    }
    return to.take();
}

test::FieldTally judged(StressScene (*make)(std::uint64_t, std::size_t), std::uint64_t first, std::uint64_t count,
                        std::size_t times) {
    test::FieldTally tally;
    for (std::uint64_t seed = first; seed < first + count; ++seed) test::judge_field(make(seed, times), tally);
    return tally;
}

}  // namespace

TEST_CASE("turns that close, or all but close, are right", "[field][promise:rounding]") {
    test::require_all_right(judged(seams, 1, 24, 1));
}
TEST_CASE("pipes that all but run straight on, or turn back, are right", "[field][promise:rounding]") {
    test::require_all_right(judged(bends, 1, 8, 1));
}

TEST_CASE("10^5 rays at seams", "[.long]") {
    const auto tell = [](const char* what, const test::FieldTally& tally) {
        std::printf("%s: %zu scenes, %zu rays, %zu ties, %zu wrong, worst end %.2f\n", what, tally.scenes, tally.rays,
                    tally.ties, tally.wrong, tally.worst);
        test::require_all_right(tally);
    };
    tell("seams", judged(seams, 1000, 1000, 4));
    tell("bends", judged(bends, 1000, 100, 4));
}

// The ray's answer must neither be open nor lack a side.
TEST_CASE("the oracle knows that a seam closes", "[field]") {
    for (const double angle : {2 * pi, 6.2831853071795853, 6.283185307100001}) {
        INFO(angle);
        Revolve tube{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, angle, {}};
        tube.sketch.vertices = {{20, -40}, {30, -40}, {30, 40}, {20, 40}};
        tube.sketch.curves = {Sketch::Line{0, 1}, Sketch::Line{1, 2}, Sketch::Line{2, 3}, Sketch::Line{3, 0}};
        const oracle::Answer answer =
            oracle::scene_solid(tube, oracle::to_affine(identity), 0.001, false)(Ray{{-100, 0, 0}, {1, 0, 0}});
        CHECK_FALSE(answer.tie);
        REQUIRE(answer.intervals.size() == 2);
        CHECK(answer.intervals[0].in.t == 70);
        CHECK(answer.intervals[0].out.t == 80);
        CHECK(answer.intervals[1].in.t == 120);
        CHECK(answer.intervals[1].out.t == 130);
    }
}

// A full turn less one bit of the angle in degrees.
TEST_CASE("a ray in the plane of a seam that closes meets both sides", "[field]") {
    const auto scene = [](const std::string& angle) {
        return scene_of(R"({"csgrt": 1, "solids": {"tube": {"type": "revolve", "base": [0, 0, 0], "axis": [0, 0, 1],
            "r": [1, 0, 0], "angle": )" +
                        angle + R"(, "sketch": {"vertices": [[20, -40], [30, -40], [30, 40], [20, 40]],
            "curves": [{"line": [0, 1]}, {"line": [1, 2]}, {"line": [2, 3]}, {"line": [3, 0]}]}}}})");
    };
    const std::vector<Ray> rays = {{{-100, 0, 0}, {1, 0, 0}}, {{-25, 0, -100}, {0, 0, 1}}, {{25, -100, 0}, {0, 1, 0}}};
    Settings settings = test::on_device();
    for (const bool reference : {false, true}) {
        settings.reference = reference;
        for (const char* angle : {"360", "359.99999999999994", "359.999999999999"}) {
            INFO(angle << (reference ? ", reference" : ""));
            Renderer renderer(scene(angle), {}, settings);
            CHECK(renderer.model().warnings().empty());
            const auto found = renderer.shoot(rays);
            REQUIRE(found[0].partitions.size() == 2);
            CHECK(found[0].partitions[0].in == 70);
            CHECK(found[0].partitions[0].out == 80);
            CHECK(found[0].partitions[1].in == 120);
            CHECK(found[0].partitions[1].out == 130);
            REQUIRE(found[1].partitions.size() == 1);
            CHECK(found[1].partitions[0].in == 60);
            CHECK(found[1].partitions[0].out == 140);
            CHECK(found[2].partitions.size() == 1);  // across it: no seam
        }
        // Of a sliver of 2e-11 radians there is nothing, and that is said.
        Renderer empty(scene("1e-9"), {}, settings);
        for (const RayPartitions& ray : empty.shoot(rays)) CHECK(ray.partitions.empty());
        REQUIRE(empty.model().warnings().size() == 1);
        CHECK(empty.model().warnings()[0].object == "tube");
        CHECK(empty.model().warnings()[0].reason.find("1e-10") != std::string::npos);
        if (reference) settings.device.clear();
    }
}
