// Codes: values that have the same text in all of BRL-CAD's forms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <csgrt/solids.hpp>

namespace csgrt {

/// Reads one bit for each face from hexadecimal digits. Face 0 is the lowest bit of the last digit; faces beyond the
/// digits have 0. Throws Fault at `offset` if a character is no such digit.
std::vector<std::uint8_t> read_face_bits(std::string_view digits, std::size_t offset, std::size_t faces);

/// Reads bytes, two hexadecimal digits each. Throws Fault.
std::string read_hexadecimal(std::string_view digits, std::size_t offset);

/// Reads the rule by which a dsp's cells are cut into triangles: a, l or L. Throws Fault.
Dsp::Cut read_cut(std::string_view text, std::size_t offset);

}  // namespace csgrt
