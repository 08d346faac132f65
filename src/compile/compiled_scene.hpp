// Compiled scene: the data of a Scene that the kernels and the reference need.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>
#include <csgrt/scene.hpp>

#include "base/shared_vector.hpp"
#include "base/srgb.hpp"
#include "kernel_host/kernels.hpp"

namespace csgrt {

/// A region's tree after flattening, in postfix order, for the reference. Apart from the solids' numbers it is
/// independent of the words that the kernels read.
struct FlatTree {
    struct Node {
        Operator op = Operator::leaf;
        std::uint32_t arity = 0;
        std::uint32_t solid = 0;  ///< of a leaf
    };
    std::vector<Node> nodes;
};

/// The position of a region's tree in `trees`.
struct RegionWords {
    std::uint32_t first_word = 0, word_count = 0;
};

/// A region that emits light.
struct RegionLight {
    std::uint32_t region = 0;
    Matrix matrix = identity;  ///< of the region's first solid; it turns the light's beam
};

// The steps of compilation make the structs below, each from the scene and the results of earlier steps. Numbers of
// solids: the unbounded solids come first, then the others in the order of the hierarchy's leaves (some solids may be
// in no leaf: see Clipped). Models that differ only in appearance share all other structs.

/// The positions of solids.
struct Space {
    SharedVector<kernel::BvhNode> nodes;
    std::uint32_t unbounded_count = 0;
    std::uint32_t starting_node = 0;  ///< see kernel::Frame
    Vec3 center;                      ///< of the sphere around all bounded solids
    double radius = 0;
};

class LatePathTable;   // regions/path_table.hpp
class LateStatusTree;  // regions/status_tree.hpp

/// The data that decides which regions claim a partition.
struct Logic {
    SharedVector<std::uint32_t> trees;  ///< words of terms; then the positions of solids in large terms
    SharedVector<kernel::StartRecord> starts;
    std::uint32_t rank_ends[RANKS] = {};  ///< the number after the last region of each rank
    bool has_large_terms = false;         ///< of more than SCANNED_WORDS words
    // The members below stay on the host.
    SharedVector<RegionWords> regions;
    SharedVector<FlatTree> flat_trees;       ///< one a region
    SharedList<RegionInfo> region_info;      ///< one a region
    std::shared_ptr<LatePathTable> paths;    ///< of the regions; made for the first edit of their appearance
    SharedVector<std::uint8_t> states;       ///< State of each region; empty: all are shown
    std::vector<RegionLight> region_lights;  ///< of the regions that shine
    Box bounds;                              ///< of the regions, by BRL-CAD's rules (see tree_box)
    SharedVector<std::uint8_t> claims;       ///< one a region, 0: it claims nothing; empty: all claim (claimed_by)
    SharedVector<std::uint8_t> starting;     ///< one a node: whether a solid of it starts a term; empty: all claim
    std::optional<Box> claim_box;            ///< around the solids that start a term; none: all claim

    void set_state(std::size_t region, State state) {
        if (states.empty()) states.resize(region_info.size());
        states[region] = static_cast<std::uint8_t>(state);
    }
};

/// The shapes that rays meet.
struct Shapes {
    SharedVector<kernel::SolidRecord> solids;
    SharedVector<double> reals;
    SharedVector<kernel::PlaneRecord> planes;
    SharedVector<std::uint32_t> words;  ///< of solids; then PlaneRefs
    SharedVector<kernel::BvhNode> inner_nodes;
    // The members below stay on the host.
    SharedList<SolidInfo> solid_info;   ///< one a solid
    SharedList<Matrix> solid_matrices;  ///< one a solid: from its object's coordinates to the world's
    SharedVector<Box> solid_boxes;      ///< one a solid; infinite for the unbounded
    std::uint32_t solid_types = 0;      ///< bit SOLID_x: the scene has such solids
    double tolerance = 0;               ///< see Scene
};

/// Appearance: the data for shading.
struct Appearance {
    SharedList<kernel::MaterialRecord> materials;  ///< one a region
    std::uint64_t materials_hash = 0;              ///< the sum of their hashes, so that an edit hashes what it changes
    std::vector<kernel::LightRecord> lights;       ///< the scene's lights; empty: the view supplies a light
    std::vector<double> background{0, 0, 0};
    double ambient = 0.4;
    SharedVector<kernel::DisplayBytes> display;  ///< one
    bool display_shading = false;  ///< colours are shaded as the model gives them, not decoded to linear light

    /// A colour of the model, as the values for shading.
    Vec3 shaded(const Vec3& color) const {
        if (display_shading) return color;
        return {linear_of_display(color.x), linear_of_display(color.y), linear_of_display(color.z)};
    }
};

/// A scene as the kernels and the reference read it: numbered solids in a hierarchy, regions as words and terms, and
/// appearance. It never changes; copies share their tables. An edit that changes only colours makes a copy with another
/// Appearance.
struct CompiledScene : Space, Logic, Shapes, Appearance {
    std::shared_ptr<LateStatusTree> status_tree;  ///< made for the first deep ray
    std::uint64_t geometry_hash = 0;              ///< FNV-1a over everything except appearance
    std::uint64_t hash = 0;         ///< FNV-1a over everything that the device gets: equal scenes have equal hashes
    std::vector<Warning> warnings;  ///< see Model::warnings
};

/// The settings that have an effect on compilation.
struct CompileOptions {
    bool air = false;                 ///< keep air regions
    bool skip_unsupported = false;    ///< solids of unknown types are empty sets
    bool display_shading = false;     ///< see Settings
    std::uint64_t max_instances = 0;  ///< see Settings
};

/// The scene of a Model, valid as long as the Model is.
const CompiledScene& compiled_scene(const Model& model);

/// Validates and compiles `objects` of `scene` (empty: its top objects). Throws Error (scene) with every finding.
CompiledScene compile(const Scene& scene, const std::vector<std::string>& objects = {},
                      const CompileOptions& options = {});

}  // namespace csgrt
