#include "measurement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "figures.hpp"
#include "form/measure.hpp"
#include "statistics.hpp"
#include "tables.hpp"

namespace csgrt::cli {

namespace {

constexpr std::size_t most_listed = 10;  ///< regions in a list of remarks
constexpr const char* axes[] = {"x", "y", "z"};
constexpr const char* moments[] = {"xx", "yy", "zz", "xy", "yz", "zx"};

/// "7.0971e+08 +- 1.2e+05": the value down to the second digit of its error.
std::string figure(const Estimate& e) {
    if (!std::isfinite(e.value)) return "-";
    const double size = std::max(std::abs(e.value), e.half_width);
    const double ratio = e.half_width > 0 ? size / e.half_width : 1e9;
    const int digits = std::clamp(static_cast<int>(std::ceil(std::log10(ratio))) + 2, 3, 12);
    return format_number(("%." + std::to_string(digits) + "g").c_str(), e.value) + " +- " +
           format_number("%.2g", e.half_width);
}

std::string figure_line(const std::string& name, const std::string& value) { return padded(name, 20) + value + "\n"; }

std::string counted_regions(std::uint64_t count) {
    return std::to_string(count) + (count == 1 ? " region" : " regions");
}

/// The columns of one estimate: the value and its error in percent.
std::string cells(const Estimate& e) {
    return right(e.value > 0 ? format_number("%.6g", e.value) : "0", 13) + right(relative(e), 10);
}

/// "0.1", "7.8~" if it is tapered, "-" if there is none.
std::string wall_of(const Wall& wall) {
    return wall.thickness > 0 ? format_number("%.6g", wall.thickness) + (wall.is_tapered ? "~" : "") : "-";
}

/// A list of regions, each with a remark; `all`: how many there are.
template <class Is, class Say>
std::string listed(const Measurement& result, const std::string& head, const Is& is, const Say& say) {
    std::string text;
    std::size_t count = 0;
    for (const Measured& m : result.parts) {
        if (m.kind != MeasuredKind::region || !is(m)) continue;
        if (++count <= most_listed) text += "  " + m.name + say(m) + "\n";
    }
    if (count == 0) return {};
    if (count > most_listed) text += "  and " + std::to_string(count - most_listed) + " more, which --json lists\n";
    return "\n" + head + ":\n" + text;
}

}  // namespace

std::string to_text(const Measurement& result, const MeasureRequest& request, int depth, std::size_t width) {
    const Measured& all = result.parts.front();
    std::string text = figure_line("volume", figure(all.volume) + " mm^3  (" + relative(all.volume) + ")");
    if (all.claimed.value > all.volume.value)
        text += figure_line("  claimed", figure(all.claimed) + " mm^3, with overlaps counted for each claimant");
    if (result.has_densities) text += figure_line("mass", figure(all.mass) + " kg  (" + relative(all.mass) + ")");
    text += figure_line("area", figure(all.area) + " mm^2  (" + relative(all.area) + ")");
    for (std::size_t i = 0; i < 3; ++i)
        text += figure_line(i == 0 ? "centroid" : "", std::string(axes[i]) + "  " + figure(all.centroid[i]) + " mm");
    for (std::size_t i = 0; i < 6; ++i)
        text += figure_line(i == 0 ? "  moments about it" : "", std::string(moments[i]) + " " + figure(all.central[i]) +
                                                                    (result.has_densities ? " kg mm^2" : " mm^5"));
    if (all.box.low.x <= all.box.high.x)
        text += figure_line("box", format_number("%g", all.box.low.x) + " " + format_number("%g", all.box.low.y) + " " +
                                       format_number("%g", all.box.low.z) + " to " +
                                       format_number("%g", all.box.high.x) + " " + format_number("%g", all.box.high.y) +
                                       " " + format_number("%g", all.box.high.z) + " mm");

    // Columns: the name, and three estimates; the mass is left out if there is none.
    const bool has_walls = request.walls || request.wall_limit > 0;
    const std::size_t columns = (result.has_densities ? 69 : 46) + (has_walls ? 14 : 0);
    const std::size_t names = std::max<std::size_t>(width > columns ? width - columns : 0, 20);
    const auto head = [](const char* what) { return right(what, 13) + right("+-", 10); };
    text += "\n" + padded("", names) + head("volume mm^3") + (result.has_densities ? head("mass kg") : "") +
            head("area mm^2") + (has_walls ? right("wall mm", 14) : "") + "\n";
    const auto add = [&](std::string name, const Measured& m) {
        if (name.size() > names) name = name.substr(0, names - 3) + "...";
        text += padded(std::move(name), names) + cells(m.volume) + (result.has_densities ? cells(m.mass) : "") +
                cells(m.area) + (has_walls ? right(wall_of(m.wall), 14) : "") + "\n";
    };
    std::vector<const Measured*> tree, materials;
    for (const Measured& m : result.parts) {
        const auto level = std::count(m.name.begin(), m.name.end(), '/');
        if (m.kind == MeasuredKind::material) materials.push_back(&m);
        if ((m.kind == MeasuredKind::assembly || m.kind == MeasuredKind::region) && level <= depth) tree.push_back(&m);
    }
    std::stable_sort(tree.begin(), tree.end(), [](const Measured* a, const Measured* b) {
        return std::lexicographical_compare(  // '/' before all letters, so that parts follow their assembly
            a->name.begin(), a->name.end(), b->name.begin(), b->name.end(),
            [](char x, char y) { return (x == '/' ? 0 : x + 1) < (y == '/' ? 0 : y + 1); });
    });
    for (const Measured* m : tree) {
        const std::size_t level = static_cast<std::size_t>(std::count(m->name.begin(), m->name.end(), '/'));
        add(std::string(2 * (level - 1), ' ') + m->name.substr(m->name.rfind('/') + 1), *m);
    }
    if (materials.size() > 1 || result.has_densities)
        for (const Measured* m : materials) add(m->name, *m);

    text += listed(
        result, "No ray has met these regions; their volume is at most", [](const Measured& m) { return m.unmet > 0; },
        [](const Measured& m) {
            return "  " + format_number("%.2g", m.unmet_bound) + " mm^3" +
                   (m.claimed.value > 0 ? ", since others own what it claims" : "");
        });
    text += listed(
        result, "No density is known of these regions, which count as weightless",
        [](const Measured& m) { return m.weightless > 0; },
        [](const Measured& m) { return "  " + format_number("%.6g", m.volume.value) + " mm^3"; });
    text += listed(
        result, "Walls thinner than " + format_number("%g", request.wall_limit) + " mm",
        [](const Measured& m) { return m.thin > 0; },
        [](const Measured& m) {
            return "  " + wall_of(m.wall) + " mm, from " + point_of(m.wall.from) + " to " + point_of(m.wall.to);
        });
    text += "\n+- is half of the interval that holds the true figure in 95 of 100 measures.\n";
    if (has_walls) text += "A wall with ~ is tapered: its faces are not parallel.\n";
    text += format_number("%.0f", static_cast<double>(result.rays)) + " rays, " +
            format_number("%.1f", result.seconds) + " s";
    if (request.rays == 0)
        text += "; " + std::to_string(all.reached) + " of " + counted_regions(all.regions) + " within " +
                percent(request.rel_error);
    return text + "\n";
}

std::string to_note(const Measurement& so_far, const MeasureRequest& request) {
    const Measured& all = so_far.parts.front();
    return "whole +- " + relative(all.volume) + ", " + std::to_string(all.reached) + " of " +
           counted_regions(all.regions) + " within " + percent(request.rel_error);
}

namespace {

/// Calls each(name, estimate) for all estimates of a part.
template <class Each>
void for_estimates(const Measured& m, bool has_densities, const Each& each) {
    each("volume", m.volume);
    each("claimed", m.claimed);
    each("area", m.area);
    if (has_densities) each("mass", m.mass);
    for (std::size_t i = 0; i < 3; ++i) each(std::string("centroid_") + axes[i], m.centroid[i]);
    for (std::size_t i = 0; i < 6; ++i) each(std::string("origin_") + moments[i], m.origin[i]);
    for (std::size_t i = 0; i < 6; ++i) each(std::string("central_") + moments[i], m.central[i]);
}

std::string json_wall(const Wall& wall) {
    if (wall.thickness == 0) return ", \"wall\": null";
    std::string shares;
    for (std::size_t i = 0; i < wall.shares.size(); ++i) {
        if (wall.shares[i] > 0)
            shares += (shares.empty() ? "[" : ", [") +
                      json_figure(std::ldexp(1.0, static_cast<int>(i) + Wall::first_exponent)) + ", " +
                      json_figure(wall.shares[i]) + "]";
    }
    return ", \"wall\": {\"thickness\": " + json_figure(wall.thickness) + ", \"from\": " + json_point(wall.from) +
           ", \"to\": " + json_point(wall.to) + ", \"tapered\": " + (wall.is_tapered ? "true" : "false") +
           ", \"shares\": [" + shares + "]}";
}

}  // namespace

std::string to_json(const Measurement& result, const MeasureRequest& request) {
    const char* const moment = result.has_densities ? "kg mm^2" : "mm^5";
    std::string text =
        "{\n  \"seed\": " + std::to_string(request.seed) + ",\n  \"rel_error\": " + json_figure(request.rel_error) +
        ",\n  \"rays\": " + std::to_string(result.rays) + ",\n  \"reached\": " + (result.reached ? "true" : "false") +
        ",\n  \"units\": {\"volume\": \"mm^3\", \"claimed\": \"mm^3\", \"area\": \"mm^2\", \"mass\": "
        "\"kg\", \"centroid\": \"mm\", \"origin\": \"" +
        moment + "\", \"central\": \"" + moment + "\", \"box\": \"mm\"},\n  \"parts\": [";
    bool is_first = true;
    for (const Measured& m : result.parts) {
        text += std::string(is_first ? "" : ",") + "\n    {\"kind\": \"" +
                std::string(name_of(measured_kind_names, m.kind)) + "\", \"name\": " + json_text(m.name) +
                ", \"id\": " + std::to_string(m.id);
        is_first = false;
        for_estimates(m, result.has_densities, [&text](const std::string& name, const Estimate& e) {
            text += ", \"" + name + "\": " + json_estimate(e);
        });
        const bool is_bounded = m.box.low.x <= m.box.high.x;
        text += ", \"box\": " + (is_bounded ? json_corners(m.box) : "null") +
                ", \"regions\": " + std::to_string(m.regions) + ", \"reached\": " + std::to_string(m.reached) +
                ", \"unmet\": " + std::to_string(m.unmet) + ", \"weightless\": " + std::to_string(m.weightless) +
                ", \"thin\": " + std::to_string(m.thin) + ", \"unmet_bound\": " + json_figure(m.unmet_bound) +
                json_wall(m.wall) + "}";
    }
    return text + "\n  ]\n}\n";
}

std::string to_csv(const Measurement& result) {
    std::string text = "kind,name,id,regions,reached,unmet,weightless,unmet_bound,thin,wall";
    for_estimates(result.parts.front(), result.has_densities, [&text](const std::string& name, const Estimate&) {
        text += "," + name + "," + name + "_half_width";
    });
    text += "\n";
    for (const Measured& m : result.parts) {
        append_field(text += std::string(name_of(measured_kind_names, m.kind)) + ",", m.name);
        text += "," + std::to_string(m.id) + "," + std::to_string(m.regions) + "," + std::to_string(m.reached) + "," +
                std::to_string(m.unmet) + "," + std::to_string(m.weightless) + "," + shortest(m.unmet_bound) + "," +
                std::to_string(m.thin) + "," + (m.wall.thickness > 0 ? shortest(m.wall.thickness) : std::string());
        for_estimates(m, result.has_densities, [&text](const std::string&, const Estimate& e) {
            for (const double value : {e.value, e.half_width})
                text += "," + (std::isfinite(value) ? shortest(value) : std::string());
        });
        text += "\n";
    }
    return text;
}

}  // namespace csgrt::cli
