// Chunks of solids: the data between the steps of packing a scene. Each chunk has a fixed number of solids, and one
// thread works on it. The solids are the instances in their own order: the hierarchy, which numbers solids, does not
// decide which of several solids gives a shared surface its numbers.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <csgrt/scene.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "base/parallel.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/solids/planes.hpp"
#include "compile/solids/surfaces.hpp"

namespace csgrt {

/// A plane of a solid on its way into the scene's table: all data that the search needs, in one cache line.
struct alignas(64) PackedPlane {
    PlaneTable::Key key;
    kernel::PlaneRef ref = 0;  ///< in the scene's table
    std::uint16_t solid = 0;   ///< number of its solid within the chunk
    bool is_first = false;     ///< no equal plane comes before it
};
static_assert(sizeof(PackedPlane) == 64);

/// The packed solids of a chunk, before planes and surfaces that several solids share are found.
struct PackedChunk {
    static constexpr std::size_t size = 1024;
    static_assert(size % SharedList<SolidInfo>::chunk_size == 0);  // threads make different chunks of the list

    struct Part {
        std::uint32_t type;               ///< SOLID_x
        std::uint32_t first_real, reals;  ///< within the chunk; of a large solid, within the scene
        std::uint32_t first_word;         ///< of a large solid, within the scene
        std::uint32_t stands;             ///< the solid whose reals this solid uses: itself or an earlier solid
        std::uint32_t numbers;            ///< the solid whose reals are written for this solid: itself or a later solid
        std::uint32_t first_plane;        ///< within the chunk
        std::uint32_t first_record;       ///< of the planes that it has first: in the scene's table
        std::uint32_t first_ref, refs;    ///< within the chunk's references
        std::uint32_t faces, cuts;        ///< numbers of planes; equal faces of a polyhedron count once
        bool is_large, is_polyhedron;
        bool is_gone;  ///< it is in no list of solids any more
    };
    std::vector<Part> parts;  ///< one a solid
    std::vector<double> reals;
    std::vector<PackedPlane> planes;  ///< for each solid its faces, then its cuts
    /// For each plane, the first plane that is equal: its chunk; its index << 1 | whether it looks the other way.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> firsts;
    std::vector<std::pair<std::uint32_t, SurfaceTable::Surface>> surfaces;  ///< with their solids' numbers in the chunk
    std::vector<std::vector<PackedPlane>> large_faces;  ///< one list a large solid; not yet among `planes`
    std::vector<Warning> warnings;

    std::span<PackedPlane> planes_of(const Part& part) {
        return std::span(planes).subspan(part.first_plane, part.faces + part.cuts);
    }
};

/// Calls `call` with the number of each chunk, several at once.
template <class Call>
void for_each_chunk(const std::vector<PackedChunk>& chunks, const Call& call) {
    for_chunks(chunks.size(), 1, 0, [&](std::size_t number, std::size_t, std::size_t) { call(number); });
}

/// A shell: two solids with surfaces that became one, the first around the second. The space between them is lost.
struct Shell {
    std::uint32_t outer, inner;
    double thickness;  ///< millimetres
};
/// A list of the shells that are thicker than rounding: numbers from modellers are accurate to 1e-12 of a solid's size.
/// Any thread may add.
class Shells {
public:
    /// `common`: a box around the scene.
    explicit Shells(const Box& common) : rounding_(4 * coordinate_rounding * largest_coordinate(common)) {}
    /// Adds a shell. `depth`: how far the second solid lies within the first; negative: the first lies within the
    /// second. `box`: the box of the second solid.
    void add(std::size_t first, std::size_t second, double depth, const Box& box) {
        if (!(std::fabs(depth) > std::max(rounding_, 1e-12 * diagonal(box))) || first == second) return;
        if (depth < 0) std::swap(first, second);
        const std::lock_guard lock(mutex_);
        all_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second), std::fabs(depth)});
    }
    const std::vector<Shell>& all() const { return all_; }

private:
    double rounding_;
    std::mutex mutex_;
    std::vector<Shell> all_;
};

/// The search for planes that several solids share.
class PlaneSharing {
public:
    /// `empty`: a table without planes; `boxes`: one a solid; `common`: the box that is used for unbounded solids. All
    /// arguments outlive the search.
    PlaneSharing(std::vector<PackedChunk>& chunks, const PlaneTable& empty, const std::vector<Box>& boxes,
                 const Box& common, Shells& shells);
    /// Says that a solid has other planes; share_again() compares them, after all changed solids are told.
    void change(std::size_t solid);
    /// Says that a solid is gone.
    void remove(std::size_t solid);
    void share_again();
    /// Writes the planes of `shapes`, appends the references to its words, and sets the solids' ranges of references.
    /// `order`: the solids by number.
    void write(const std::vector<std::uint32_t>& order, Shapes& shapes, std::vector<Warning>& warnings);

private:
    void share(PlaneTable& table, std::span<const Shards::Member> members);
    const Box& box_of(std::size_t solid) const { return is_finite(boxes_[solid]) ? boxes_[solid] : common_; }

    std::vector<PackedChunk>& chunks_;
    const PlaneTable& empty_;
    const std::vector<Box>& boxes_;
    const Box& common_;
    Shells& shells_;
    std::size_t count_ = 0;  ///< of planes
    Shards shards_;
};

}  // namespace csgrt
