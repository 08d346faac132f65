// Regions' trees -> the status trees of deep rays. kernels/boolean/status_tree.h tells what they are.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

struct StatusTree {
    std::vector<std::uint32_t> links;         ///< one a pair of clusters, see layout.h
    std::vector<std::uint32_t> outside;       ///< clusters' functions where no solid covers, 16 a word
    std::vector<std::uint32_t> first_leaves;  ///< one a solid and one behind: where its leaves begin
    std::vector<std::uint32_t> leaves;        ///< cluster << 2 | what of its function changes where the solid covers
};

/// The trees of all regions: two clusters a leaf and region at most. From a leaf of a region of n leaves to the region
/// it is no more than 2 log2(n) + 2 links. Takes a time that grows as n log(n), whatever the tree's depth.
/// Throws Error (scene) if there are more clusters than 29 bits can number.
StatusTree make_status_tree(const CompiledScene& scene);

/// A scene's, made when it is first asked for. Any thread.
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
