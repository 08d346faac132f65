// What the matrices of ebm, vol and dsp turn into millimetres.
#pragma once

#include <array>
#include <cstddef>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Which columns of the matrix are lengths. The last one, a place, always is; x, y and z are if they count cells or
/// steps of height, and are not if they are millimetres already.
using LengthColumns = std::array<bool, 4>;
inline constexpr LengthColumns ebm_lengths = {true, true, false, true};  // z is a length
inline constexpr LengthColumns vol_lengths = {false, false, false, true};
inline constexpr LengthColumns dsp_lengths = {true, true, true, true};

/// Whether element `i` of a matrix, row by row, is a length.
inline bool is_length(const LengthColumns& lengths, std::size_t i) { return i < 12 && lengths[i % 4]; }

/// What a file that gives no matrix means: cells as long as the file's unit, at the origin.
inline Matrix usual_placement(const LengthColumns& lengths, double unit) {
    Matrix m = identity;
    for (const std::size_t i : {std::size_t{0}, std::size_t{5}, std::size_t{10}}) {
        if (is_length(lengths, i)) m[i] *= unit;
    }
    return m;
}

}  // namespace csgrt
