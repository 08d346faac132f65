// What is wrong with one solid that triangles make.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

std::vector<std::string> mesh_faults(const Bot& s);

}  // namespace csgrt
