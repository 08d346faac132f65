// The signs of zeros: rays along the axes of a solid of every type, in its planes of symmetry and through its centre,
// where normals have zeros; rays that begin on its surface, where distances are zero; and zeros of both signs in the
// rays' own numbers. Device and reference give the same bits.
#include <cmath>
#include <cstdio>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "integration/samples.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using test::Sample;
using test::samples;
using test::scene_of_samples;

namespace {

// Quarter turns and mirrors: entry k is a row's only one. Their zeros have both signs, too.
Matrix quarter_turn(stress::Random& random) {
    int axes[3] = {0, 1, 2};
    std::swap(axes[0], axes[random.below(3)]);
    std::swap(axes[1], axes[1 + random.below(2)]);
    Matrix m = identity;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            const double value = static_cast<int>(column) == axes[row] ? 1 : 0;
            m[4 * row + column] = random.below(2) ? value : -value;
        }
    return m;
}

double of_either_sign(stress::Random& random, double value) { return random.below(2) ? value : -value; }

class SymmetricRays {
public:
    explicit SymmetricRays(stress::Random& random) : random_(random) {}

    Ray make() {
        double o[3], d[3];
        const std::size_t axis = random_.below(3), second = (axis + 1) % 3, third = (axis + 2) % 3;
        o[axis] = on_grid(), o[second] = on_grid(), o[third] = on_grid();
        d[axis] = d[second] = d[third] = 0;
        switch (random_.below(6)) {
            case 0:  // along an axis, through the centre
                o[second] = o[third] = 0;
                d[axis] = length();
                break;
            case 1:  // along an axis
                d[axis] = length();
                break;
            case 2:  // in a plane of symmetry
                o[axis] = 0;
                d[second] = random_.between(-1, 1), d[third] = random_.between(-1, 1);
                break;
            case 3:  // in a diagonal one
                o[second] = o[axis], d[axis] = on_grid(), d[second] = d[axis], d[third] = random_.between(-1, 1);
                if (random_.below(2)) o[second] = -o[second], d[second] = -d[second];
                break;
            case 4:  // through the centre
                o[axis] = o[second] = o[third] = 0;
                d[axis] = on_grid(), d[second] = on_grid(), d[third] = random_.between(-1, 1);
                break;
            default:  // in a plane across an axis
                d[second] = on_grid(), d[third] = random_.below(2) ? on_grid() : random_.between(-1, 1);
                break;
        }
        if (d[0] == 0 && d[1] == 0 && d[2] == 0) d[axis] = length();
        const double back = static_cast<double>(random_.below(3) * random_.below(3));
        for (std::size_t i = 0; i < 3; ++i) {
            o[i] = o[i] - back * d[i];
            if (o[i] == 0) o[i] = of_either_sign(random_, 0);
            if (d[i] == 0) d[i] = of_either_sign(random_, 0);
        }
        return {{o[0], o[1], o[2]}, {d[0], d[1], d[2]}};
    }

private:
    double on_grid() {
        const double values[] = {0, 0, 0.25, 0.5, 0.5, 1, 1, 1.5, 2, random_.between(0, 2)};
        return of_either_sign(random_, values[random_.below(std::size(values))]);
    }
    double length() { return of_either_sign(random_, random_.below(2) ? 1 : random_.between(0.1, 3)); }

    stress::Random& random_;
};

void add_region(Scene& scene, const std::string& solid, const Matrix& matrix, bool bounded) {
    Combination region{.name = "r." + solid, .region = true};
    region.tree.nodes.push_back({Operator::leaf, 0, solid, matrix, {}});
    if (bounded && solid == "half") {
        region.tree.nodes.push_back({Operator::leaf, 0, "limits", matrix, {}});
        region.tree.nodes.push_back({Operator::intersection, 2, "", identity, {}});
    }
    scene.top.push_back(region.name);
    scene.objects.push_back(std::move(region));
}

// All samples in a square across an axis, around the origin.
constexpr int pitch = 8, side = [] {
    int rows = 1;
    while (rows * rows < static_cast<int>(std::size(samples))) ++rows;
    return rows;
}();
double at_row(std::size_t row) { return pitch * (static_cast<int>(row) - side / 2); }
Vec3 place_in_square(std::size_t sample, std::size_t axis) {
    double at[3] = {0, 0, 0};
    at[(axis + 1) % 3] = at_row(sample / side), at[(axis + 2) % 3] = at_row(sample % side);
    return {at[0], at[1], at[2]};
}
Scene square_of_samples(std::size_t axis, stress::Random& random) {
    Scene scene = scene_of_samples();
    for (std::size_t i = 0; i < std::size(samples); ++i) {
        Matrix m = quarter_turn(random);
        const Vec3 at = place_in_square(i, axis);
        m[3] = at.x, m[7] = at.y, m[11] = at.z;
        add_region(scene, samples[i].name, m, true);
    }
    return scene;
}

// A zero that is added to keeps its sign.
double sum(double a, double b) { return a == 0 ? b : b == 0 ? a : a + b; }
Ray moved(const Ray& ray, const Vec3& by) {
    return {{sum(ray.origin.x, by.x), sum(ray.origin.y, by.y), sum(ray.origin.z, by.z)}, ray.direction};
}

bool same(const RayPartitions& a, const RayPartitions& b) {
    if (a.partitions.size() != b.partitions.size()) return false;
    for (std::size_t k = 0; k < a.partitions.size(); ++k) {
        const Partition &p = a.partitions[k], &q = b.partitions[k];
        if (!test::same(p.in, q.in) || !test::same(p.out, q.out) || !test::same(p.in_normal, q.in_normal) ||
            !test::same(p.out_normal, q.out_normal) || p.in_solid != q.in_solid || p.out_solid != q.out_solid)
            return false;
    }
    return true;
}

