#include "pipeline/picture_reader.hpp"

namespace csgrt {

// The host's own processors need no copy, and have no time beside the kernels.
PictureReader::PictureReader(Device& device, Readback readback)
    : by_lines_(readback == Readback::lines || device.info().type != "cpu"), lines_(device) {}

void PictureReader::put_blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                               const std::vector<std::uint32_t>& drawn, const TileBuffers& tile, bool is_last,
                               const RenderTarget& target) {
    const auto count = static_cast<std::uint32_t>(drawn.size());
    if (by_lines_ && lines_.put_blocks(frame, first, end, count, tile, is_last, target)) return;
    const Buffer::Mapping picture = tile.picture.map(drawn.size() * block_rays * target.planes.size() * sizeof(float));
    csgrt::put_blocks(frame, first, end, drawn, static_cast<const float*>(picture.data()), target);
}

void PictureReader::put_rays(const kernel::Frame& frame, const std::vector<std::uint32_t>& numbers, const TileBuffers& tile,
                             const RenderTarget& target) {
    finish();
    const Buffer::Mapping picture = tile.picture.map(numbers.size() * target.planes.size() * sizeof(float));
    csgrt::put_rays(frame, numbers, static_cast<const float*>(picture.data()), target);
}

}  // namespace csgrt
