// Nmg: reader of a mesh's records, which binary databases and the older text form share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <csgrt/solids.hpp>

namespace csgrt {

/// The number of records of each kind.
using NmgCounts = std::array<std::uint32_t, 26>;

/// Reads the faces of all shells. `bytes`: the records, sorted by kind. Throws Fault at `offset` plus `step` times the
/// position of the wrong byte; for a text, `step` is 0. An nmg with curved faces is Unsupported.
Shape read_nmg(const NmgCounts& counts, std::string_view bytes, std::size_t offset, std::size_t step);

}  // namespace csgrt
