// Pack meshes: packs solids that are made of triangles. The triangles and their hierarchy are packed once, in their own
// space; then each instance is packed.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "compile/bvh/build.hpp"
#include "compile/solids/meshes/mesh_repair.hpp"
#include "compile/solids/packer.hpp"
#include "compile/solids/meshes/triangles.hpp"
#include "kernel_host/geometry.hpp"

namespace csgrt {

namespace {

/// The frame of a mesh in the kernels: vertices have `center` subtracted and are divided by `scale`, a power of two, so
/// that they lie within MESH_RADIUS.
struct MeshFrame {
    Vec3 center;
    double scale = 1;

    Vec3 operator()(const Vec3& vertex) const {
        return narrow((wide(vertex) - wide(center)) / static_cast<long double>(scale));
    }
};

MeshFrame frame_of(const Triangles& mesh) {
    Box box = empty_box;
    for (const auto& face : mesh.faces)
        for (const std::uint32_t corner : face) extend(box, mesh.vertices[corner]);
    MeshFrame frame;
    if (is_empty(box)) return frame;
    frame.center = narrow(0.5L * (wide(box.low) + wide(box.high)));
    long double square = 0;
    for (const auto& face : mesh.faces)
        for (const std::uint32_t corner : face) {
            const Wide from = wide(mesh.vertices[corner]) - wide(frame.center);
            square = std::max(square, glm::dot(from, from));
        }
    const long double radius = std::sqrt(square);
    constexpr long double margin = 1.001L;  // rounding, also to float, moves no vertex beyond the radius
    int exponent = 0;
    std::frexp(radius * margin, &exponent);
    frame.scale = std::ldexp(1.0, exponent);
    return frame;
}

/// Reserves memory in a vector. If the vector grows, it at least doubles, since a scene may have very many meshes.
template <class T>
void make_room(std::vector<T>& to, std::size_t more) {
    if (to.capacity() - to.size() < more) to.reserve(std::max(2 * to.capacity(), to.size() + more));
}

/// Adds a mesh. Before its vertices it stores center and scale, which only the host reads. Returns the faces in the
/// order of the hierarchy's leaves.
std::vector<std::uint32_t> add_mesh(const Triangles& mesh, const MeshFrame& frame, Shapes& scene,
                                    std::uint32_t facing = 0) {
    if (mesh.faces.size() > most_triangles)
        throw Error(Status::scene, "a mesh of " + std::to_string(mesh.faces.size()) +
                                       " triangles cannot be rendered; less than 2^28 can");
    const auto first_word = scene.words.size(), first_node = scene.inner_nodes.size();
    for (const double x : {frame.center.x, frame.center.y, frame.center.z, frame.scale}) scene.reals.push_back(x);
    const auto first_real = scene.reals.size();

    std::vector<Vec3> local;
    local.reserve(mesh.vertices.size());
    make_room(scene.reals.own(), 3 * mesh.vertices.size());
    for (const Vec3& vertex : mesh.vertices) {
        local.push_back(frame(vertex));
        for (const double x : {local.back().x, local.back().y, local.back().z}) scene.reals.push_back(x);
    }
    const auto box_of = [&](std::size_t face) {
        Box box = empty_box;
        for (const std::uint32_t corner : mesh.faces[face]) extend(box, local[corner]);
        return box;
    };
    Hierarchy hierarchy = build_bvh(mesh.faces.size(), box_of, {}, 1, 0);
    const auto node_count = static_cast<std::uint32_t>(hierarchy.nodes.size());
    if (first_node == 0) {
        scene.inner_nodes = std::move(hierarchy.nodes);  // the only large mesh of most scenes: not copied
    } else {
        scene.inner_nodes.insert(scene.inner_nodes.end(), hierarchy.nodes.begin(), hierarchy.nodes.end());
    }

    make_room(scene.words.own(), MESH_TRIANGLES + 3 * mesh.faces.size());
    scene.words.resize(first_word + MESH_TRIANGLES);
    scene.words[first_word + MESH_VERTICES] = static_cast<std::uint32_t>(first_real);
    scene.words[first_word + MESH_NODES] = static_cast<std::uint32_t>(first_node);
    scene.words[first_word + MESH_NODE_COUNT] = node_count;
    scene.words[first_word + MESH_FACING] = facing;
    for (const std::uint32_t face : hierarchy.order)
        scene.words.insert(scene.words.end(), mesh.faces[face].begin(), mesh.faces[face].end());
    return std::move(hierarchy.order);
}

/// The opposite corners: for each edge of each face, from corner k to the next, the third corner of the other face at
/// this edge; NONE unless there is exactly one other face.
std::vector<std::array<std::uint32_t, 3>> across_edges(const Triangles& mesh) {
    struct Use {
        std::uint32_t low, high, face, edge;
    };
    std::vector<Use> uses;
    uses.reserve(3 * mesh.faces.size());
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(mesh.faces[face][k], mesh.faces[face][(k + 1) % 3]);
            uses.push_back({low, high, face, k});
        }
    const auto ends = [](const Use& use) { return std::pair(use.low, use.high); };
    std::sort(uses.begin(), uses.end(), [&](const Use& a, const Use& b) { return ends(a) < ends(b); });
    std::vector<std::array<std::uint32_t, 3>> across(mesh.faces.size(), {NONE, NONE, NONE});
    for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
        while (end < uses.size() && ends(uses[end]) == ends(uses[i])) ++end;
        if (end != i + 2) continue;
        const auto third = [&](const Use& use) { return mesh.faces[use.face][(use.edge + 2) % 3]; };
        across[uses[i].face][uses[i].edge] = third(uses[i + 1]);
        across[uses[i + 1].face][uses[i + 1].edge] = third(uses[i]);
    }
    return across;
}

