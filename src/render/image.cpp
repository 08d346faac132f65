#include <csgrt/image.hpp>

#include <algorithm>

namespace csgrt {

bool Image::has_channel(std::string_view name) const noexcept { return std::ranges::find(names, name) != names.end(); }

std::span<const float> Image::channel(std::string_view name) const& {
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return channels[static_cast<std::size_t>(found - names.begin())];
    std::string known;
    for (const std::string& other : names) known += (known.empty() ? "" : " ") + other;
    throw Error(Status::usage,
                "the picture has no channel '" + std::string(name) + "'; it has " + (known.empty() ? "none" : known));
}

}  // namespace csgrt
