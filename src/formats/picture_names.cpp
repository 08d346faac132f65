// Picture names: the names of a picture's regions and solids, for its header.
#include <csgrt/renderer.hpp>

#include <cstddef>
#include <string>
#include <vector>

#include "base/floating_point.hpp"
#include "formats/json/text.hpp"

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

}  // namespace csgrt
