// Trees -> their terms (kernels/boolean/claim.h): what evaluation needs besides the words.
#pragma once

#include "compile/compiled_scene.hpp"

namespace csgrt {

/// Finds the terms of all regions' trees: which of them each solid starts (`starts`), where it stands in large ones
/// (appended to `trees`), and the roles of solids in those that are not short, which are appended to `trees`; and
/// where a term may begin (`begins`), and what claims where a solid alone covers (`alone`). `halves`: one a solid,
/// whether it is a half-space. Returns records of as many solids that say no more than this.
std::vector<kernel::SolidRecord> list_terms(Logic& logic, const std::vector<bool>& halves);

/// Appends the table of roles of the term in the words from `first` to `end`. Returns where it begins; NONE: there is
/// no room.
std::uint32_t write_roles(std::vector<std::uint32_t>& trees, std::uint32_t first, std::uint32_t end);

/// Notes at the solids of that term where it may begin to be true: as the ray enters them, leaves them, or both.
/// May be called by several threads at once.
void mark_begins(const std::vector<std::uint32_t>& trees, std::uint32_t first, std::uint32_t end,
                 std::vector<kernel::SolidRecord>& solids);

}  // namespace csgrt
