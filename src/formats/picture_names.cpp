// What the numbers in a picture mean, for its header.
#include <csgrt/renderer.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "base/floating_point.hpp"
#include "formats/json/text.hpp"

namespace csgrt {

namespace {

/// The greatest number up to which a float tells each from the next.
constexpr std::size_t most_told_apart = std::size_t{1} << 24;

/// {"17": "/all.g/x.r"} of the numbers that occur; no attribute where the picture has no such channel.
template <class Infos, class Name>
void describe(Image& image, const char* channel, const char* attribute, const Infos& infos, Name name) {
    if (!image.has_channel(channel)) return;
    std::vector<bool> occurs(std::min(infos.size(), most_told_apart) + 1);
    float last = 0;
    for (const float number : image.channel(channel)) {
        if (number == last) continue;  // as most are
        last = number;
        if (number >= 1 && number < static_cast<float>(occurs.size())) occurs[static_cast<std::size_t>(number)] = true;
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
    describe(image, "region", "csgrt:regions", regions(), [](const RegionInfo& region) { return region.path; });
    describe(image, "solid", "csgrt:solids", solids(), [](const SolidInfo& solid) { return solid.name; });
}

}  // namespace csgrt
