#include "pipeline/block_list.hpp"

#include <utility>

namespace csgrt {

static_assert(COST_CLASSES <= work_group);  // an item a class

void BlockList::build() {
    program_.emplace(device_, assemble_program({"tile_list.cl"}));
    count_.emplace(program_->kernel("count_blocks"));
    put_background_.emplace(program_->kernel("put_background"));
    list_.emplace(program_->kernel("list_blocks"));
}

std::array<Event, 2> BlockList::list(const Tile& tile, TileBuffers& buffers, std::uint32_t most_in_parts) {
    const cl_uint blocks = tile.blocks();
    buffers.rays.reserve(blocks * sizeof(cl_uint));
    Event counted = count_->launch(blocks, work_group, buffers.costs, blocks, buffers.tally);
    return {std::move(counted),
            list_->launch(blocks, work_group, buffers.costs, cl_uint{tile.first_block()}, blocks, cl_uint{most_in_parts}, buffers.tally,
                          buffers.rays)};
}

Event BlockList::put_background(const kernel::Frame& frame, const Tile& tile, const Buffer& costs,
                                const kernel::PlaneValues& background, std::uint32_t planes, const Buffer& picture) {
    if (planes == 0) return {};
    return put_background_->launch(tile.rays, block_rays, costs, frame.window, cl_uint{tile.first},
                                   cl_uint{frame.lines}, cl_uint{planes}, background, picture);
}

}  // namespace csgrt
