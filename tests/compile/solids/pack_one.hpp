// One solid packed after the other, by one thread.
#pragma once

#include <unordered_set>
#include <vector>

#include "compile/solids/packer.hpp"

namespace csgrt::test {

/// Appends a solid in its place to `scene`, except for its planes, which stay in the table. `box` is the solid's own,
/// or the scene's if it is not bounded.
inline void pack_one(const Shape& shape, const Matrix& matrix, const Box& box, CompiledScene& scene, PlaneTable& planes,
                     SurfaceTable& surfaces, SharedParts& shared) {
    std::vector<Plane> faces;
    Packer packer{matrix, scene, shared, scene.reals, faces};
    kernel::SolidRecord& record = packer.record;
    record.first_real = static_cast<std::uint32_t>(scene.reals.size());
    std::visit(packer, shape);
    if (const auto surface =
            surfaces.surface_of(record.type, scene.reals.data() + record.first_real, packer.axes_in_world, box)) {
        const std::size_t count = scene.reals.size() - record.first_real;
        const SurfaceTable::Found found = surfaces.add(
            *surface, record.first_real,
            [&](std::uint32_t real) { return std::span<const double>(scene.reals.own()).subspan(real, count); },
            [&](std::uint32_t) { return packer.axes_in_world; });
        std::vector<double>& reals = scene.reals;
        if (found.gives) std::copy_n(reals.begin() + record.first_real, count, reals.begin() + found.solid);
        if (found.solid != record.first_real) reals.resize(record.first_real);
        record.first_real = found.solid;
    }
    record.first_plane = static_cast<std::uint32_t>(scene.words.size());
    std::unordered_set<kernel::PlaneRef> seen;
    for (const Plane& face : faces) {
        const kernel::PlaneRef ref = planes.add(face, box);
        if (seen.insert(ref).second || !packer.is_polyhedron) scene.words.push_back(ref);
    }
    record.plane_count = static_cast<std::uint32_t>(scene.words.size()) - record.first_plane;
    scene.solids.push_back(record);
}

}  // namespace csgrt::test
