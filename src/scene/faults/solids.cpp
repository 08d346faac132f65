#include "scene/faults/solids.hpp"

#include "scene/faults/families.hpp"

namespace csgrt {

std::vector<std::string> solid_faults(const Shape& shape) { return std::visit(FaultsOf{}, shape); }

}  // namespace csgrt
