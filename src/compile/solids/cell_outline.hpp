// The lines between solid and empty cells of a picture.
#pragma once

#include <vector>

#include "compile/solids/sketch_writer.hpp"

namespace csgrt {

/// In units of cells: cell (x, y) covers x to x + 1 and y to y + 1. Neighbours in line are one. An even number of lines
/// ends in each corner.
std::vector<StraightLine> cell_outline(const Ebm& ebm);

}  // namespace csgrt
