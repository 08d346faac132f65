// Pixels of a tile from the device's memory into the picture: a processor's in place, a GPU's while it is at the next tile.
#pragma once

#include <vector>

#include "pipeline/picture_lines.hpp"

namespace csgrt {

/// How they come: by lines, as from a GPU, also from another device?
enum class Readback { by_device, lines };

class PictureReader {
public:
    explicit PictureReader(Device& device, Readback readback);

    /// Compiles the kernels that it needs.
    void prepare() { lines_.build(); }
    bool is_prepared() const { return in_place() || lines_.is_built(); }

    /// Asks which of a tile's blocks, put next, show something; does not wait. See put_blocks().
    void look(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end, std::size_t drawn, const TileBuffers& tile,
              const RenderTarget& target) {
        if (by_lines_) lines_.look(frame, first, end, static_cast<std::uint32_t>(drawn), tile, target);
    }
    /// Has the answer copied; see QueuedRead.
    void fetch() { lines_.fetch(); }
    /// Puts the blocks from number `first` to `end` into the target. `drawn`: the numbers of those that were drawn, which
    /// tile.rays has, too; tile.picture: their pixels, as put_blocks() of picture.hpp has them. Unless this is the last of the
    /// device's in a frame, and the picture's memory not known to it, it may return before it is done: until then the target must
    /// last, the tile need not.
    void put_blocks(const kernel::Frame& frame, std::uint32_t first, std::uint32_t end,
                    const std::vector<std::uint32_t>& drawn, const TileBuffers& tile, bool is_last, const RenderTarget& target);
    /// The same for single rays. It is done when this returns, as is all that came before.
    void put_rays(const kernel::Frame& frame, const std::vector<std::uint32_t>& numbers, const TileBuffers& tile,
                  const RenderTarget& target);
    /// Returns when all is done. Throws what kept it from being done.
    void finish() { lines_.finish(); }
    /// The same, but what was thrown is not told.
    void abandon() noexcept { lines_.abandon(); }

    bool in_place() const { return !by_lines_; }
    std::uint64_t held() const { return lines_.held(); }  ///< bytes on the device
    void release() { lines_.release(); }                  ///< gives them back

private:
    bool by_lines_;
    PictureLines lines_;
};

}  // namespace csgrt
