// Terms: makes from the trees the tables that evaluation needs besides the words (kernels/boolean/claim.h).
#pragma once

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// Finds the terms of all regions' trees. Lists for each solid the terms that it starts (`starts`), its positions in
/// large terms and its roles in terms that are not short (appended to `trees`), where a term may begin to be true
/// (`begins`), and the claim where this solid alone covers (`alone`). `halves`: one a solid, whether it is a
/// half-space. Returns records that have only these members set.
std::vector<kernel::SolidRecord> list_terms(Logic& logic, const std::vector<bool>& halves);

/// Appends the table of roles of the term in the words from `first` to `end`. Returns the table's position; NONE: the
/// positions of `trees` are used up.
std::uint32_t write_roles(std::vector<std::uint32_t>& trees, std::uint32_t first, std::uint32_t end);

/// Sets BEGINS_x of the term's solids: whether the term may begin to be true where the ray enters the solid, leaves it,
/// or both. Several threads may call it at once.
void mark_begins(const std::vector<std::uint32_t>& trees, std::uint32_t first, std::uint32_t end,
                 std::vector<kernel::SolidRecord>& solids);

}  // namespace csgrt
