// The result of a check, as text, as JSON, as JUnit's XML, and as rays.
#pragma once

#include <string>

#include <csgrt/check.hpp>

namespace csgrt::cli {

/// A table with two lines for each overlap, in at most `width` columns unless a path is longer, then what they add up
/// to.
std::string to_text(const CheckResult& result, const CheckRequest& request, const Model& model, std::size_t width);

/// One JSON object, with a line break after it.
std::string to_json(const CheckResult& result, const CheckRequest& request, const Model& model);

/// JUnit's XML: a test for each overlap, which fails if the overlap is new, or one that passes. `scene`: its name.
std::string to_junit(const CheckResult& result, const Model& model, const std::string& scene);

/// For each overlap a comment, and a ray that shows it.
std::string to_rays(const CheckResult& result, const Model& model);

/// "12 overlaps, 3456 rays": for a line of progress. Then what is to come for --certain, if there is anything.
std::string to_note(const CheckResult& so_far);

}  // namespace csgrt::cli
