#include "scene/mesh_faults.hpp"

#include <algorithm>
#include <cmath>

#include "scene/vector.hpp"

namespace csgrt {

namespace {

using Faults = std::vector<std::string>;

/// Corners are at most this far apart, and from the origin: squares of such lengths are numbers still.
constexpr double farthest = 1e150;

bool is_place(const Vec3& v) { return is_finite(v) && length(v) <= farthest; }

/// One sentence about the first vertex that is not a place; nothing else is worth saying then.
bool check_vertices(Faults& faults, const std::vector<Vec3>& vertices) {
    const auto bad = std::find_if_not(vertices.begin(), vertices.end(), is_place);
    if (bad == vertices.end()) return true;
    faults.push_back("vertex " + std::to_string(bad - vertices.begin()) +
                     (is_finite(*bad) ? " lies too far away" : " has a number that is not finite"));
    return false;
}

/// The matrix of a grid of cells.
void check_matrix(Faults& faults, const Matrix& m) {
    if (!std::all_of(m.begin(), m.end(), [](double x) { return std::abs(x) <= farthest; })) {
        faults.push_back("its matrix has a number that is not finite, or far too large");
        return;
    }
    const Vec3 x{m[0], m[4], m[8]}, y{m[1], m[5], m[9]}, z{m[2], m[6], m[10]};
    if (!(std::abs(dot(unit(x), cross(unit(y), unit(z)))) >= 1e-10))
        faults.push_back("its matrix is singular: it leaves no volume");
}

std::string counted(std::size_t count, const char* what) { return std::to_string(count) + ' ' + what; }

std::string no_vertex(std::uint32_t corner, std::size_t count) {
    return " uses vertex " + std::to_string(corner) + "; there " +
           (count == 0   ? "are no vertices"
            : count == 1 ? "is only vertex 0"
                         : "are only vertices 0 to " + std::to_string(count - 1));
}

}  // namespace

Faults mesh_faults(const Bot& s) {
    Faults faults;
    if (!check_vertices(faults, s.vertices)) return faults;
    if (s.faces.empty()) faults.push_back("it has no faces");
    for (std::size_t i = 0; i < s.faces.size(); ++i) {
        const std::uint32_t corner = *std::max_element(s.faces[i].begin(), s.faces[i].end());
        if (corner < s.vertices.size()) continue;
        return {"face " + std::to_string(i) + no_vertex(corner, s.vertices.size())};
    }
    if (s.mode != Bot::Mode::plate && s.mode != Bot::Mode::plate_nocos) return faults;
    if (s.thickness.size() != s.faces.size())
        faults.push_back("it has " + counted(s.thickness.size(), "thicknesses for ") +
                         counted(s.faces.size(), "faces"));
    if (!s.append.empty() && s.append.size() != s.faces.size())
        faults.push_back("it says for " + std::to_string(s.append.size()) + " of " + counted(s.faces.size(), "faces") +
                         " where their thickness lies");
    const auto thin = [](double x) { return x >= 0 && x <= farthest; };
    if (const auto bad = std::find_if_not(s.thickness.begin(), s.thickness.end(), thin); bad != s.thickness.end())
        faults.push_back("the thickness of face " + std::to_string(bad - s.thickness.begin()) +
                         " must not be less than 0");
    return faults;
}

Faults mesh_faults(const Ars& s) {
    if (s.curves.size() < 2) return {"it has less than two curves"};
    const std::size_t points = s.curves.front().size();
    if (points < 3) return {"its curves have less than three points"};
    for (std::size_t i = 0; i < s.curves.size(); ++i) {
        const std::string curve = "curve " + std::to_string(i);
        if (s.curves[i].size() != points)
            return {curve + " has " + counted(s.curves[i].size(), "points, not ") + std::to_string(points) +
                    " as the first one"};
        if (!std::all_of(s.curves[i].begin(), s.curves[i].end(), is_place))
            return {curve + " has a number that is not finite, or far too large"};
    }
    return {};
}

Faults mesh_faults(const Nmg& s) {
    Faults faults;
    if (!check_vertices(faults, s.vertices)) return faults;
    if (s.faces.empty()) return {"it has no faces"};
    for (std::size_t i = 0; i < s.faces.size(); ++i) {
        const std::string face = "face " + std::to_string(i);
        if (s.faces[i].empty()) return {face + " has no loop"};
        for (const Nmg::Loop& loop : s.faces[i]) {
            if (loop.size() < 3) return {face + " has a loop of less than three vertices"};
            const std::uint32_t corner = *std::max_element(loop.begin(), loop.end());
            if (corner >= s.vertices.size()) return {face + no_vertex(corner, s.vertices.size())};
        }
    }
    return {};
}

Faults mesh_faults(const Vol& s) {
    Faults faults;
    if (s.width == 0 || s.depth == 0 || s.height == 0) return {"it has no cells"};
    // No product of three 32-bit numbers that matches a size can overflow, since its part does not.
    const std::size_t layer = std::size_t{s.width} * s.depth;
    if (s.cells.size() % layer != 0 || s.cells.size() / layer != s.height)
        return {"it has " + counted(s.cells.size(), "cells, not ") + std::to_string(s.width) + " x " +
                std::to_string(s.depth) + " x " + std::to_string(s.height)};
    for (const double size : {s.cell.x, s.cell.y, s.cell.z})
        if (!(size > 0 && size <= farthest)) return {"the sides of a cell must be greater than 0"};
    check_matrix(faults, s.matrix);
    return faults;
}

Faults mesh_faults(const Dsp& s) {
    Faults faults;
    if (s.width < 2 || s.depth < 2) return {"it has no cells: it must have two heights at least each way"};
    if (s.heights.size() != std::size_t{s.width} * s.depth)
        return {"it has " + counted(s.heights.size(), "heights, not ") + std::to_string(s.width) + " x " +
                std::to_string(s.depth)};
    check_matrix(faults, s.matrix);
    return faults;
}

}  // namespace csgrt
