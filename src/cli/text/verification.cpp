#include "verification.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "cli/commands/compare.hpp"
#include "partitions.hpp"
#include "statistics.hpp"

namespace csgrt::cli {

namespace {

constexpr std::size_t most_printed = 5;  ///< number of printed rays of each kind; --json has more

const char* where_wrong(const WrongRay& ray) {
    if (ray.on_device && ray.on_reference) return "device and reference";
    return ray.on_device ? "device" : "reference";
}

std::string figure_row(const char* name, const std::string& value) {
    std::string text = name;
    text.resize(std::max<std::size_t>(text.size() + 2, 18), ' ');
    return text + value + "\n";
}

std::string brief(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::string path(const Renderer& judged, std::uint32_t region) {
    std::string text;
    append_name(text, judged.model().regions()[region].path);
    return text;
}

std::string line_of(const NumberedRay& ray) {
    return "  ray " + std::to_string(ray.index) + ": " + numbers_of(ray.ray, " ") + "\n";
}

std::string lines_of(const RegionDifference& difference, const char* found, const Renderer& judged) {
    std::string text;
    for (const auto& [name, regions] : {std::pair{"113 bits", &difference.exact}, {found, &difference.found}}) {
        text += std::string("    ") + name + ":";
        for (const std::uint32_t region : *regions) text += " " + path(judged, region);
        text += regions->empty() ? " nothing\n" : "\n";
    }
    return text;
}

std::string error_row(const char* name, const EndError& error, const Renderer& judged) {
    if (!(error.millimetres > 0)) return figure_row(name, "0");
    std::string text =
        figure_row(name, brief(error.millimetres) + " mm, " + brief(error.ulps) + " ulp, " + brief(error.distance) +
                             " mm along ray " + std::to_string(error.index) + " at " + path(judged, error.region));
    return text + line_of(error);
}

// ---- JSON ----

std::string json_number(double value) {
    if (!std::isfinite(value)) return "null";
    std::string text;
    append_number(text, value);
    return text;
}

std::string json_ray(const NumberedRay& ray) {
    return "\"index\": " + std::to_string(ray.index) + ", \"ray\": [" + numbers_of(ray.ray, ", ") + "]";
}

std::string json_regions(const char* name, const std::vector<std::uint32_t>& regions, const Renderer& judged) {
    std::string text;
    for (const std::uint32_t region : regions)
        text += (text.empty() ? "" : ", ") + json_text(judged.model().regions()[region].path);
    return std::string(", \"") + name + "\": [" + text + "]";
}

std::string json_difference(const RegionDifference& difference, const Renderer& judged) {
    return json_regions("exact", difference.exact, judged) + json_regions("found", difference.found, judged);
}

template <class Items, class Write>
std::string json_list(const char* name, const Items& items, const Write& write) {
    std::string text;
    for (const auto& item : items) text += (text.empty() ? "\n    {" : ",\n    {") + write(item) + "}";
    return std::string(",\n  \"") + name + "\": [" + text + (text.empty() ? "]" : "\n  ]");
}

std::string json_error(const char* name, const EndError& error, const Renderer& judged) {
    std::string text = std::string(",\n  \"") + name + "\": ";
    if (!(error.millimetres > 0)) return text + "null";
    return text + "{\"millimetres\": " + json_number(error.millimetres) + ", \"ulps\": " + json_number(error.ulps) +
           ", \"distance\": " + json_number(error.distance) +
           ", \"region\": " + json_text(judged.model().regions()[error.region].path) + ", " + json_ray(error) + "}";
}

}  // namespace

std::string to_text(const Verification& result, const Renderer& judged) {
    const bool alone = result.device.empty();
    std::string text =
        figure_row("device", alone ? "none, the reference alone" : result.device) +
        figure_row("rays", std::to_string(result.rays)) + figure_row("hits", std::to_string(result.hits)) +
        figure_row("decided", std::to_string(result.decided)) + figure_row("ties", std::to_string(result.ties)) +
        figure_row("wrong regions", std::to_string(result.wrong)) +
        figure_row("bit differences", alone ? "not compared" : std::to_string(result.bit_differences)) +
        figure_row("distances",
                   std::to_string(result.ends) + ", and " + std::to_string(result.leaping_ends) + " that leap") +
        error_row("most millimetres", result.farthest, judged) + error_row("most ulps", result.worst, judged);
    for (std::size_t i = 0; i < std::min(result.wrong_rays.size(), most_printed); ++i) {
        const WrongRay& ray = result.wrong_rays[i];
        text += "\nwrong on the " + std::string(where_wrong(ray)) + "\n" + line_of(ray) +
                lines_of(ray.difference, "found", judged);
    }
    for (std::size_t i = 0; i < std::min(result.different_rays.size(), most_printed); ++i)
        text += "\nother bits on the device than on the reference\n" + line_of(result.different_rays[i]);
    std::vector<Tie> ties = result.tie_kinds;
    std::stable_sort(ties.begin(), ties.end(), [](const Tie& a, const Tie& b) { return a.rays > b.rays; });
    for (std::size_t i = 0; i < std::min(ties.size(), most_printed); ++i)
        text += "\na tie, as " + counted(ties[i].rays, "ray") + " in all\n" + line_of(ties[i]) +
                lines_of(ties[i].difference, "varied", judged);
    return text;
}

std::string to_json(const Verification& result, const Renderer& judged) {
    const Statistics& how = judged.statistics();
    std::string text = "{\n  \"device\": " + (result.device.empty() ? "null" : json_text(result.device)) +
                       ",\n  \"precision\": " + json_text(how.precision) +
                       ",\n  \"tolerance\": " + json_number(how.tolerance);
    const std::pair<const char*, std::uint64_t> counts[] = {
        {"rays", result.rays},       {"hits", result.hits},
        {"decided", result.decided}, {"ties", result.ties},
        {"wrong", result.wrong},     {"bit_differences", result.bit_differences},
        {"ends", result.ends},       {"leaping_ends", result.leaping_ends},
    };
    for (const auto& [name, count] : counts) text += std::string(",\n  \"") + name + "\": " + std::to_string(count);
    text += json_error("most_millimetres", result.farthest, judged) + json_error("most_ulps", result.worst, judged);
    text += json_list("wrong_rays", result.wrong_rays, [&](const WrongRay& ray) {
        return json_ray(ray) + ", \"on\": " + json_text(where_wrong(ray)) + json_difference(ray.difference, judged);
    });
    text += json_list("different_rays", result.different_rays, json_ray);
    text += json_list("tie_kinds", result.tie_kinds, [&](const Tie& tie) {
        return json_ray(tie) + ", \"rays\": " + std::to_string(tie.rays) + json_difference(tie.difference, judged);
    });
    return text + "\n}\n";
}

}  // namespace csgrt::cli
