// The piece of a ray that a torus's quartic is solved on: it holds all of the torus, and a ray far from it has none. An
// answer would be right without the second, only late.
#include "catch.hpp"

#include <array>

#include "kernel_host/geometry.hpp"
#include "oracle/random.hpp"

using namespace csgrt;

namespace {

// A torus as the packer leaves it: around the z axis, with the ring's radius 1.
using Parameters = std::array<kernel::real, 13>;
Parameters torus(double ratio) { return {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, ratio}; }

kernel::vec3 to_kernel(oracle::QVec v) {
    return kernel::make_vec3(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
}

kernel::tor_piece piece_of(const Parameters& p, oracle::QVec origin, oracle::QVec direction) {
    kernel::ray3 r{};
    r.o = to_kernel(origin);
    r.d = to_kernel(direction);
    return kernel::tor_piece_of(QUARTIC_BRACKETED, p.data(), r);
}

}  // namespace

TEST_CASE("geometry: a ray past a torus's sphere has no piece, whatever it meets of the slab") {
    oracle::Random random(11);
    for (int i = 0; i < 20'000; ++i) {
        const double ratio = random.between(0.01, 1);
        const oracle::QVec direction = random.direction(), other = random.direction();
        const oracle::QVec across = oracle::unit(cross(direction, other));
        const oracle::quad away = (1 + ratio) * random.between(1.001, 3), before = random.between(-5, 5);
        const kernel::tor_piece piece = piece_of(torus(ratio), away * across + before * direction, direction);
        REQUIRE_FALSE(piece.low < piece.high);
    }
}

TEST_CASE("geometry: a torus's piece holds every point of the torus on its ray") {
    oracle::Random random(12);
    for (int i = 0; i < 20'000; ++i) {
        const double ratio = random.between(0.01, 1);
        // A point of the ring, and from there a point of the tube.
        const double around = random.between(-4, 4), up = random.between(-4, 4);
        const double rho = 1 + ratio * std::cos(up);
        const oracle::QVec point{rho * std::cos(around), rho * std::sin(around), ratio * std::sin(up)};
        const oracle::QVec direction = i % 8 == 0 ? random.axis() : random.direction();
        const double before = random.between(-5, 5);
        const kernel::tor_piece piece = piece_of(torus(ratio), point - oracle::quad(before) * direction, direction);
        // Along the piece's unit direction, from where its origin was moved to.
        const double at = (before - piece.l.shift) * piece.length;
        REQUIRE(piece.low < at);
        REQUIRE(at < piece.high);
    }
}
