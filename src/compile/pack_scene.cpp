// Solids are computed by several threads, a batch ahead; what they share is found one after the other, in their order,
// so that the result does not depend on the threads.
#include <algorithm>
#include <future>
#include <unordered_set>

#include "compile/pack_solids.hpp"
#include "compile/packer.hpp"
#include "compile/polyhedron.hpp"
#include "parallel.hpp"

namespace csgrt {

namespace {

/// Does its Packer keep off the scene? Solids of any size write there, and share what they are made of.
struct IsSmall {
    template <class Shape>
    bool operator()(const Shape&) const {
        return true;
    }
    bool operator()(const Metaball&) const { return false; }
    bool operator()(const Bot&) const { return false; }
    bool operator()(const Ars&) const { return false; }
    bool operator()(const Nmg&) const { return false; }
    bool operator()(const Ebm&) const { return false; }
    bool operator()(const Vol&) const { return false; }
    bool operator()(const Dsp&) const { return false; }
    bool operator()(const Extrude&) const { return false; }
    bool operator()(const Revolve&) const { return false; }
    bool operator()(const Unsupported&) const { return false; }
};

/// A small solid that has found nothing to share yet. Its reals and planes stand in its chunk, one solid's after the
/// other's.
struct Prepared {
    kernel::SolidRecord record;
    WideMatrix axes;
    std::uint32_t reals, planes;  ///< how many
    bool is_small, is_polyhedron;
};
struct Chunk {
    std::vector<Prepared> solids;
    std::vector<double> reals;
    std::vector<Plane> planes;
    std::vector<PlaneTable::Key> keys;  ///< one a plane
};

class Sharer {
public:
    Sharer(CompiledScene& scene, PlaneTable& planes, SurfaceTable& surfaces)
        : scene_(scene), planes_(planes), surfaces_(surfaces) {}

    /// The solid's reals end those of the scene already.
    void add(kernel::SolidRecord record, const WideMatrix& axes, const Plane* planes, const PlaneTable::Key* keys,
             std::size_t plane_count, bool is_polyhedron, const Matrix& matrix, const std::vector<Plane>& cuts,
             const Box& box) {
        if (record.type == SOLID_ELL || record.type == SOLID_TGC || record.type == SOLID_TOR)
            surfaces_.share(record, axes, box, scene_);
        const std::size_t first = scene_.plane_refs.size();
        seen_.clear();
        for (std::size_t i = 0; i < plane_count; ++i) {
            const kernel::PlaneRef ref = planes_.add(planes[i], keys[i], box);
            if (is_polyhedron && has(first, ref, plane_count)) continue;
            scene_.plane_refs.push_back(ref);
        }
        for (const Plane& cut : cuts) scene_.plane_refs.push_back(planes_.add(transform_plane(matrix, cut), box));
        if (scene_.reals.size() > 0xffffffffu || scene_.plane_refs.size() > 0xffffffffu ||
            scene_.words.size() > 0xffffffffu)
            throw Error(Status::scene, "the parameters of all solids together exceed 2^32 numbers");
        record.first_plane = static_cast<std::uint32_t>(first);
        record.plane_count = static_cast<std::uint32_t>(scene_.plane_refs.size() - first);
        scene_.solids.push_back(record);
    }

private:
    bool has(std::size_t first, kernel::PlaneRef ref, std::size_t count) {
        constexpr std::size_t few = 16;  // an arbn may have very many faces
        if (count > few) return !seen_.insert(ref).second;
        const auto own = scene_.plane_refs.begin() + static_cast<std::ptrdiff_t>(first);
        return std::find(own, scene_.plane_refs.end(), ref) != scene_.plane_refs.end();
    }

