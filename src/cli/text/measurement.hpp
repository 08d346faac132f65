// The result of a measure, as text, as JSON and as CSV.
#pragma once

#include <string>

#include <csgrt/measure.hpp>

namespace csgrt::cli {

/// The figures of all together, then a table of the parts down to a depth of the tree, in at most `width` columns, then
/// the regions that no ray has met and those without a density.
std::string to_text(const Measurement& result, const MeasureRequest& request, int depth, std::size_t width);

/// One JSON object, with a line break after it. Figures that do not exist are null.
std::string to_json(const Measurement& result, const MeasureRequest& request);

/// A line of names, and a line for each part. Figures that do not exist are empty.
std::string to_csv(const Measurement& result);

/// "whole +- 0.02 %, 12 of 20 regions within 1 %": for a line of progress.
std::string to_note(const Measurement& so_far, const MeasureRequest& request);

}  // namespace csgrt::cli
