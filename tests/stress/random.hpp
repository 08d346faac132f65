// Random numbers that are the same on every platform: integers by SplitMix64 (Steele, Lea and Flood 2014), and what is
// made of them by + - * / sqrt alone.
#pragma once

#include <cmath>
#include <cstdint>

#include <csgrt/scene.hpp>

namespace csgrt::stress {

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }
    /// In [0, 1).
    double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>((next() >> 32) * count >> 32); }
    /// low, low + 1, ... high.
    int whole(int low, int high) { return low + static_cast<int>(below(static_cast<std::uint32_t>(high - low + 1))); }
    bool coin() { return next() >> 63; }
    double sign() { return coin() ? 1 : -1; }
    /// 10^n with low <= n <= high, both within -16 and 16: the double nearest to it.
    double power_of_ten(int low, int high) {
        static constexpr double powers[] = {1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6,
                                            1e-5,  1e-4,  1e-3,  1e-2,  1e-1,  1,     1e1,   1e2,  1e3,  1e4,  1e5,
                                            1e6,   1e7,   1e8,   1e9,   1e10,  1e11,  1e12,  1e13, 1e14, 1e15, 1e16};
        return powers[whole(low, high) + 16];
    }

    Vec3 in_cube() {
        const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
        return {x, y, z};
    }
    /// Uniform on the unit sphere.
    Vec3 direction() {
        for (;;) {
            const Vec3 v = in_cube();
            const double square = v.x * v.x + v.y * v.y + v.z * v.z;
            if (square < 0.01 || square > 1) continue;
            const double s = 1 / std::sqrt(square);
            return {s * v.x, s * v.y, s * v.z};
        }
    }
    /// A direction that makes at least some 6 degrees with all three axes' planes.
    Vec3 slanted() {
        for (;;) {
            const Vec3 d = direction();
            if (std::abs(d.x) > 0.1 && std::abs(d.y) > 0.1 && std::abs(d.z) > 0.1) return d;
        }
    }
    /// One of the six directions along the axes.
    Vec3 axis() {
        const double s = sign();
        switch (below(3)) {
            case 0:
                return {s, 0, 0};
            case 1:
                return {0, s, 0};
            default:
                return {0, 0, s};
        }
    }

private:
    std::uint64_t state_;
};

}  // namespace csgrt::stress