    CompiledScene& scene_;
    PlaneTable& planes_;
    SurfaceTable& surfaces_;
    std::unordered_set<kernel::PlaneRef> seen_;
};

}  // namespace

void pack_solid(const Shape& shape, const std::vector<Plane>& cuts, const Matrix& matrix, const Box& box,
                CompiledScene& scene, PlaneTable& planes, SurfaceTable& surfaces, SharedParts& shared) {
    std::vector<Plane> faces;
    Packer packer{matrix, scene, shared, scene.reals, faces};
    packer.record.first_real = static_cast<std::uint32_t>(scene.reals.size());
    std::visit(packer, shape);
    std::vector<PlaneTable::Key> keys;
    for (const Plane& face : faces) keys.push_back(planes.key_of(face));
    Sharer(scene, planes, surfaces)
        .add(packer.record, packer.axes_in_world, faces.data(), keys.data(), faces.size(), packer.is_polyhedron, matrix,
             cuts, box);
}

void pack_solids(const Scene& scene, const FlatScene& flat, const std::vector<std::uint32_t>& order,
                 const std::vector<Box>& boxes, const Box& common, CompiledScene& compiled) {
    constexpr std::size_t chunk_size = 1024, batch_size = 64 * chunk_size;
    PlaneTable planes(compiled.center, 0.5 * diagonal(common));
    SurfaceTable surfaces(compiled.center, compiled.radius);
    SharedParts shared;
    Sharer sharer(compiled, planes, surfaces);

    const auto prepare = [&](std::size_t batch) {
        const std::size_t begin = batch * batch_size, count = std::min(batch_size, order.size() - begin);
        std::vector<Chunk> chunks((count + chunk_size - 1) / chunk_size);
        for_chunks(count, chunk_size, 0, [&](std::size_t first, std::size_t last, std::size_t number) {
            Chunk& chunk = chunks[number];
            chunk.solids.reserve(last - first);
            for (std::size_t i = first; i < last; ++i) {
                const Instance& instance = flat.instances[order[begin + i]];
                const Shape& shape = shape_of(scene, flat, instance);
                Prepared prepared{};
                prepared.is_small = std::visit(IsSmall{}, shape);
                if (prepared.is_small) {
                    const std::size_t reals = chunk.reals.size(), faces = chunk.planes.size();
                    Packer packer{instance.matrix, compiled, shared, chunk.reals, chunk.planes};
                    std::visit(packer, shape);
                    prepared.record = packer.record;
                    prepared.axes = packer.axes_in_world;
                    prepared.reals = static_cast<std::uint32_t>(chunk.reals.size() - reals);
                    prepared.planes = static_cast<std::uint32_t>(chunk.planes.size() - faces);
                    prepared.is_polyhedron = packer.is_polyhedron;
                }
                chunk.solids.push_back(prepared);
            }
            chunk.keys.reserve(chunk.planes.size());
            for (const Plane& plane : chunk.planes) chunk.keys.push_back(planes.key_of(plane));
        });
        return chunks;
    };

    // Growing by copies costs more than memory that may stay unused.
    compiled.reals.reserve(13 * order.size());
    compiled.plane_refs.reserve(4 * order.size());
    planes.reserve(2 * order.size());
    compiled.solids.reserve(order.size());
    compiled.solid_info.reserve(order.size());
    compiled.solid_boxes.reserve(order.size());
    std::size_t next = 0;
    const auto share = [&](const Chunk& chunk) {
        const double* reals = chunk.reals.data();
        const std::size_t planes_in_all = chunk.planes.size();
        std::size_t face = 0;
        for (const Prepared& prepared : chunk.solids) {
            const std::uint32_t number = order[next++];
            const Instance& instance = flat.instances[number];
            const Solid& solid = std::get<Solid>(scene.objects[instance.object]);
            const Shape& shape = shape_of(scene, flat, instance);
            const std::vector<Plane>& cuts = cuts_of(flat, instance);
            const bool bounded = is_finite(boxes[number]);
            const Box& box = bounded ? boxes[number] : common;
            if (prepared.is_small) {
                kernel::SolidRecord record = prepared.record;
                record.first_real = static_cast<std::uint32_t>(compiled.reals.size());
                compiled.reals.insert(compiled.reals.end(), reals, reals + prepared.reals);
                // Most of the time would go by in waiting for memory.
                constexpr std::size_t soon = 8, later = 24;
                for (std::size_t i = face; i < face + prepared.planes; ++i) {
                    if (i + later < planes_in_all) planes.fetch_cell(chunk.keys[i + later]);
                    if (i + soon < planes_in_all) planes.fetch_record(chunk.keys[i + soon]);
                }
                sharer.add(record, prepared.axes, chunk.planes.data() + face, chunk.keys.data() + face, prepared.planes,
                           prepared.is_polyhedron, instance.matrix, cuts, box);
                reals += prepared.reals;
                face += prepared.planes;
            } else {
                pack_solid(shape, cuts, instance.matrix, box, compiled, planes, surfaces, shared);
            }
            compiled.solid_info.push_back({solid.name, type_name(solid.shape), instance.piece});
            compiled.solid_boxes.push_back(boxes[number]);
            compiled.solid_types |= 1u << compiled.solids.back().type;
            if (!bounded && !std::holds_alternative<Half>(shape))
                compiled.notes.push_back("the faces of " + solid.name + " do not close: it is not bounded");
        }
    };

    const std::size_t batches = (order.size() + batch_size - 1) / batch_size;
    std::vector<Chunk> chunks = batches > 0 ? prepare(0) : std::vector<Chunk>{};
    for (std::size_t batch = 0; batch < batches; ++batch) {
        std::future<std::vector<Chunk>> ahead;
        if (batch + 1 < batches) ahead = std::async(std::launch::async, prepare, batch + 1);
        for (const Chunk& chunk : chunks) share(chunk);
        if (ahead.valid()) chunks = ahead.get();
    }
    compiled.planes = planes.take();
}

}  // namespace csgrt
