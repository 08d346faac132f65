// Matrices (4x4) in image headers.
#pragma once

#include <vector>

namespace csgrt {

/// OpenEXR's matrices multiply row vectors, p' = p M, and csgrt's multiply column vectors. So each is the other's
/// transpose.
inline std::vector<float> transpose(const std::vector<float>& matrix) {
    std::vector<float> result(16);
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) result[4 * column + row] = matrix[4 * row + column];
    }
    return result;
}

}  // namespace csgrt