/// The thickness that is given to a surface without thickness, millimetres. It is greater than the tolerance, within
/// which boundaries are one event, so the weave keeps the segment.
double skin_of(double tolerance) { return tolerance > 0 ? 2 * tolerance : 0.001; }

/// The position of a solid's words; `add` makes them if the solid has none yet.
template <class Add>
std::uint32_t shared_words(Packer& packer, const void* solid, const Add& add) {
    const auto next = static_cast<std::uint32_t>(packer.scene.words.size());
    const auto [known, is_new] = packer.shared.emplace(solid, next);
    if (is_new) add();
    return known->second;
}

/// Transforms a mesh whose words begin at `mesh`; `own` transforms it to the solid's space.
void place_mesh(Packer& packer, std::uint32_t mesh, const Matrix& own) {
    Shapes& scene = packer.scene;
    packer.record.first_real = static_cast<std::uint32_t>(scene.reals.size());
    const double* f = scene.reals.data() + scene.words[mesh + MESH_VERTICES] - 4;
    const long double scale = f[3];
    packer.frame(transform_point(own, {f[0], f[1], f[2]}), linear_part(own) * scale);
}

template <class S>
void pack_mesh(Packer& packer, const S& solid, const Matrix& own) {
    packer.record.type = SOLID_MESH;
    packer.record.first_word = shared_words(packer, &solid, [&] {
        const Triangles mesh = triangles_of(solid);
        add_mesh(mesh, frame_of(mesh), packer.scene);
    });
    place_mesh(packer, packer.record.first_word, own);
}

/// The direction of the triangles matters only if the surface has gaps: parity decides a closed surface, for certain.
void pack_volume(Packer& packer, const Bot& bot) {
    packer.record.type = SOLID_MESH;
    packer.record.first_word = shared_words(packer, &bot, [&] {
        RepairedMesh repaired = repair(bot);
        packer.notes = std::move(repaired.notes);
        const std::uint32_t facing = !repaired.decided_by_facing                             ? 0
                                     : bot.orientation == Bot::Orientation::counterclockwise ? 1
                                                                                             : 2;
        add_mesh(repaired.mesh, frame_of(repaired.mesh), packer.scene, facing);
    });
    place_mesh(packer, packer.record.first_word, identity);
}

void pack_plates(Packer& packer, const Bot& bot) {
    Shapes& scene = packer.scene;
    packer.record.type = SOLID_PLATE;
    packer.record.first_word = shared_words(packer, &bot, [&] {
        const std::size_t first_word = scene.words.size();
        scene.words.resize(first_word + PLATE_MESH);
        RepairedMesh repaired = repair(bot);
        packer.notes = std::move(repaired.notes);
        const MeshFrame frame = frame_of(repaired.mesh);
        const std::vector<std::uint32_t> order = add_mesh(repaired.mesh, frame, scene);
        const std::vector<std::array<std::uint32_t, 3>> across = across_edges(repaired.mesh);
        scene.words[first_word + PLATE_ACROSS] = static_cast<std::uint32_t>(scene.words.size());
        for (const std::uint32_t face : order)
            scene.words.insert(scene.words.end(), across[face].begin(), across[face].end());
        scene.words[first_word + PLATE_EXTENTS] = static_cast<std::uint32_t>(scene.reals.size());
        scene.words[first_word + PLATE_ALONG_RAY] = bot.mode == Bot::Mode::plate_nocos ? 1 : 0;
        for (const std::uint32_t number : order) {
            const std::uint32_t face = repaired.from[number];
            const double thickness = bot.mode == Bot::Mode::surface ? 0 : bot.thickness[face] / frame.scale;
            const bool append = !bot.append.empty() && bot.append[face] != 0;
            scene.reals.push_back(append ? 0 : thickness / 2);
            scene.reals.push_back(append ? thickness : thickness / 2);
        }
    });
    place_mesh(packer, packer.record.first_word + PLATE_MESH, identity);
    packer.real(skin_of(scene.tolerance));
}

}  // namespace

void Packer::operator()(const Bot& s) {
    if (s.mode == Bot::Mode::volume)
        pack_volume(*this, s);
    else
        pack_plates(*this, s);
}
void Packer::operator()(const Ars& s) { pack_mesh(*this, s, identity); }
void Packer::operator()(const Nmg& s) { pack_mesh(*this, s, identity); }
void Packer::operator()(const Vol& s) { pack_mesh(*this, s, grid_matrix(s)); }
void Packer::operator()(const Dsp& s) { pack_mesh(*this, s, s.matrix); }

}  // namespace csgrt
