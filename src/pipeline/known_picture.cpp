#include "pipeline/known_picture.hpp"

#include <algorithm>

namespace csgrt {

void KnownPicture::add(std::size_t entry, const Device& device, std::span<const ChannelPlane> planes, std::size_t pixels) {
    std::vector<KnownMemory> known;
    try {
        for (const ChannelPlane& plane : planes) known.emplace_back(device, plane.pixels, pixels * sizeof(float));
    } catch (const Error&) {
        return;  // it comes by another way
    }
    entries_[entry] = {device.context(), std::move(known)};
}

bool KnownPicture::is_known_to(const Device& device) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.context == device.context(); });
}

}  // namespace csgrt
