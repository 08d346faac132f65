// Picture names: the names of a picture's regions and solids, and the regions that overlap in it, for its header.
#include <csgrt/renderer.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/floating_point.hpp"
#include "formats/json/text.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

/// Adds an attribute such as {"17": "/all.g/x.r"} with the ids that occur, if the picture has the channel.
template <class Infos, class Name>
void describe(Image& image, const char* channel, const char* attribute, const Infos& infos, Name name) {
    if (!image.has_channel(channel)) return;
    std::vector<bool> occurs(infos.size() + 1);
    std::uint32_t last = 0;
    for (const std::uint32_t number : image.ids(channel)) {
        if (number == last) continue;  // most pixels have the id of the pixel before
        last = number;
        if (number < occurs.size()) occurs[number] = true;
    }
    std::string text;
    for (std::size_t i = 1; i < occurs.size(); ++i) {
        if (!occurs[i]) continue;
        text += (text.empty() ? "{\"" : ", \"") + std::to_string(i) + "\": " + readable_json_string(name(infos[i - 1]));
    }
    image.attributes[attribute] = text.empty() ? "{}" : text + "}";
}

}  // namespace

void Renderer::name_pixels(Image& image) const {
    const FloatingPoint own;
    const Model model = this->model();
    describe(image, "region", "csgrt:regions", model.regions(), [](const RegionInfo& region) { return region.path; });
    describe(image, "solid", "csgrt:solids", model.solids(), [](const SolidInfo& solid) { return solid.name; });
}

void Renderer::name_overlaps(const View& view, Image& image) {
    const FloatingPoint own;
    constexpr std::size_t rays_at_once = 1u << 18, most_pairs = 256;
    const Model model = this->model();
    if (!image.has_channel("overlap")) return;
    const RayGrid grid = model.grid_of(view);
    const PixelRectangle part = view.part.value_or(PixelRectangle{0, 0, view.width, view.height});
    std::set<std::pair<std::int32_t, std::int32_t>> pairs;
    std::vector<Ray> rays;
    std::vector<RayRange> ranges;
    Partitions rows;
    const auto trace = [&] {
        partitions(rays, rows, {.overlaps = true, .hidden = false}, {.each = ranges});
        for (std::size_t k = 0; k + 1 < rows.overlap_region_splits.size(); ++k)
            for (auto a = rows.overlap_region_splits[k]; a < rows.overlap_region_splits[k + 1]; ++a)
                for (auto b = a + 1; b < rows.overlap_region_splits[k + 1]; ++b)
                    pairs.emplace(rows.overlap_region_ids[static_cast<std::size_t>(a)],
                                  rows.overlap_region_ids[static_cast<std::size_t>(b)]);
        rays.clear();
        ranges.clear();
    };
    int pixel = 0;
    for (const float overlaps : image.channel("overlap")) {
        const int column = part.left + pixel % part.width, row = part.top + pixel / part.width;
        ++pixel;
        if (!(overlaps > 0)) continue;
        const auto& [origin, direction] = rays.emplace_back(grid.ray(column, row));
        RayRange& range = ranges.emplace_back();
        if (!grid.is_pinhole) range.t_near = -range.t_far;
        for (const auto& [normal, distance] : view.clip)  // the channel counts what is behind other planes
            if (const double speed = dot(normal, direction); speed < 0)
                range.t_near = std::max(range.t_near, (distance - dot(normal, origin)) / speed);
        if (rays.size() == rays_at_once) trace();
    }
    if (!rays.empty()) trace();
    const auto path = [&](std::int32_t region) {
        return readable_json_string(model.regions()[static_cast<std::size_t>(region)].path);
    };
    std::string text;
    std::size_t told = 0;
    for (const auto& [first, second] : pairs)
        if (told++ < most_pairs) text += (text.empty() ? "[" : ", [") + path(first) + ", " + path(second) + "]";
    image.attributes["csgrt:overlaps"] = "{\"count\": " + std::to_string(pairs.size()) + ", \"pairs\": [" + text + "]}";
}

}  // namespace csgrt
