#include "overlaps.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "cli/commands/compare.hpp"
#include "figures.hpp"
#include "form/written_back.hpp"
#include "partitions.hpp"
#include "statistics.hpp"

namespace csgrt::cli {

namespace {

/// The pattern of a list of allowed overlaps that a path alone fits.
std::string pattern_of(std::string_view path) {
    const bool has_quotes = path.find_first_of(" \t\r") != path.npos;
    std::string text;
    for (const char c : path) {
        if (std::string_view("*?[\\").find(c) != std::string_view::npos) text += '\\';
        text += (has_quotes && c == '"') || c == '\n' ? '?' : c;
    }
    return has_quotes ? '"' + text + '"' : text;
}

/// The paths of a pair's regions, as a list of allowed overlaps has them.
std::string row_of(const auto& o, const Model& model, const char* between = " ") {
    return pattern_of(model.regions()[o.regions[0]].path) + between + pattern_of(model.regions()[o.regions[1]].path);
}

/// The beginning of a pair's object in JSON.
std::string json_pair(const auto& o, const Model& model) {
    return "{\"regions\": [" + json_text(model.regions()[o.regions[0]].path) + ", " +
           json_text(model.regions()[o.regions[1]].path) + "], \"indices\": [" + std::to_string(o.regions[0]) + ", " +
           std::to_string(o.regions[1]) + "]";
}

/// Bytes at the front of a text that are one character of UTF-8 that XML may have; 0: they are none.
std::size_t character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t size = byte(0) < 0x80 ? 1 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
    if (text.size() < size || byte(0) > 0xf4 || (size > 1 && byte(0) < 0xc2)) return 0;
    std::uint32_t code = size == 1 ? byte(0) : byte(0) & (0xffu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    constexpr std::uint32_t least[] = {0x20, 0x80, 0x800, 0x10000};
    const bool is_none = (code >= 0xd800 && code < 0xe000) || code == 0xfffe || code == 0xffff || code > 0x10ffff;
    return code < least[size - 1] || is_none ? 0 : size;
}

std::string octal(char c) {
    char text[8];
    std::snprintf(text, sizeof text, "\\%03o", static_cast<unsigned>(static_cast<unsigned char>(c)));
    return text;
}

/// A text as a value or an attribute of XML. What XML cannot hold is written as \ooo, as in partitions.
std::string xml_text(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t size = character(text);
        const char c = text.front();
        if (size == 0)
            out += octal(c);
        else if (const std::size_t special = std::string_view("&<>\"'").find(c); special != std::string_view::npos)
            out += std::string("&") + std::array{"amp", "lt", "gt", "quot", "apos"}[special] + ";";
        else
            out += text.substr(0, size);
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return out;
}

}  // namespace

std::string to_text(const CheckResult& result, const CheckRequest& request, const Model& model, std::size_t width) {
    std::string text;
    const auto add_row = [&](const auto& pair) {
        const std::string row = row_of(pair, model);
        text += "  " + (row.size() + 2 <= width ? row : row_of(pair, model, "\n    ")) + "\n";
    };
    bool has_near = false, has_estimate = false;
    const auto seen = static_cast<std::uint64_t>(std::ranges::count(result.unlisted, true, &UnlistedPair::is_seen));
    std::uint64_t allowed = 0, less_deep = 0, perhaps_deeper = 0, not_certain = 0;
    if (!result.overlaps.empty())
        text +=
            right("depth mm", 10) + right("at most", 11) + right("volume mm^3", 14) + right("+-", 11) + "  place mm\n";
    for (const FoundOverlap& o : result.overlaps) {
        const bool is_known = o.depth > 0, is_near = is_known && o.is_near_limit;
        const bool is_less = !o.is_allowed && !o.is_new && result.is_complete;
        has_near |= is_near;
        has_estimate |= is_known && o.is_estimate;
        allowed += o.is_allowed;
        less_deep += is_less;
        const bool is_perhaps_deeper = is_less && o.depth_at_most >= request.min_depth;
        perhaps_deeper += is_perhaps_deeper;
        not_certain += o.depth < request.certain && o.depth_at_most >= request.certain;
        text += right((is_known ? format_number("%.5g", o.depth) : "-") + (is_known && o.is_estimate ? "?" : "") +
                          (is_near ? "~" : " "),
                      10) +
                right(format_number("%.5g", o.depth_at_most), 11) + right(format_number("%.5g", o.volume.value), 14) +
                right(relative(o.volume), 11) + "  " + point_of(o.place, "%.5g") +
                (o.is_allowed        ? "  allowed"
                 : is_perhaps_deeper ? "  perhaps deeper"
                 : is_less           ? "  less deep"
                                     : "") +
                "\n";
        add_row(o);
    }
    if (!text.empty()) text += "\n";
    if (has_near) text += "~ is near the limit: another seed may find the depth on its other side.\n";
    if (has_estimate) text += "? is an estimate: the ball was measured along rays, and may be too large.\n";
    text += counted(result.overlaps.size(), "overlap") + ": " + std::to_string(result.new_overlaps) + " new at least " +
            format_number("%g", request.min_depth) + " mm deep, " + std::to_string(allowed) + " allowed, " +
            std::to_string(less_deep) + " less deep" +
            (perhaps_deeper > 0 ? " (" + std::to_string(perhaps_deeper) + " perhaps deeper)" : "") + "\n" +
            "boxes that overlap: " + counted(result.candidates, "pair") + " of " +
            counted(model.regions().size(), "region") + "; shallower than " +
            format_number("%g", request.min_depth / 2) +
            (result.is_complete ? " mm: " + std::to_string(seen)
                                : " mm or not measured: " + std::to_string(result.shallow)) +
            "\n";
    if (!result.unlisted.empty()) {
        text += "not seen to overlap: " + counted(result.unlisted.size() - seen, "pair") +
                "; largest ball that is not excluded: " + format_number("%.4g", result.unlisted.front().depth_at_most) +
                " mm" + (request.certain > 0 ? "" : " (see --certain)") + "\n";
        add_row(result.unlisted.front());
    }
    if (request.certain > 0 && result.is_complete)
        text += "A ball of " + format_number("%g", request.certain) + " mm is in no pair that is not listed" +
                (not_certain > 0 ? "; in " + std::to_string(not_certain) + " of the listed it is not excluded" : "") +
                ".\n";
    text += counted(result.rays, "ray") + ", " + format_number("%.1f", result.seconds) + " s\n";
    return text + (result.is_complete ? "" : "The check was ended before it was complete.\n");
}

std::string to_json(const CheckResult& result, const CheckRequest& request, const Model& model) {
    const auto truth = [](bool is) { return is ? "true" : "false"; };
    std::string text =
        "{\n  \"seed\": " + std::to_string(request.seed) + ",\n  \"min_depth\": " + json_figure(request.min_depth) +
        ",\n  \"certain\": " + json_figure(request.certain) + ",\n  \"effort\": " + json_figure(request.effort) +
        ",\n  \"complete\": " + truth(result.is_complete) +
        ",\n  \"candidates\": " + std::to_string(result.candidates) +
        ",\n  \"shallow\": " + std::to_string(result.shallow) + ",\n  \"rays\": " + std::to_string(result.rays) +
        ",\n  \"new\": " + std::to_string(result.new_overlaps) + ",\n  \"overlaps\": [";
    const char* next = "\n    ";
    for (const FoundOverlap& o : result.overlaps) {
        text += std::string(next) + json_pair(o, model) +
                ", \"depth\": " + (o.depth > 0 ? json_figure(o.depth) : "null") +
                ", \"estimate\": " + truth(o.is_estimate) + ", \"depth_at_most\": " + json_figure(o.depth_at_most) +
                ", \"volume\": " + json_estimate(o.volume) + ", \"place\": " + json_point(o.place) +
                ", \"box\": " + json_corners(o.box) + ", \"new\": " + truth(o.is_new) +
                ", \"allowed\": " + truth(o.is_allowed) + ", \"near_limit\": " + truth(o.is_near_limit) +
                ", \"origin\": " + json_point(o.ray.origin) + ", \"direction\": " + json_point(o.ray.direction) +
                ", \"range\": [" + json_figure(o.t_in) + ", " + json_figure(o.t_out) +
                "], \"allow\": " + json_text(row_of(o, model)) + ", \"link\": " + json_text(link_of(o, model)) + "}";
        next = ",\n    ";
    }
    text += "\n  ],\n  \"unlisted\": [";
    next = "\n    ";
    for (const UnlistedPair& pair : result.unlisted) {
        text += std::string(next) + json_pair(pair, model) + ", \"seen\": " + truth(pair.is_seen) +
                ", \"depth_at_most\": " + json_figure(pair.depth_at_most) + "}";
        next = ",\n    ";
    }
    text += "\n  ],\n  \"unbounded\": [";
    next = "";
    for (const std::uint32_t region : result.unbounded) {
        text += next + json_text(model.regions()[region].path);
        next = ", ";
    }
    text += "],\n  \"unused\": [";
    next = "";
    for (const AllowedOverlap& row : result.unused) {
        text += std::string(next) + "[" + json_text(row.first) + ", " + json_text(row.second) + "]";
        next = ", ";
    }
    return text + "]\n}\n";
}

std::string to_junit(const CheckResult& result, const Model& model, const std::string& scene) {
    const std::string of = " classname=\"" + xml_text(scene) + "\" name=\"";
    std::string tests;
    std::size_t count = result.overlaps.size();
    for (const FoundOverlap& o : result.overlaps) {
        tests += "    <testcase" + of + xml_text(row_of(o, model)) + "\"";
        if (!o.is_new) {
            tests += "/>\n";
            continue;
        }
        tests += ">\n      <failure type=\"overlap\" message=\"" + format_number("%.5g", o.depth) +
                 " mm deep, at most " + format_number("%.5g", o.depth_at_most) + ", at " + point_of(o.place) +
                 "\">a ray that shows it, from " + shortest(o.t_in) + " to " + shortest(o.t_out) + ": " +
                 numbers_of(o.ray, " ") + "</failure>\n    </testcase>\n";
    }
    if (!result.is_complete) {
        ++count;
        tests += "    <testcase" + of +
                 "the check is complete\">\n      <error message=\"it was ended before\"/>\n"
                 "    </testcase>\n";
    } else if (result.overlaps.empty()) {
        ++count;
        tests += "    <testcase" + of + "no regions overlap\"/>\n";
    }
    const std::string head = " name=\"csgrt check\" tests=\"" + std::to_string(count) + "\" failures=\"" +
                             std::to_string(result.new_overlaps) + "\" errors=\"" + (result.is_complete ? "0" : "1") +
                             "\" time=\"" + format_number("%.3f", result.seconds) + "\"";
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + head + ">\n  <testsuite" + head + ">\n" + tests +
           "  </testsuite>\n</testsuites>\n";
}

std::string to_rays(const CheckResult& result, const Model& model) {
    std::string text;
    for (const FoundOverlap& o : result.overlaps)
        text += "# " + row_of(o, model) + " from " + shortest(o.t_in) + " to " + shortest(o.t_out) + "\n" +
                numbers_of(o.ray, " ") + "\n";
    return text;
}

std::string to_note(const CheckResult& so_far) {
    std::string text = counted(so_far.overlaps.size(), "overlap") + ", " + counted(so_far.rays, "ray");
    if (so_far.rays_to_come > 0)
        text += "; for --certain " + format_number("%.3g", static_cast<double>(so_far.rays_to_come)) +
                " rays to come, some " +
                format_number("%.2g", so_far.seconds / static_cast<double>(so_far.rays) *
                                          static_cast<double>(so_far.rays_to_come)) +
                " s";
    return text;
}

}  // namespace csgrt::cli
