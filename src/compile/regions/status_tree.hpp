// Status trees of deep rays, made of the regions' trees. kernels/boolean/status_tree.h explains them.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// The status trees of a scene, as tables for the device.
struct StatusTree {
    std::vector<std::uint32_t> links;         ///< one a pair of clusters, see layout.h
    std::vector<std::uint32_t> outside;       ///< the clusters' functions where no solid covers, 16 a word
    std::vector<std::uint32_t> first_leaves;  ///< one a solid, and one more: where the solid's leaves begin
    std::vector<std::uint32_t> leaves;        ///< cluster << 2 | the bits of its function that change where the solid
                                              ///< covers
};

/// Makes the trees of all regions: at most two clusters for each leaf and each region. In a region of n leaves, at most
/// 2 log2(n) + 2 links lead from a leaf to the region. The time grows as n log(n), whatever the tree's depth. Throws
/// Error (scene) if there are more clusters than 29 bits can number.
StatusTree make_status_tree(const CompiledScene& scene);

/// A scene's status tree, which is made at the first use. Any thread may ask for it.
class LateStatusTree {
public:
    static const StatusTree& of(const CompiledScene& scene) {
        LateStatusTree& late = *scene.status_tree;
        std::call_once(late.is_made_, [&] { late.tree_ = make_status_tree(scene); });
        return late.tree_;
    }

private:
    std::once_flag is_made_;
    StatusTree tree_;
};

}  // namespace csgrt
