#include "pipeline/known_picture.hpp"

#include <algorithm>

namespace csgrt {

bool KnownPicture::add(const Device& device, std::span<const ChannelPlane> planes, std::size_t pixels) {
    std::vector<KnownMemory> known;
    try {
        for (const ChannelPlane& plane : planes) known.emplace_back(device, plane.pixels, pixels * sizeof(float));
    } catch (const Error&) {
        return false;
    }
    entries_.push_back({device.context(), std::move(known)});
    return true;
}

bool KnownPicture::is_known_to(const Device& device) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.context == device.context(); });
}

}  // namespace csgrt
