// Values that both text forms of BRL-CAD's databases share: numbers, units, planes, matrices.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Reads the whole of `text` as a finite number. Throws Fault at `offset`, which quotes `text`.
double read_number(std::string_view text, std::size_t offset);

/// Reads the whole of `text` as a whole number in [low, high]. Throws Fault.
int read_integer(std::string_view text, std::size_t offset, int low, int high);

/// `text` in quotes for a message, cut short if long.
std::string quoted(std::string_view text, std::size_t longest = 40);

/// Millimetres in one unit of this name ("mm", "in", "Inches", "light year", ...); 0 if BRL-CAD has no such unit.
double unit_in_millimetres(std::string_view name);
/// The name of the unit with this length, which is more than 0. For example "7 mm" if no unit has this length.
std::string unit_name(double millimetres);

/// The half-space normal . p <= distance with a unit normal. A zero normal stays 0, and validation reports it.
Plane unit_plane(Vec3 normal, double distance);

/// The unit vector of `v`. A zero vector stays 0.
Vec3 unit_vector(const Vec3& v);

/// Divides a matrix by its element 15, which is the inverse of BRL-CAD's uniform scale. A matrix that would not be
/// affine or finite afterwards stays unchanged, and validation refuses it where it is used.
Matrix without_scale(Matrix matrix);

/// The kind of a region's flag: P a plate, V a volume, others neither.
Fastgen fastgen_of(std::string_view flag);

/// A colour of three components 0..255.
Vec3 color_of_bytes(int r, int g, int b);

}  // namespace csgrt
