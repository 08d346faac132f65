// Solids, matrices, rays and answers with 17 digits, so that a failure can be
// replayed.
#pragma once

#include <ostream>
#include <string>

#include "intersect.hpp"

namespace csgrt::oracle {

std::ostream& print(std::ostream& out, const Vec3& v);

std::string describe(const Shape& shape, const Matrix& matrix);

std::string describe(const Ray& ray);

std::string describe(const Answer& answer);

}  // namespace csgrt::oracle
