// Pack scene: packs the solids of a scene with several threads. Shared planes and surfaces are found as one thread
// would find them in the order of the instances, so the result depends neither on the threads nor on the hierarchy.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compile/pack_chunks.hpp"
#include "compile/solids/pack.hpp"

namespace csgrt {

/// The packer of a scene's solids works in steps: each solid by itself, then shared surfaces and planes, then the
/// layout of all numbers in the order of the solids. In each step several threads work on chunks. An edit repeats the
/// first steps for the instances that it changes.
class ScenePacker {
public:
    /// Packs all instances. All arguments outlive the packer. `space`: its sphere is known. `common`: the box that is
    /// used for unbounded solids. `clipped` tells which half-spaces are bounded, and by which box. Throws Error (scene)
    /// for a type that csgrt does not know, or when the tables exceed 32 bits.
    ScenePacker(const Scene& scene, const FlatScene& flat, const InstanceBounds& measured, const Clipped& clipped,
                const Space& space, const Box& common);
    ScenePacker(const ScenePacker&) = delete;

    /// Takes instances out, before repack() ends the change. False: see repack().
    bool remove(std::span<const std::uint32_t> instances);
    /// Packs instances again, which have other matrices. False: a scene with them has to be packed anew, and nothing
    /// more is asked of this packer.
    bool repack(std::span<const std::uint32_t> instances);

    /// Lays out the tables. `order`: all instances that are left, as solids are numbered; `terms`: their records, as
    /// list_terms gives them. `again`: not for the last time.
    Shapes lay_out(const std::vector<std::uint32_t>& order, const std::vector<kernel::SolidRecord>& terms, bool again,
                   std::vector<Warning>& warnings);

private:
    /// A solid that was packed by itself.
    struct Alone {
        PackedChunk::Part part;
        std::optional<SurfaceTable::Surface> surface;
    };
    Alone pack_alone(std::uint32_t instance, std::vector<double>& reals, std::vector<PackedPlane>& planes,
                     std::vector<Warning>& warnings);
    void pack_large();
    void pack_large(std::uint32_t instance);
    void share_surfaces();
    void share(SurfaceTable& table, std::span<const Shards::Member> members);
    void lay_out_reals(const std::vector<std::uint32_t>& order, Shapes& shapes) const;
    void note_shells(std::vector<Warning>& warnings) const;

    std::optional<std::size_t> surface_number(std::uint32_t instance);
    bool ends(std::uint32_t instance) const;
    void append_keys(const std::vector<Plane>& planes, std::vector<PackedPlane>& keys) const;
    WideMatrix axes_of(std::uint32_t instance);
    PackedChunk& chunk_of(std::uint32_t instance) { return chunks_[instance / PackedChunk::size]; }
    PackedChunk::Part& part_of(std::uint32_t instance) {
        return chunk_of(instance).parts[instance % PackedChunk::size];
    }
    const PackedChunk::Part& part_of(std::uint32_t instance) const {
        return chunks_[instance / PackedChunk::size].parts[instance % PackedChunk::size];
    }
    std::span<const double> reals_of(std::uint32_t instance) const {
        const PackedChunk::Part& part = part_of(instance);
        return std::span(chunks_[instance / PackedChunk::size].reals).subspan(part.first_real, part.reals);
    }

    const Scene& scene_;
    const FlatScene& flat_;
    const InstanceBounds& measured_;
    const Clipped& clipped_;
    const Box common_;
    Shapes large_;       ///< the tables of solids without a fixed size, with which all tables begin
    PlaneTable planes_;  ///< empty, as is `surfaces_`: the shards' tables begin as copies
    SurfaceTable surfaces_;
    SharedParts shared_;
    Shells shells_;
    std::vector<PackedChunk> chunks_;
    Shards surface_shards_;
    SharedList<SolidInfo> infos_;             ///< of the last layout
    SharedList<Matrix> matrices_;             ///< of the last layout
    std::vector<std::uint32_t> moved_;        ///< the instances that were packed again since
    std::vector<std::uint32_t> infos_order_;  ///< its order
    std::optional<PlaneSharing> sharing_;
};

}  // namespace csgrt
