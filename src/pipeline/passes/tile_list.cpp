#include "pipeline/passes/tile_list.hpp"

#include <utility>

#include "pipeline/passes/program_options.hpp"

namespace csgrt {

static_assert(COST_CLASSES <= work_group);  // one work-item a class

void TileListPass::build() {
    program_.emplace(device_, assemble_program({"tile_list.cl", "edges.cl"}));
    count_.emplace(program_->kernel("count_tiles"));
    write_background_.emplace(program_->kernel("write_background"));
    draw_edges_.emplace(program_->kernel("draw_edges"));
    list_.emplace(program_->kernel("list_tiles"));
}

std::array<Event, 2> TileListPass::list(const RayBatch& batch, BatchBuffers& buffers, std::uint32_t most_in_parts) {
    const cl_uint tiles = batch.tiles();
    buffers.tiles.reserve(tiles * sizeof(cl_uint));
    Event counted = count_->launch(tiles, work_group, buffers.costs, tiles, buffers.report);
    return {std::move(counted), list_->launch(tiles, work_group, buffers.costs, cl_uint{batch.first_tile()}, tiles,
                                              cl_uint{most_in_parts}, buffers.report, buffers.tiles)};
}

Event TileListPass::write_background(const kernel::Frame& frame, const RayBatch& batch, const Buffer& costs,
                                     const kernel::ChannelValues& background, std::uint32_t channels,
                                     const Buffer& picture) {
    if (channels == 0) return {};
    return write_background_->launch(batch.rays, tile_rays, costs, frame.screen, cl_uint{batch.first},
                                     cl_uint{frame.rows}, cl_uint{channels}, background, picture);
}

Event TileListPass::draw_edges(const RayBatch& batch, const BatchBuffers& buffers, const Buffer& picture) {
    return draw_edges_->launch(batch.rays, tile_rays, buffers.frame, buffers.report, picture);
}

}  // namespace csgrt
