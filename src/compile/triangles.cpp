#include "compile/triangles.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "compile/triangulate.hpp"

namespace csgrt {

Triangles triangles_of(const Bot& bot) { return {bot.vertices, bot.faces}; }

bool is_closed(const Triangles& mesh) {
    const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
    std::vector<std::uint32_t> order(count), point(count);
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) {
        const Vec3& v = mesh.vertices[i];
        return std::tuple(v.x, v.y, v.z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (std::uint32_t i = 0; i < count; ++i)
        point[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? point[order[i - 1]] : order[i];

    std::vector<std::uint64_t> edges;
    edges.reserve(3 * mesh.faces.size());
    for (const auto& face : mesh.faces)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(point[face[k]], point[face[(k + 1) % 3]]);
            if (low != high) edges.push_back(std::uint64_t{low} << 32 | high);
        }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
        while (next < edges.size() && edges[next] == edges[i]) ++next;
        if ((next - i) % 2 != 0) return false;
    }
    return true;
}

Triangles triangles_of(const Ars& ars) {
    Triangles mesh;
    const auto points = static_cast<std::uint32_t>(ars.curves.front().size());
    for (const auto& curve : ars.curves) mesh.vertices.insert(mesh.vertices.end(), curve.begin(), curve.end());
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
        if (p != q && q != r && r != p) mesh.triangle(a, b, c);  // many curves are a point, or close with one
    };
    for (std::uint32_t i = 0; i + 1 < ars.curves.size(); ++i) {
        const std::uint32_t one = i * points, next = one + points;
        for (std::uint32_t j = 0; j < points; ++j) {
            const std::uint32_t k = (j + 1) % points;
            add(one + j, one + k, next + k);
            add(one + j, next + k, next + j);
        }
    }
    return mesh;
}

Triangles triangles_of(const Nmg& nmg) {
    Triangles mesh{nmg.vertices, {}};
    for (const auto& loops : nmg.faces) triangulate(mesh.vertices, loops, mesh.faces);
    return mesh;
}

}  // namespace csgrt
