#include "scene/range.hpp"

#include <charconv>
#include <iterator>

#include "scene/vector.hpp"

namespace csgrt {

std::string number_text(double x) {
    char text[32];
    const auto [end, status] = std::to_chars(std::begin(text), std::end(text), x);
    return {text, end};
}

std::string rounded_text(double x) {
    char text[32];
    const auto [end, status] = std::to_chars(std::begin(text), std::end(text), x, std::chars_format::general, 6);
    return {text, end};
}

std::string length_limit() {
    return "the largest size and distance from the origin is " + number_text(Limits::length) + " mm";
}

std::string ray_fault(const Vec3& origin, const Vec3& direction, bool& in_direction) {
    in_direction = !is_finite(direction);
    if (in_direction || !is_finite(origin)) return "needs six finite numbers";
    in_direction = true;
    const double size = largest(direction);
    if (size == 0) return "needs a direction other than 0";
    if (size < Limits::least_direction || size > Limits::greatest_direction)
        return "the largest component of its direction is " + number_text(size) + ", and must be from " +
               number_text(Limits::least_direction) + " to " + number_text(Limits::greatest_direction);
    in_direction = false;
    if (const double far = largest(origin); far > Limits::ray_origin)
        return "its origin has the coordinate " + number_text(far) + ", and " + number_text(Limits::ray_origin) +
               " mm is the farthest";
    return {};
}

}  // namespace csgrt
