#include "scene/solid_faults.hpp"

#include "scene/solid_faults_of.hpp"

namespace csgrt {

std::vector<std::string> solid_faults(const Shape& shape) { return std::visit(FaultsOf{}, shape); }

}  // namespace csgrt
