#include "compile/solids/meshes/triangles.hpp"

#include "compile/solids/meshes/triangulate.hpp"

namespace csgrt {

Triangles triangles_of(const Ars& ars) {
    Triangles mesh;
    const auto points = static_cast<std::uint32_t>(ars.curves.front().size());
    for (const auto& curve : ars.curves) mesh.vertices.insert(mesh.vertices.end(), curve.begin(), curve.end());
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
        if (p != q && q != r && r != p) mesh.triangle(a, b, c);  // many curves are a point, or end in a point
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
