// How much memory the host has, and still has.
#pragma once

#include <cstdint>

namespace csgrt {

/// Bytes that this process can still take: what the system has available, or the rest of its control group's limit if
/// that is less (a container). 0 if the system does not say.
std::uint64_t available_host_memory();

/// Bytes of memory that the system has in all; 0 if it does not say.
std::uint64_t host_memory();

}  // namespace csgrt
