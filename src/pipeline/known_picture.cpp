#include "pipeline/known_picture.hpp"

#include <csgrt/error.hpp>

#include <set>

namespace csgrt {

// NVIDIA's driver refuses a copy that crosses the end of what one of its devices was told of, and if it is another's.
void KnownPicture::make_known(std::span<const Wanted> wanted) {
    known_.clear();
    std::set<std::size_t> ends;
    for (const Wanted& one : wanted)
        if (one.planes > 0) ends.insert(one.planes);
    piece_ends_.assign(ends.begin(), ends.end());
    for (const Wanted& one : wanted) {  // in turn: drivers may touch what they are told of
        Known& known = known_[one.device->context()];
        try {
            for (const std::size_t end : piece_ends_) {
                if (end > one.planes) break;
                known.pieces.emplace_back(*one.device, first_plane_ + known.planes * pixels_, (end - known.planes) * pixels_ * sizeof(float));
                known.planes = end;
            }
        } catch (const Error&) {  // the others' pixels come by other memory
        }
    }
}

std::size_t KnownPicture::planes_known_to(const Device& device) const {
    const auto found = known_.find(device.context());
    return found == known_.end() ? 0 : found->second.planes;
}

}  // namespace csgrt
