// From the model's shapes to the judge's solids.
#pragma once

#include "../solid.hpp"

namespace csgrt::oracle {

/// Throws std::invalid_argument for a shape that is no ImplicitSolid.
ImplicitSolid implicit(const Shape& shape, const QAffine& place);
ImplicitSolid implicit(const Shape& shape, const Matrix& matrix);

}  // namespace csgrt::oracle
