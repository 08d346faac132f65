#include "pipeline/tile_list.hpp"

#include <utility>

namespace csgrt {

static_assert(COST_CLASSES <= work_group);  // an item a class

void TileList::build() {
    program_.emplace(device_, assemble_program({"tile_list.cl"}));
    count_.emplace(program_->kernel("count_tiles"));
    put_background_.emplace(program_->kernel("put_background"));
    list_.emplace(program_->kernel("list_tiles"));
}

std::array<Event, 2> TileList::list(const RayBatch& batch, BatchBuffers& buffers, std::uint32_t most_in_parts) {
    const cl_uint tiles = batch.tiles();
    buffers.rays.reserve(tiles * sizeof(cl_uint));
    Event counted = count_->launch(tiles, work_group, buffers.costs, tiles, buffers.tally);
    return {std::move(counted),
            list_->launch(tiles, work_group, buffers.costs, cl_uint{batch.first_tile()}, tiles, cl_uint{most_in_parts}, buffers.tally,
                          buffers.rays)};
}

Event TileList::put_background(const kernel::Frame& frame, const RayBatch& batch, const Buffer& costs,
                                const kernel::ChannelValues& background, std::uint32_t planes, const Buffer& picture) {
    if (planes == 0) return {};
    return put_background_->launch(batch.rays, tile_rays, costs, frame.screen, cl_uint{batch.first},
                                   cl_uint{frame.lines}, cl_uint{planes}, background, picture);
}

}  // namespace csgrt
