#include "compile/bounds/extent.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "compile/linear.hpp"
#include "scene/range.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

/// The largest coordinate of a box, with a margin for the boxes' padding.
constexpr double most = Limits::length * (1 + 1e-6);

/// The fault of a solid's size or position; empty: there is none. A NaN is a fault, because comparisons with a NaN are
/// false.
std::string extent_fault(const Shape& shape, const Matrix& matrix, const Box& box) {
    if (const auto* half = std::get_if<Half>(&shape)) {
        const double distance = std::abs(transform_plane(matrix, half->plane).distance);
        if (distance <= most) return {};
        return "lies " + rounded_text(distance) + " mm from the origin where it stands; " + length_limit();
    }
    // The faces of an arb may leave the solid unbounded.
    const bool is_open = std::holds_alternative<Arb>(shape) || std::holds_alternative<Arbn>(shape);
    const double far = std::max(largest(box.low), largest(box.high));
    if (!(far <= most) && !(is_open && std::isinf(far)))
        return "reaches to " + rounded_text(far) + " mm from the origin where it stands; " + length_limit();
    const Vec3 sides = box.high - box.low;
    const double size = std::hypot(sides.x, sides.y, sides.z);  // the squares of very small numbers may be 0
    if (size >= Limits::least_length) return {};
    return "is " + rounded_text(size) + " mm large where it stands; the least size is " +
           number_text(Limits::least_length) + " mm";
}

}  // namespace

std::string extent_fault(const Scene& scene, const FlatScene& flat, const InstanceBounds& measured,
                         std::size_t number) {
    const Box& box = measured.boxes[number];
    const bool plain =
        largest(box.low) <= most && largest(box.high) <= most && box.high.x - box.low.x >= Limits::least_length;
    const Instance& instance = flat.instances[number];
    return plain ? std::string() : extent_fault(shape_of(scene, flat, instance), *instance.matrix, box);
}

std::vector<ExtentFault> extent_faults(const Scene& scene, const FlatScene& flat, const InstanceBounds& measured) {
    std::vector<ExtentFault> faults;
    for (std::size_t i = 0; i < flat.instances.size(); ++i) {
        std::string fault = extent_fault(scene, flat, measured, i);
        if (!fault.empty()) faults.push_back({flat.instances[i].object, std::move(fault)});
    }
    return faults;
}

}  // namespace csgrt
