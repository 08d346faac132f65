// Solids of BRL-CAD's older text form.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/brlcad_v4_lines.hpp"

namespace csgrt {

/// Whether a record of that letter is a solid.
bool is_v4_solid(char letter);

/// The solid that `line` starts; takes the further lines that belong to it. `name` is set as soon as it is known, also
/// when a Fault leaves.
Shape read_v4_solid(const Line& line, LineReader& lines, std::string& name);

}  // namespace csgrt
