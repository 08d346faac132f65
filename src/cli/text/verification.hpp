// Verification's result, for people and for machines.
#pragma once

#include <string>

#include <csgrt/verify.hpp>

namespace csgrt::cli {

/// A table, then the first wrong rays and the most frequent ties. Rays have 17 digits and the form that `csgrt shoot`
/// reads.
std::string to_text(const Verification& result, const Renderer& judged);

/// One JSON object, with a line break after it. Infinite numbers are null.
std::string to_json(const Verification& result, const Renderer& judged);

}  // namespace csgrt::cli
