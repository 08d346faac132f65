// Scene -> CompiledScene: everything that the five kernels and the reference need, in the order in which they need it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>
#include <csgrt/scene.hpp>

#include "base/shared_vector.hpp"
#include "base/srgb.hpp"
#include "kernel_host/kernels.hpp"

namespace csgrt {

/// A region's tree as the model gives it (after flattening), in postfix order, for the reference: it shares nothing
/// with the linearized words but the numbers of the solids.
struct FlatTree {
    struct Node {
        Operator op = Operator::leaf;
        std::uint32_t arity = 0;
        std::uint32_t solid = 0;  ///< leaf
    };
    std::vector<Node> nodes;
};

/// Where a region's tree stands in `trees`.
struct RegionWords {
    std::uint32_t first_word = 0, word_count = 0;
};

/// A region that shines.
struct RegionLight {
    std::uint32_t region = 0;
    Matrix matrix = identity;  ///< of its first solid, by which its beam is turned
};

// What the steps of compilation make, each from the scene and what earlier steps have made. Solids are numbered: the
// unbounded ones first, then in the order of the hierarchy's leaves (some may stand in none: see Clipped). Models that
// differ in looks alone share the rest.

/// Where the solids stand.
struct Space {
    SharedVector<kernel::BvhNode> nodes;
    std::uint32_t unbounded_count = 0;
    std::uint32_t starting_node = 0;  ///< see kernel::Frame
    Vec3 center;                      ///< of the sphere around all bounded solids
    double radius = 0;
};

/// Which regions claim a partition.
struct Logic {
    SharedVector<std::uint32_t> trees;  ///< words; behind them where solids stand in large terms
    SharedVector<kernel::StartRecord> starts;
    std::uint32_t rank_ends[RANKS] = {};  ///< regions are numbered by rank: the number behind the last of each
    bool has_large_terms = false;         ///< of more than SCANNED_WORDS words
    // The rest stays on the host.
    SharedVector<RegionWords> regions;
    SharedVector<FlatTree> flat_trees;       ///< one a region
    SharedVector<RegionInfo> region_info;    ///< one a region
    std::vector<RegionLight> region_lights;  ///< of the regions that shine
    Box bounds;                         ///< of the regions (BRL-CAD's rules: a subtraction's box is its left side's)
    SharedVector<std::uint8_t> claims;  ///< one a region, 0: it claims nothing; none: all do. See claimed_by
};

/// What rays meet.
struct Shapes {
    SharedVector<kernel::SolidRecord> solids;
    SharedVector<double> reals;
    SharedVector<kernel::PlaneRecord> planes;
    SharedVector<std::uint32_t> words;  ///< of solids; behind them PlaneRefs
    SharedVector<kernel::BvhNode> inner_nodes;
    // The rest stays on the host.
    SharedVector<SolidInfo> solid_info;  ///< one a solid
    SharedVector<Box> solid_boxes;       ///< one a solid; infinite for the unbounded
    std::uint32_t solid_types = 0;       ///< bit SOLID_x: the scene has such solids
    double tolerance = 0;                ///< see Scene
};

/// What shading adds.
struct Looks {
    SharedVector<kernel::MaterialRecord> materials;  ///< one a region
    std::vector<kernel::LightRecord> lights;         ///< the scene's own; none: the view supplies one
    std::vector<double> background{0, 0, 0};
    double ambient = 0.4;
    SharedVector<kernel::DisplayBytes> display;  ///< one
    bool display_shading = false;  ///< colours are those that the model gives, not decoded to linear light

    /// A colour of the model in the values that are shaded.
    Vec3 shaded(const Vec3& color) const {
        if (display_shading) return color;
        return {linear_of_display(color.x), linear_of_display(color.y), linear_of_display(color.z)};
    }
};

class LateStatusTree;  // regions/status_tree.hpp

struct CompiledScene : Space, Logic, Shapes, Looks {
    std::shared_ptr<LateStatusTree> status_tree;  ///< made for the first deep ray of all
    std::uint64_t geometry_hash = 0;              ///< FNV-1a over all that looks do not change
    std::uint64_t hash = 0;         ///< FNV-1a over everything that crosses the bus: the same scene, the same number
    std::vector<Warning> warnings;  ///< see Model::warnings
};

struct CompileOptions {
    bool air = false;                 ///< keep air regions
    bool skip_unsupported = false;    ///< solids of unknown types are empty sets
    bool display_shading = false;     ///< see Settings
    std::uint64_t max_instances = 0;  ///< see Settings
};

/// Validates and compiles `objects` of `scene` (empty: its top objects). Throws Error (scene) with every finding.
CompiledScene compile(const Scene& scene, const std::vector<std::string>& objects = {},
                      const CompileOptions& options = {});

}  // namespace csgrt
