// Codes: values that all of BRL-CAD's forms write in one way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/solids.hpp>

namespace csgrt {

/// Reads one bit a face, as hexadecimal digits, highest face first: face 0 is the lowest bit of the last digit. Faces
/// beyond the digits have 0. Throws Fault at `offset` for anything else.
std::vector<std::uint8_t> read_face_bits(std::string_view digits, std::size_t offset, std::size_t faces);

/// Reads bytes, two hexadecimal digits each. Throws Fault.
std::string read_hexadecimal(std::string_view digits, std::size_t offset);

/// Reads how the cells of a dsp are cut into triangles: a, l or L. Throws Fault.
Dsp::Cut read_cut(std::string_view text, std::size_t offset);

}  // namespace csgrt
