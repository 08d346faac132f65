// What ars, vol and dsp enclose, as triangles, from their definitions; nothing here is shared with src/compile.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <map>
#include <tuple>
#include <utility>

#include "mesh.hpp"

namespace csgrt::oracle {

struct Parts {
    std::vector<Vec3> vertices;
    std::vector<MeshSurface::Face> faces;
    QAffine place;  ///< of the vertices in the solid's space

    /// Equal points are one vertex.
    std::uint32_t vertex(const Vec3& p) {
        const auto next = static_cast<std::uint32_t>(vertices.size());
        const auto [known, added] = numbers_.emplace(std::tuple(p.x, p.y, p.z), next);
        if (added) vertices.push_back(p);
        return known->second;
    }
    void triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
        const MeshSurface::Face face{vertex(a), vertex(b), vertex(c)};
        if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) faces.push_back(face);
    }
    void quadrangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        triangle(a, b, c), triangle(a, c, d);
    }

    MeshSurface surface(const Matrix& matrix) const { return {vertices, faces, to_affine(matrix) * place}; }

private:
    std::map<std::tuple<double, double, double>, std::uint32_t> numbers_;
};

/// Neighbouring curves i, i + 1; neighbouring points j, j + 1: the triangles (i j, i j+1, i+1 j+1) and (i j, i+1 j+1,
/// i+1 j).
inline Parts parts_of(const Ars& ars) {
    Parts parts;
    for (std::size_t i = 1; i < ars.curves.size(); ++i)
        for (std::size_t j = 0, n = ars.curves[i].size(); j < n; ++j)
            parts.quadrangle(ars.curves[i - 1][j], ars.curves[i - 1][(j + 1) % n], ars.curves[i][(j + 1) % n],
                             ars.curves[i][j]);
    return parts;
}

/// The sides of all solid boxes of one cell, less those that two of them share.
inline Parts parts_of(const Vol& vol) {
    Parts parts;
    const QAffine own = to_affine(vol.matrix);
    parts.place = {quad(vol.cell.x) * own.x, quad(vol.cell.y) * own.y, quad(vol.cell.z) * own.z, own.origin};
    std::map<std::array<int, 4>, int> sides;  // lower corner, axis -> how many solid cells have it
    for (int z = 0; z < static_cast<int>(vol.height); ++z)
        for (int y = 0; y < static_cast<int>(vol.depth); ++y)
            for (int x = 0; x < static_cast<int>(vol.width); ++x) {
                const int value =
                    vol.cells[static_cast<std::size_t>(x) +
                              vol.width * (static_cast<std::size_t>(y) + vol.depth * static_cast<std::size_t>(z))];
                if (value < vol.low || value > vol.high) continue;
                ++sides[{x, y, z, 0}], ++sides[{x + 1, y, z, 0}], ++sides[{x, y, z, 1}];
                ++sides[{x, y + 1, z, 1}], ++sides[{x, y, z, 2}], ++sides[{x, y, z + 1, 2}];
            }
    for (const auto& [side, count] : sides) {
        if (count != 1) continue;
        const double x = side[0], y = side[1], z = side[2];
        if (side[3] == 0) parts.quadrangle({x, y, z}, {x, y + 1, z}, {x, y + 1, z + 1}, {x, y, z + 1});
        if (side[3] == 1) parts.quadrangle({x, y, z}, {x + 1, y, z}, {x + 1, y, z + 1}, {x, y, z + 1});
        if (side[3] == 2) parts.quadrangle({x, y, z}, {x + 1, y, z}, {x + 1, y + 1, z}, {x, y + 1, z});
    }
    return parts;
}

/// Every cell is a prism from 0 up to two triangles; walls between cells cancel. Adaptive: of the two diagonals the one
/// along which the heights of the four points in line bend less, the falling one if they bend alike.
inline Parts parts_of(const Dsp& dsp) {
    Parts parts;
    parts.place = to_affine(dsp.matrix);
    const int width = static_cast<int>(dsp.width), depth = static_cast<int>(dsp.depth);
    const auto height = [&](int x, int y) -> int {
        x = std::clamp(x, 0, width - 1), y = std::clamp(y, 0, depth - 1);
        return dsp.heights[static_cast<std::size_t>(y * width + x)];
    };
    const auto top = [&](int x, int y) { return Vec3{1.0 * x, 1.0 * y, 1.0 * height(x, y)}; };
    const auto foot = [&](int x, int y) { return Vec3{1.0 * x, 1.0 * y, 0}; };
    const auto bend = [](int a, int b, int c, int d) { return std::abs(a + c - 2 * b) + std::abs(b + d - 2 * c); };
    const auto wall = [&](int x, int y, int u, int v) {
        parts.quadrangle(foot(x, y), foot(u, v), top(u, v), top(x, y));
    };
    for (int y = 0; y + 1 < depth; ++y)
        for (int x = 0; x + 1 < width; ++x) {
            const int rising = bend(height(x - 1, y - 1), height(x, y), height(x + 1, y + 1), height(x + 2, y + 2));
            const int falling = bend(height(x - 1, y + 2), height(x, y + 1), height(x + 1, y), height(x + 2, y - 1));
            const bool cut_rising =
                dsp.cut == Dsp::Cut::lower_left || (dsp.cut == Dsp::Cut::adaptive && rising < falling);
            if (cut_rising) {
                parts.triangle(top(x, y), top(x + 1, y), top(x + 1, y + 1));
                parts.triangle(top(x, y), top(x + 1, y + 1), top(x, y + 1));
            } else {
                parts.triangle(top(x, y), top(x + 1, y), top(x, y + 1));
                parts.triangle(top(x + 1, y), top(x + 1, y + 1), top(x, y + 1));
            }
            parts.quadrangle(foot(x, y), foot(x + 1, y), foot(x + 1, y + 1), foot(x, y + 1));
            if (y == 0) wall(x, y, x + 1, y);
            if (x == 0) wall(x, y, x, y + 1);
            if (y + 2 == depth) wall(x, y + 1, x + 1, y + 1);
            if (x + 2 == width) wall(x + 1, y, x + 1, y + 1);
        }
    return parts;
}

}  // namespace csgrt::oracle
