// Bytes text: amounts of memory as text.
#pragma once

#include <cstdint>
#include <string>

namespace csgrt {

/// "512 bytes", "1.5 MiB": one digit after the point.
std::string bytes_text(std::uint64_t bytes);

}  // namespace csgrt
