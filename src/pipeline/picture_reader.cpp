#include "pipeline/picture_reader.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

namespace csgrt {

// The host's own processors need no copy, and have no time beside the kernels.
bool PictureReader::in_place() const { return device_.info().type == "cpu"; }

/// To the next slot's memory. Memory that a GPU copies to at full speed takes half a millisecond a megabyte to get.
void PictureReader::copy(const Buffer& picture, std::size_t bytes, std::size_t most, Put put) {
    Slot& slot = slots_[next_];
    if (slot.ended.valid()) slot.ended.get();
    if (!slot.memory || slot.memory->size() < bytes) {
        slot.memory.reset();
        slot.memory.emplace(device_, "picture", std::max(bytes, most));
    }
    picture.read(slot.memory->data(), bytes);
    slot.put = std::move(put);
}

void PictureReader::read(const Buffer& picture, std::size_t bytes, Put put) {
    if (in_place()) return put(static_cast<const float*>(picture.map(bytes).data()));
    copy(picture, bytes, bytes, std::move(put));
    slots_[next_].put(slots_[next_].values());
}

void PictureReader::read_beside(const Buffer& picture, std::size_t bytes, std::size_t most, Put put) {
    if (in_place()) return read(picture, bytes, std::move(put));
    copy(picture, bytes, most, std::move(put));
    Slot& slot = slots_[next_];
    try {
        slot.ended = std::async(std::launch::async, [&slot] { slot.put(slot.values()); });
        next_ = (next_ + 1) % slots_.size();
    } catch (const std::system_error&) {  // no more threads
        slot.put(slot.values());
    }
}

void PictureReader::finish() {
    for (Slot& slot : slots_)
        if (slot.ended.valid()) slot.ended.get();
}

void PictureReader::abandon() {
    for (Slot& slot : slots_) slot.ended = {};
}

}  // namespace csgrt
