// Unit: converts lengths to the unit of the file that is written.
#pragma once

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Converts millimetres to a unit. Notes values that would not read back: numbers that are not finite, and lengths for
/// which no double times the unit gives the same bits.
class JsonUnit {
public:
    explicit JsonUnit(double millimetres) : unit_(millimetres) {}

    double millimetres() const { return unit_; }
    bool exact() const { return exact_; }
    bool finite() const { return finite_; }
    void forget_infinities() { finite_ = true; }

    double number(double value) {
        finite_ = finite_ && std::isfinite(value);
        return value;
    }
    double length(double millimetres) {
        number(millimetres);
        if (unit_ == 1) return millimetres;
        const double near = millimetres / unit_;
        constexpr double infinity = std::numeric_limits<double>::infinity();
        for (const double candidate : {near, std::nextafter(near, -infinity), std::nextafter(near, infinity)}) {
            const double back = candidate * unit_;
            if (back == millimetres && std::signbit(back) == std::signbit(millimetres)) return candidate;
        }
        exact_ = false;
        return near;
    }
    nlohmann::ordered_json vector(const Vec3& v) { return {number(v.x), number(v.y), number(v.z)}; }
    nlohmann::ordered_json lengths(const Vec3& v) { return {length(v.x), length(v.y), length(v.z)}; }

private:
    double unit_;
    bool exact_ = true, finite_ = true;
};

}  // namespace csgrt
