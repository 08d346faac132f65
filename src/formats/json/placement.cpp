#include "formats/json/placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "formats/json/read_form.hpp"
#include "formats/json/scene_forms.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

/// Sine and cosine, exact for whole quarter turns: then two faces that meet after a turn are in exactly one plane.
std::pair<double, double> sine_and_cosine(double degrees) {
    const double rest = std::remainder(degrees, 360.0);
    if (rest == 0) return {0, 1};
    if (rest == 90) return {1, 0};
    if (rest == -90) return {-1, 0};
    if (std::abs(rest) == 180) return {0, -1};
    const double radians = rest * std::numbers::pi / 180;
    return {std::sin(radians), std::cos(radians)};
}

/// The rotation about an axis through the origin, counterclockwise as seen from the axis's tip (Rodrigues).
Matrix rotation(const Vec3& axis, double degrees) {
    const auto [s, c] = sine_and_cosine(degrees);
    const Vec3 u = unit(axis);
    const auto both = [c = c](double p, double q) { return p * q * (1 - c); };
    // u u + c (1 - u u), not c + (1 - c) u u: the former is exactly 1 along a coordinate axis.
    const auto own = [c = c](double p) { return p * p + c * (1 - p * p); };
    const Vec3 x{own(u.x), both(u.x, u.y) + s * u.z, both(u.x, u.z) - s * u.y};
    const Vec3 y{both(u.x, u.y) - s * u.z, own(u.y), both(u.y, u.z) + s * u.x};
    const Vec3 z{both(u.x, u.z) + s * u.y, both(u.y, u.z) - s * u.x, own(u.z)};
    return {x.x, y.x, z.x, 0, x.y, y.y, z.y, 0, x.z, y.z, z.z, 0, 0, 0, 0, 1};
}

Matrix read_scale(const JsonNode& node) {
    const Vec3 s = node.is_array() ? node.vector() : node.number(1) * Vec3{1, 1, 1};
    if (node.is_array() && !node.is_vector()) return identity;  // already reported
    if (s.x == 0 || s.y == 0 || s.z == 0) node.fault("a scale must not be 0: it would flatten the object");
    return {s.x, 0, 0, 0, 0, s.y, 0, 0, 0, 0, s.z, 0, 0, 0, 0, 1};
}

/// The matrix of a tree's node, with its translation in millimetres.
Matrix read_matrix(const JsonNode& node) {
    Matrix m = read_json_matrix(node);
    for (const std::size_t i : {3, 7, 11}) m[i] *= node.file().unit;
    return m;
}

}  // namespace

Matrix read_json_matrix(const JsonNode& node) {
    const std::vector<double> numbers = node.numbers(16);
    Matrix m;
    std::copy(numbers.begin(), numbers.end(), m.begin());
    const bool affine = m[12] == 0 && m[13] == 0 && m[14] == 0 && m[15] == 1;
    if (!affine && node.is_array() && std::get<JsonArray>(node.value()->data).size() == 16) {
        node.fault("the last row of a matrix must be 0 0 0 1",
                   "row by row, points as columns: the fourth number of each row moves the object");
    }
    return m;
}

std::optional<Matrix> read_json_placement(const JsonObject& node) {
    const JsonNode matrix = node["matrix"], scale = node["scale"], rotate = node["rotate"],
                   translate = node["translate"];
    if (matrix.present()) {
        for (const JsonNode& other : {scale, rotate, translate}) {
            if (other.present()) other.fault("a node with 'matrix' cannot have this as well", "put it into the matrix");
        }
        return read_matrix(matrix);
    }
    if (!scale.present() && !rotate.present() && !translate.present()) return std::nullopt;
    Matrix m = identity;
    if (scale.present()) m = read_scale(scale);
    if (rotate.present()) {
        const auto [axis, degrees] = read_form<Rotation>(rotate);
        m = compose(rotation(axis, degrees), m);
    }
    const Vec3 by = translate.lengths();
    if (translate.present()) {
        m[3] = by.x;
        m[7] = by.y;
        m[11] = by.z;
    }
    return m;
}

}  // namespace csgrt
