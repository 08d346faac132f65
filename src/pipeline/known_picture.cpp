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

std::vector<KnownPicture::Entry>::const_iterator KnownPicture::find(const Device& device) const {
    return std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.context == device.context(); });
}

std::size_t KnownPicture::planes_known_to(const Device& device) const {
    const auto found = find(device);
    return found == entries_.end() ? 0 : found->planes.size();
}

void KnownPicture::drop(const Device& device) {
    entries_[static_cast<std::size_t>(find(device) - entries_.begin())].planes.pop_back();
}

}  // namespace csgrt
