#include "compile/bounds/instance_bounds.hpp"

#include "compile/solids/polyhedron.hpp"
#include "base/parallel.hpp"

namespace csgrt {

namespace {
constexpr std::size_t chunk_size = 1024;
}

InstanceBounds::InstanceBounds(const Scene& scene, const FlatScene& flat)
    : chunks_((flat.instances.size() + chunk_size - 1) / chunk_size) {
    const std::size_t count = flat.instances.size();
    resize_cleared(boxes, count);
    resize_cleared(brlcad_boxes, count);
    resize_cleared(first_face_, count);
    for_chunks(count, chunk_size, 0, [&](std::size_t first, std::size_t last, std::size_t number) {
        std::vector<Plane>& planes = chunks_[number];
        for (std::size_t i = first; i < last; ++i) {
            first_face_[i] = static_cast<std::uint32_t>(planes.size());
            const std::vector<Plane> own = set_boxes(scene, flat, i);
            planes.insert(planes.end(), own.begin(), own.end());
        }
    });
}

/// Sets the boxes of an instance. Returns its faces, if it is an arb.
std::vector<Plane> InstanceBounds::set_boxes(const Scene& scene, const FlatScene& flat, std::size_t number) {
    const Instance& instance = flat.instances[number];
    const Shape& shape = shape_of(scene, flat, instance);
    ArbFaces faces{};
    SolidBoxes both;
    if (const auto* arb = std::get_if<Arb>(&shape)) {
        faces = arb_faces(*arb, *instance.matrix);
        both = solid_boxes(shape, *instance.matrix, {}, &faces);
    } else {
        both = solid_boxes(shape, *instance.matrix, cuts_of(flat, instance));
    }
    boxes[number] = both.tight;
    brlcad_boxes[number] = both.brlcad;
    return std::move(faces.planes);
}

void InstanceBounds::measure(const Scene& scene, const FlatScene& flat, std::uint32_t instance) {
    const std::size_t had = faces(instance).size();
    const std::vector<Plane> now = set_boxes(scene, flat, instance);
    std::vector<Plane>& planes = chunks_[instance / chunk_size];
    const auto first = planes.begin() + first_face_[instance];
    planes.insert(planes.erase(first, first + static_cast<std::ptrdiff_t>(had)), now.begin(), now.end());
    for (std::size_t i = instance + 1; i < first_face_.size() && i % chunk_size != 0; ++i)
        first_face_[i] += static_cast<std::uint32_t>(now.size() - had);
}

std::span<const Plane> InstanceBounds::faces(std::size_t instance) const {
    const std::span<const Plane> chunk(chunks_[instance / chunk_size]);
    const std::size_t next = instance + 1, first = first_face_[instance];
    const bool is_last = next == first_face_.size() || next % chunk_size == 0;
    return chunk.subspan(first, (is_last ? chunk.size() : first_face_[next]) - first);
}

}  // namespace csgrt
