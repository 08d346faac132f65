// BRL-CAD's nmg as it stands on disk, the same in binary databases and in the older text ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <csgrt/solids.hpp>

namespace csgrt {

/// How many records of each kind there are.
using NmgCounts = std::array<std::uint32_t, 26>;

/// The faces of all shells. `bytes` are the records, kind after kind. Throws Fault at `offset` plus `step` times the
/// byte where something is wrong: a step of 0 for a text, whose bytes have no places of their own. An nmg with curved
/// faces is Unsupported.
Shape read_nmg(const NmgCounts& counts, std::string_view bytes, std::size_t offset, std::size_t step);

}  // namespace csgrt
