#include "compile/bounds/instance_bounds.hpp"

#include "compile/solids/polyhedron.hpp"
#include "base/parallel.hpp"

namespace csgrt {

namespace {
constexpr std::size_t chunk_size = 1024;
}

Measured::Measured(const Scene& scene, const FlatScene& flat)
    : chunks_((flat.instances.size() + chunk_size - 1) / chunk_size) {
    const std::size_t count = flat.instances.size();
    resize_cleared(boxes, count);
    resize_cleared(brlcad_boxes, count);
    resize_cleared(first_face_, count);
    for_chunks(count, chunk_size, 0, [&](std::size_t first, std::size_t last, std::size_t number) {
        std::vector<Plane>& planes = chunks_[number];
        for (std::size_t i = first; i < last; ++i) {
            const Instance& instance = flat.instances[i];
            const Shape& shape = shape_of(scene, flat, instance);
            first_face_[i] = static_cast<std::uint32_t>(planes.size());
            SolidBoxes both;
            if (const auto* arb = std::get_if<Arb>(&shape)) {
                const ArbFaces faces = arb_faces(*arb, *instance.matrix);
                planes.insert(planes.end(), faces.planes.begin(), faces.planes.end());
                both = solid_boxes(shape, *instance.matrix, {}, &faces);
            } else {
                both = solid_boxes(shape, *instance.matrix, cuts_of(flat, instance));
            }
            boxes[i] = both.tight;
            brlcad_boxes[i] = both.brlcad;
        }
    });
}

std::span<const Plane> Measured::faces(std::size_t instance) const {
    const std::span<const Plane> chunk(chunks_[instance / chunk_size]);
    const std::size_t next = instance + 1, first = first_face_[instance];
    const bool is_last = next == first_face_.size() || next % chunk_size == 0;
    return chunk.subspan(first, (is_last ? chunk.size() : first_face_[next]) - first);
}

}  // namespace csgrt
