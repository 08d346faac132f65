// The result of a verification, as text and as JSON.
#pragma once

#include <string>

#include <csgrt/verify.hpp>

namespace csgrt::cli {

/// A table, the first wrong rays and the most frequent ties. Rays are written with 17 digits, as `csgrt shoot` reads
/// them.
std::string to_text(const Verification& result, const Renderer& judged);

/// One JSON object, with a line break after it. Infinite numbers are null.
std::string to_json(const Verification& result, const Renderer& judged);

}  // namespace csgrt::cli
