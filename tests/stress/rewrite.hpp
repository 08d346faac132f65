// Scenes that must look the same: trees written in other ways, and all moved at once.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt::stress {

enum class Rewriting {
    differences,         ///< a - b as what is in a and not in b
    de_morgan,           ///< a + b as not (not a and not b), a and b as not (not a + not b), a - b as not (not a + b)
    double_complements,  ///< a as not not a, at every node
    commuted             ///< the operands of union, intersection and xor, and what a difference takes off, in reverse
};

/// The trees of all regions, and of all combinations below them, written in another way. Combinations above regions
/// stay: there a union collects regions, and its order is theirs.
Scene rewritten(const Scene& scene, Rewriting how);
Tree rewritten(const Tree& tree, Rewriting how);

/// The scene with one object more, "moved", which holds `objects` under a matrix.
Scene moved(const Scene& scene, const std::vector<std::string>& objects, const Matrix& matrix);

}  // namespace csgrt::stress