struct Tally {
    std::size_t rays = 0, met = 0, different = 0;
    std::string where;  ///< the first rays that differ, one a call

    void add(const std::vector<Ray>& list, const std::vector<RayPartitions>& found,
             const std::vector<RayPartitions>& expected, const Renderer& renderer) {
        bool told = false;
        for (std::size_t i = 0; i < list.size(); ++i) {
            ++rays;
            met += !expected[i].partitions.empty();
            if (same(found[i], expected[i])) continue;
            ++different;
            if (std::exchange(told, true)) continue;
            const Vec3 &o = list[i].origin, &d = list[i].direction;
            char text[200];
            std::snprintf(text, sizeof text, "%.17g %.17g %.17g  %.17g %.17g %.17g", o.x, o.y, o.z, d.x, d.y, d.z);
            where +=
                (expected[i].partitions.empty() ? std::string("?")
                                                : renderer.model().solids()[expected[i].partitions[0].in_solid].name) +
                ": " + text + "\n";
        }
    }
};

Settings on_reference() { return {.reference = true}; }

/// The rays, and then those that begin where they meet something: on, or back, or aside.
void shoot_both(const Scene& scene, std::vector<Ray> rays, stress::Random& random, Tally& tally) {
    Renderer reference(scene, {}, on_reference()), device(scene, {}, test::on_device());
    auto expected = reference.shoot(rays);
    tally.add(rays, device.shoot(rays), expected, reference);
    std::vector<Ray> from_surfaces;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (expected[i].partitions.empty()) continue;
        const Partition& one =
            expected[i].partitions[random.below(static_cast<std::uint32_t>(expected[i].partitions.size()))];
        const double t = random.below(2) ? one.in : one.out, way = random.below(2) ? 1 : -1;
        if (!std::isfinite(t)) continue;
        const Vec3 &o = rays[i].origin, &d = rays[i].direction;
        const Vec3 at{sum(o.x, t * d.x), sum(o.y, t * d.y), sum(o.z, t * d.z)};
        Ray next{at, {way * d.x, way * d.y, way * d.z}};
        if (random.below(4) == 0) next.direction = SymmetricRays(random).make().direction;
        from_surfaces.push_back(next);
    }
    expected = reference.shoot(from_surfaces);
    tally.add(from_surfaces, device.shoot(from_surfaces), expected, reference);
}

}  // namespace

TEST_CASE("rays along axes and in planes of symmetry: the same zeros", "[agreement][field][promise:shoot]") {
    Tally tally;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        stress::Random random(1 + axis);
        const Scene scene = square_of_samples(axis, random);
        SymmetricRays maker(random);
        std::vector<Ray> rays;
        for (std::size_t i = 0; i < std::size(samples); ++i)
            for (int k = 0; k < 100; ++k) rays.push_back(moved(maker.make(), place_in_square(i, axis)));
        shoot_both(scene, std::move(rays), random, tally);
    }
    INFO(tally.rays << " rays, " << tally.met << " meet something, " << tally.different << " differ\n" << tally.where);
    CHECK(tally.different == 0);
    CHECK(tally.met * 3 > tally.rays);
}

// Each sample alone, and with its centre at the origin.
TEST_CASE("a million rays along axes and in planes of symmetry", "[.long]") {
    const Scene solids = scene_of_samples();
    Tally tally;
    std::uint64_t seed = 1000;
    for (const Sample& sample : samples)
        for (int turn = 0; turn < 12; ++turn) {
            stress::Random random(++seed);
            Scene scene = solids;
            add_region(scene, sample.name, quarter_turn(random), false);
            SymmetricRays maker(random);
            std::vector<Ray> rays;
            for (int k = 0; k < 2000; ++k) rays.push_back(maker.make());
            shoot_both(scene, std::move(rays), random, tally);
        }
    std::printf("%zu rays, %zu meet something, %zu differ\n", tally.rays, tally.met, tally.different);
    INFO(tally.where);
    CHECK(tally.rays > 1'000'000);
    CHECK(tally.different == 0);
}

// First hits go by packets on a processor. The middles of pixels lie in the planes of symmetry.
TEST_CASE("pictures along the axes: the same zeros", "[agreement][field][promise:shoot]") {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        stress::Random random(11 + axis);
        const Scene scene = square_of_samples(axis, random);
        Renderer reference(scene, {}, on_reference()), device(scene, {}, test::on_device());
        View view;
        view.width = view.height = 2 * pitch * side + 1;
        view.camera.view_size = 0.5 * view.width;  // a pixel is half a millimetre: `pitch` is a whole number of them
        view.camera.center = Vec3{0, 0, 0};
        for (const bool from_behind : {false, true}) {
            view.camera.azimuth = axis == 0 ? (from_behind ? 180 : 0) : axis == 1 ? (from_behind ? 270 : 90) : 0;
            view.camera.elevation = axis == 2 ? (from_behind ? -90 : 90) : 0;
            for (const double perspective : {0.0, 60.0})
                for (const bool every : {false, true}) {
                    INFO("axis " << axis << ", behind " << from_behind << ", perspective " << perspective
                                 << ", every partition " << every);
                    view.camera.perspective = perspective;
                    view.every_partition = every;
                    test::require_same(device.render(view), reference.render(view));
                }
        }
    }
}
