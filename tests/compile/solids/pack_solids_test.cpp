// Parameters as geometry/<solid>.h reads them: points of the surface must satisfy the local equations.
#include <cmath>
#include <random>

#include "catch.hpp"
#include "compile/bounds/bounds.hpp"
#include "compile/linear.hpp"
#include "compile/model.hpp"
#include "compile/solids/pack_one.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

struct Packed {
    CompiledScene scene;

    Packed(const Shape& shape, const Matrix& matrix) {
        PlaneTable planes({}, 100);
        SurfaceTable surfaces({}, 100);
        SharedParts shared;
        Box box = solid_box(shape, matrix);
        if (!is_finite(box)) box = {{-100, -100, -100}, {100, 100, 100}};
        // Not the first of its scene: offsets count.
        pack_one(Ell{{9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, identity, box, scene, planes, surfaces, shared);
        pack_one(block_shape({50, 50, 50}, {51, 51, 51}), identity, box, scene, planes, surfaces, shared);
        pack_one(shape, matrix, box, scene, planes, surfaces, shared);
        scene.planes = planes.records();
    }

    const kernel::SolidRecord& solid() const { return scene.solids.back(); }
    double real(std::size_t i) const { return scene.reals.get().at(solid().first_real + i); }
    std::size_t reals() const { return scene.reals.size() - solid().first_real; }

    Wide local(const Wide& world) const {
        const Wide p = world - Wide(real(0), real(1), real(2));
        Wide q;
        for (int i = 0; i < 3; ++i) {
            const auto row = static_cast<std::size_t>(3 + 3 * i);
            q[i] = real(row) * p.x + real(row + 1) * p.y + real(row + 2) * p.z;
        }
        return q;
    }
    /// n . p - d with the outward normal.
    long double above(std::size_t face, const Wide& p) const {
        const kernel::PlaneRef ref = scene.words.get().at(solid().first_plane + face);
        const kernel::PlaneRecord& plane = scene.planes.get().at(ref >> 1);
        const long double value = glm::dot(Wide(plane.nx, plane.ny, plane.nz), p) - plane.d;
        return ref & 1u ? -value : value;
    }
};

struct Random {
    std::mt19937 engine{11};
    double operator()(double low = -1, double high = 1) {
        return std::uniform_real_distribution<double>(low, high)(engine);
    }
    Wide wide() { return {(*this)(), (*this)(), (*this)()}; }
    Matrix matrix(bool mirror) {
        const Vec3 place{(*this)(-50, 50), (*this)(-50, 50), (*this)(-50, 50)};
        Matrix m = askew((*this)(0, 6), place);
        for (const std::size_t i : {0, 1, 2, 4, 5, 6, 8, 9, 10}) m[i] += 0.3 * (*this)();
        if (mirror)
            for (const std::size_t i : {0, 4, 8}) m[i] = -m[i];
        return m;
    }
};

bool is_zero(long double x) { return std::fabs(x) < 1e-12L; }

Tgc cone(double base_a, double base_b, double top_c, double top_d) {
    return {{1, 2, 3}, {0.5, 0.2, 4}, {base_a, 0, 0}, {0, base_b, 0}, {top_c, 0, 0}, {0, top_d, 0}};
}

}  // namespace

TEST_CASE("packed ellipsoids: local points lie on the unit sphere") {
    Random random;
    for (int round = 0; round < 50; ++round) {
        const Ell s{{1, 2, 3}, narrow(random.wide()), narrow(random.wide()), narrow(random.wide())};
        const Matrix m = random.matrix(round % 2 == 1);
        const Packed packed(s, m);
        CHECK(packed.solid().type == SOLID_ELL);
        REQUIRE(packed.reals() == 12);
        CHECK(packed.solid().plane_count == 0);
        const long double squeeze = std::fabs(glm::determinant(WideMatrix(wide(s.a), wide(s.b), wide(s.c))));
        if (squeeze < 0.01) continue;
        const Wide u = glm::normalize(random.wide());
        const Wide p = transform_point(m, wide(s.v) + u.x * wide(s.a) + u.y * wide(s.b) + u.z * wide(s.c));
        const Wide q = packed.local(p);
        CHECK(glm::length(q - u) < 1e-11L);
    }
}

TEST_CASE("packed cones: semi-axes are linear along z, caps look outward") {
    Random random;
    for (int round = 0; round < 200; ++round) {
        const double top_d = random(0, 2), top_c = random(0, 2), base_b = random(0.5, 2), base_a = random(0.5, 2);
        const Tgc s = cone(base_a, base_b, top_c, top_d);
        const Matrix m = random.matrix(round % 2 == 1);
        const Packed packed(s, m);
        CHECK(packed.solid().type == SOLID_TGC);
        REQUIRE(packed.reals() == 18);
        REQUIRE(packed.solid().plane_count == 2);
        CHECK(packed.real(16) == 1);
        const double angle = random(0, 6.28);
        const long double along = random(0, 1);
        const Wide a = (1 - along) * wide(s.a) + along * wide(s.c), b = (1 - along) * wide(s.b) + along * wide(s.d);
        const Wide p =
            transform_point(m, wide(s.v) + along * wide(s.h) + static_cast<long double>(std::cos(angle)) * a +
                                   static_cast<long double>(std::sin(angle)) * b);
        const Wide q = packed.local(p);
        CHECK(is_zero(q.z - (2 * along - 1)));
        const long double az = packed.real(12) + packed.real(13) * q.z, bz = packed.real(14) + packed.real(15) * q.z;
        CHECK(is_zero(q.x * q.x * bz * bz + q.y * q.y * az * az - az * az * bz * bz));
        CHECK(glm::dot(q, q) <= packed.real(17));
        const Wide base = transform_point(m, wide(s.v)), top = transform_point(m, wide(s.v) + wide(s.h));
        CHECK(is_zero(packed.above(0, base + glm::normalize(transform_direction(m, wide(s.a))))));
        CHECK(is_zero(packed.above(1, top + glm::normalize(transform_direction(m, wide(s.b))))));
        CHECK(packed.above(0, top) < -0.1);
        CHECK(packed.above(1, base) < -0.1);
    }
}

TEST_CASE("packed cones: one taper is a quadric, to the bit; the top may be an edge") {
    const Matrix m = askew(1, {4, 5, 6});
    const auto taper = [&](const Tgc& s) {
        const Packed p(s, m);
        return std::array<double, 5>{p.real(12), p.real(13), p.real(14), p.real(15), p.real(16)};
    };
    CHECK(taper(cone(1, 2, 1, 2)) == std::array<double, 5>{1, 0, 1, 0, 0});  // cylinder
    CHECK(taper(cone(2, 4, 1, 2)) == std::array<double, 5>{0.75, -0.25, 0.75, -0.25, 0});
    CHECK(taper(cone(2, 3, 2, 0)) == std::array<double, 5>{1, 0, 0.5, -0.5, 1});  // an edge
    CHECK(taper(cone(1, 2, 2, 1)) == std::array<double, 5>{0.75, 0.25, 0.75, -0.25, 1});
    // Written with ten digits, the same taper all the same.
    const auto rounded = taper(cone(3, 1, 1, 0.33333333335));
    CHECK(rounded[4] == 0);
    CHECK(rounded[0] == rounded[2]);
    CHECK(rounded[1] == rounded[3]);
    CHECK(taper(cone(3, 1, 1, 0.3334))[4] == 1);
}

TEST_CASE("packed cones: an apex is the local origin") {
    const Matrix m = askew(1, {4, 5, 6});
    for (const bool above : {true, false}) {
        for (const double tip : {0.0, 1e-15}) {
            const Tgc s = above ? cone(2, 3, tip, tip) : cone(tip, tip, 2, 3);
            const Packed packed(s, m);
            CHECK(packed.real(12) == 0);
            CHECK(packed.real(13) == (above ? -0.5 : 0.5));
            CHECK(packed.real(16) == 0);
            const Wide apex = transform_point(m, wide(s.v) + (above ? 1.0L : 0.0L) * wide(s.h));
            CHECK(glm::length(packed.local(apex)) < 1e-14L);
            // A quarter of the way from the apex, on the side.
            const Wide p =
                transform_point(m, wide(s.v) + (above ? 0.75L : 0.25L) * wide(s.h) + 0.25L * wide(above ? s.b : s.d));
            const Wide q = packed.local(p);
            CHECK(is_zero(q.x));
            CHECK(is_zero(q.y - packed.real(13) * q.z));
            CHECK(is_zero(q.z - (above ? -0.5L : 0.5L)));
        }
    }
}

TEST_CASE("packed tori: points of the tube") {
    Random random;
    for (int round = 0; round < 100; ++round) {
        const Wide h = random.wide() + (round % 3 == 0 ? Wide(0, 0, 1000) : Wide(0));
        const Tor s{{1, 2, 3}, narrow(h), 3, random(0.01, 3)};
        const Matrix m = random.matrix(round % 2 == 1);
        const Packed packed(s, m);
        CHECK(packed.solid().type == SOLID_TOR);
        REQUIRE(packed.reals() == 13);
        CHECK(packed.solid().plane_count == 0);
        CHECK(near(packed.real(12), s.r_h / 3));
        const Wide n = glm::normalize(wide(s.h)), x = glm::normalize(glm::cross(n, random.wide()));
        const long double w = random(0, 6.28), r = s.r_h;
        const Wide p = transform_point(m, wide(s.v) + (3 + r * std::cos(w)) * x + r * std::sin(w) * n);
        const Wide q = packed.local(p);
        const long double rho = std::hypot(q.x, q.y) - 1;
        CHECK(is_zero(rho * rho + q.z * q.z - packed.real(12) * packed.real(12)));
    }
}

TEST_CASE("packed hyperboloids: points of the side, base looks outward") {
    Random random;
    for (int round = 0; round < 100; ++round) {
        const Wide h = 3.0L * random.wide(), a = glm::normalize(glm::cross(h, random.wide()));
        if (glm::length(h) < 0.5L) continue;
        const Ehy s{{1, 2, 3}, narrow(h), narrow(a), random(0.5, 2), random(0.5, 2), random(0.1, 2)};
        const Matrix m = random.matrix(round % 2 == 1);
        const Packed packed(s, m);
        CHECK(packed.solid().type == SOLID_EHY);
        REQUIRE(packed.reals() == 13);
        REQUIRE(packed.solid().plane_count == 1);
        const long double c = s.c / glm::length(wide(s.h)), below = random(0, 1), zeta = c + below;
        CHECK(near(packed.real(12), static_cast<double>(c)));
        const long double r = std::sqrt((zeta * zeta - c * c) / (1 + 2 * c)), angle = random(0, 6.28);
        const Wide b = glm::normalize(glm::cross(h, a));
        const Wide p = transform_point(m, wide(s.v) + (1 - below) * h +
                                              r * (std::cos(angle) * static_cast<long double>(s.r_1) * a +
                                                   std::sin(angle) * static_cast<long double>(s.r_2) * b));
        const Wide q = packed.local(p);
        CHECK(is_zero(q.z - (1 - 2 * below)));
        CHECK(is_zero(q.x * q.x + q.y * q.y - r * r));
        CHECK(is_zero(packed.above(0, transform_point(m, wide(s.v) + b))));
        CHECK(packed.above(0, transform_point(m, wide(s.v) + h)) < -0.01);
    }
}

TEST_CASE("packed polyhedra: every face once, outward") {
    const Arb arb = block_shape({0, 0, 0}, {1, 2, 3});
    Arbn arbn{{{{1, 0, 0}, 1}, {{-1, 0, 0}, 0}, {{0, 1, 0}, 2}, {{0, -1, 0}, 0}, {{0, 0, 1}, 3}, {{0, 0, -1}, 0}}};
    arbn.planes.push_back(arbn.planes[2]);
    for (const Shape& shape : {Shape(arb), Shape(arbn)}) {
        for (const Matrix& m :
             {identity, askew(2, {7, 8, 9}), Matrix{-2, 0, 0, 1, 0, 1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1}}) {
            const Packed packed(shape, m);
            CHECK(packed.solid().type == SOLID_ARB);
            CHECK(packed.reals() == 0);
            REQUIRE(packed.solid().plane_count == 6);
            const Wide inside = transform_point(m, Wide(0.5, 1, 1.5));
            for (std::size_t face = 0; face < 6; ++face) {
                CHECK(packed.above(face, inside) < -0.3);
                int on = 0;
                for (const Vec3& corner : arb.vertices)
                    on += is_zero(packed.above(face, transform_point(m, wide(corner))));
                CHECK(on == 4);
            }
        }
    }
}

TEST_CASE("packed half-spaces: moved as points are") {
    Random random;
    for (int round = 0; round < 20; ++round) {
        const Wide n = glm::normalize(random.wide());
        const Half s{{narrow(n), random(-5, 5)}};
        const Matrix m = random.matrix(round % 2 == 1);
        const Packed packed(s, m);
        CHECK(packed.solid().type == SOLID_HALF);
        REQUIRE(packed.solid().plane_count == 1);
        const Wide foot = static_cast<long double>(s.plane.distance) * wide(s.plane.normal);
        const Wide across = glm::cross(n, random.wide());
        CHECK(is_zero(packed.above(0, transform_point(m, foot + across))));
        CHECK(packed.above(0, transform_point(m, foot - n)) < -0.1);
        CHECK(packed.above(0, transform_point(m, foot + n)) > 0.1);
    }
}

TEST_CASE("a solid of unknown type cannot be packed") {
    CHECK(says(error_of([] { Packed(Unsupported{"pipe"}, identity); }), "'pipe'"));
}
