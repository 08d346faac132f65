// What is wrong with one solid that triangles make.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

std::vector<std::string> mesh_faults(const Bot& s);
std::vector<std::string> mesh_faults(const Ars& s);
std::vector<std::string> mesh_faults(const Nmg& s);
std::vector<std::string> mesh_faults(const Vol& s);
std::vector<std::string> mesh_faults(const Dsp& s);

}  // namespace csgrt
