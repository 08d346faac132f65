// Host memory: how much the host has, and how much is available.
#pragma once

#include <cstdint>

namespace csgrt {

/// The bytes that this process can still take: the system's available memory or, in a container, the rest of its
/// control group's limit if that is less. 0 if the system does not report a number.
std::uint64_t available_host_memory();

/// The bytes of the system's whole memory. 0 if the system does not report a number.
std::uint64_t host_memory();

}  // namespace csgrt
