#include "pipeline/picture_reader.hpp"

#include <system_error>
#include <utility>

namespace csgrt {

void PictureReader::read(const Buffer& picture, std::size_t bytes, bool beside, Put put) {
    if (device_.info().type == "cpu") {  // in place; and its processors have no time beside the kernels
        put(static_cast<const float*>(picture.map(bytes).data()));
        return;
    }
    Slot& slot = slots_[next_];
    next_ = (next_ + 1) % slots_.size();
    if (slot.ended.valid()) slot.ended.get();
    if (!slot.memory || slot.memory->size() < bytes) {
        slot.memory.reset();
        slot.memory.emplace(device_, "picture", bytes);
    }
    picture.read(slot.memory->data(), bytes);
    slot.put = std::move(put);
    const auto* values = static_cast<const float*>(slot.memory->data());
    if (beside) {
        try {
            slot.ended = std::async(std::launch::async, [&slot, values] { slot.put(values); });
            return;
        } catch (const std::system_error&) {
            // no more threads
        }
    }
    slot.put(values);
}

void PictureReader::finish() {
    for (Slot& slot : slots_)
        if (slot.ended.valid()) slot.ended.get();
}

void PictureReader::abandon() {
    for (Slot& slot : slots_) slot.ended = {};
}

}  // namespace csgrt
