// Texts of statistics for the option --stats.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt::cli {

/// The text in quotes, as a string of JSON.
std::string json_text(std::string_view text);

/// One JSON object, with a line break after it.
std::string to_json(const Statistics& statistics);

/// The last frame's counts, and the median of each time over the frames. Of several frames the first, which warms up,
/// is left out. `frames` must not be empty.
Statistics median_of(const std::vector<Statistics>& frames);

}  // namespace csgrt::cli
