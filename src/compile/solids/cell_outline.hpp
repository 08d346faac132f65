// Cell outline: the lines between solid and empty cells of a picture.
#pragma once

#include <vector>

#include "compile/solids/sketch_writer.hpp"

namespace csgrt {

/// Returns the lines in units of cells: cell (x, y) covers x to x + 1 and y to y + 1. Neighbouring lines of one
/// direction are joined. An even number of lines meets in each corner.
std::vector<StraightLine> cell_outline(const Ebm& ebm);

}  // namespace csgrt
