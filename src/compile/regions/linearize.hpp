// Linearizing trees: makes the 32-bit words that the kernels walk (layout.h has the format of a word).
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// The words of one tree.
struct LinearTree {
    std::uint32_t first_word = 0, word_count = 0;  ///< within `words`
    std::uint32_t stack = 0;                       ///< entries that the walk needs at most
};

/// Appends the tree to `words`. The tree must be false where no solid is. A tree without nodes has no words. Throws
/// Error (scene) if a position or a solid's number does not fit 29 bits.
LinearTree linearize(const FlatTree& tree, std::vector<std::uint32_t>& words);

/// Throws the same error if the trees of all regions have too many words together.
void check_tree_words(std::uint64_t count);

}  // namespace csgrt
