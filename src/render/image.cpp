#include <csgrt/image.hpp>

#include <algorithm>

namespace csgrt {

bool Image::has_channel(std::string_view name) const noexcept { return std::ranges::find(names, name) != names.end(); }

namespace {

/// The index of a channel by its name. Throws Error (usage) if the channel does not exist, or is of the other kind (ids
/// or floats).
std::size_t find_channel(const Image& image, std::string_view name, bool ids) {
    const auto found = std::ranges::find(image.names, name);
    const auto number = static_cast<std::size_t>(found - image.names.begin());
    if (found != image.names.end() && image.holds_ids(number) == ids) return number;
    if (found != image.names.end())
        throw Error(Status::usage, "the channel '" + std::string(name) + "' holds " +
                                       (ids ? "floats: see Image::channel()" : "ids: see Image::ids()"));
    std::string known;
    for (const std::string& other : image.names) known += (known.empty() ? "" : " ") + other;
    throw Error(Status::usage,
                "the picture has no channel '" + std::string(name) + "'; it has " + (known.empty() ? "none" : known));
}

}  // namespace

std::span<const float> Image::channel(std::string_view name) const& {
    return channels[find_channel(*this, name, false)];
}

std::span<const std::uint32_t> Image::ids(std::string_view name) const& {
    return channels.ids(find_channel(*this, name, true));
}

}  // namespace csgrt
