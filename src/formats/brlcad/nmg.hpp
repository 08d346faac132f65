// Nmg on disk, as BRL-CAD writes it in binary databases and in the older text form.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <csgrt/solids.hpp>

namespace csgrt {

/// The number of records of each kind.
using NmgCounts = std::array<std::uint32_t, 26>;

/// Reads the faces of all shells. `bytes`: the records, kind after kind. Throws Fault at `offset` plus `step` times the
/// position of the wrong byte; `step` is 0 for a text, whose bytes have no positions of their own. An nmg with curved
/// faces is Unsupported.
Shape read_nmg(const NmgCounts& counts, std::string_view bytes, std::size_t offset, std::size_t step);

}  // namespace csgrt
