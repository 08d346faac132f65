// Shape: functions of the type Shape that are compiled only here, because they instantiate code for all types of
// solids.
#include <csgrt/solids.hpp>

namespace csgrt {

Shape::Shape() noexcept = default;
Shape::Shape(const Shape& other) = default;
Shape::Shape(Shape&& other) noexcept = default;
Shape& Shape::operator=(const Shape& other) = default;
Shape& Shape::operator=(Shape&& other) noexcept = default;
Shape::~Shape() = default;

}  // namespace csgrt
