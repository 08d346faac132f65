#include "pipeline/known_picture.hpp"

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

std::size_t KnownPicture::find(const Device& device) const {
    std::size_t i = 0;
    while (i < entries_.size() && entries_[i].context != device.context()) ++i;
    return i;
}

std::size_t KnownPicture::planes_known_to(const Device& device) const {
    const std::size_t i = find(device);
    return i < entries_.size() ? entries_[i].planes.size() : 0;
}

void KnownPicture::drop(const Device& device) { entries_[find(device)].planes.pop_back(); }

}  // namespace csgrt
