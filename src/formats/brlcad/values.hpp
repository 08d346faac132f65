// Values that both text forms of BRL-CAD's databases share: numbers, units, planes, matrices.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Reads a finite number that fills `text`. Throws Fault at `offset` that quotes it.
double read_number(std::string_view text, std::size_t offset);

/// Reads a whole number that fills `text` and lies in [low, high]. Throws Fault.
int read_integer(std::string_view text, std::size_t offset, int low, int high);

/// `text` in quotes for a message, cut short if long.
std::string quoted(std::string_view text, std::size_t longest = 40);

/// Millimetres in one unit of this name ("mm", "in", "Inches", "light year", ...); 0 if BRL-CAD has no such unit.
double unit_in_millimetres(std::string_view name);
/// The name of a unit of this many millimetres, more than 0; "7 mm" if it has none.
std::string unit_name(double millimetres);

/// The half-space normal . p <= distance with a unit normal. A zero normal stays; validation reports it.
Plane unit_plane(Vec3 normal, double distance);

/// The unit vector of `v`; a zero vector stays.
Vec3 unit_vector(const Vec3& v);

/// Divides BRL-CAD's uniform scale (element 15 is its inverse) out of a matrix. A matrix that is not affine, or not
/// finite then, stays: validation refuses only its users.
Matrix without_scale(Matrix matrix);

/// The kind of a region's flag: P a plate, V a volume, others neither.
Fastgen fastgen_of(std::string_view flag);

/// A colour of three components 0..255.
Vec3 color_of_bytes(int r, int g, int b);

}  // namespace csgrt
