// Host memory: how much the host has, and how much is available.
#pragma once

#include <cstdint>

namespace csgrt {

/// The bytes that this process can still take: the system's available memory, or the rest of its control group's limit
/// if it is less (a container). 0 if the system does not say.
std::uint64_t available_host_memory();

/// Bytes of memory that the system has in all; 0 if it does not say.
std::uint64_t host_memory();

}  // namespace csgrt
