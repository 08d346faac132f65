// The volumes in the cells of a grid, for other programs.
#pragma once

#include <string>

#include <csgrt/measure.hpp>

namespace csgrt::cli {

/// Writes a file whose suffix is .npz (NumPy's arrays, one row for each volume that is not 0) or .vti (VTK's image, one
/// value for each cell). Throws Error (file).
void write_cells(const Measurement& result, const std::string& path);

}  // namespace csgrt::cli
