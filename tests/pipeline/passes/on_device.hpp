// A scene on a device, for tests of passes: no image, no schedule.
#pragma once

#include "integration/same_answers.hpp"
#include "pipeline/passes/batch_buffers.hpp"
#include "pipeline/passes/scene_tables.hpp"
#include "reference/reference.hpp"
#include "stress/parts.hpp"

namespace csgrt::test {

struct OnDevice {
    explicit OnDevice(const Scene& scene, View view = {})
        : compiled(compile(scene, {})),
          records(make_converter(compiled, settings)),
          device(settings.device),
          tables(device, compiled, records->tables()),
          prepared(prepare_frame(compiled, view)),
          frame(prepared.frame),
          batch(device) {
        tables.set_lights(records->lights(prepared.lights));
    }

    /// Uploads the frame and a list: which rays the kernels are run for.
    void start(Work work, const std::vector<std::uint32_t>& numbers) {
        frame.work = static_cast<std::uint32_t>(work);
        frame.ray_count = static_cast<std::uint32_t>(numbers.size()) * (work == Work::tiles ? tile_rays : 1);
        (work == Work::tiles ? batch.tiles : batch.pixels) = Buffer(device, "list", numbers);
        batch.frame = Buffer(device, "frame", records->frame(frame));
    }
    /// What the reference sees through each pixel, row by row from the top left.
    std::vector<kernel::Pixel> expected() const {
        const auto to_run = make_kernels_to_run(compiled, settings);
        ReferenceCounts counts;
        return Reference(compiled, *to_run).render(prepared, nullptr, counts);
    }
    /// The place in that list of a picture's ray; none: it goes through no pixel.
    std::optional<std::size_t> pixel_of(std::uint32_t ray) const {
        const kernel::pixel_position at = kernel::pixel_of(ray, frame.screen);
        if (!at.inside) return {};
        return std::size_t{at.y} * frame.width + at.x;
    }

    Settings settings = on_compiling_device();
    CompiledScene compiled;
    std::unique_ptr<RecordConverter> records;
    Device device;
    SceneTables tables;
    PreparedFrame prepared;
    kernel::Frame frame;
    BatchBuffers batch;
};

/// A picture of 77 x 61 pixels, whose last tiles are cut off.
inline View small_view(bool every_partition) {
    View view;
    view.width = 77;
    view.height = 61;
    view.every_partition = every_partition;
    view.channels = channel::distance | channel::ids;
    return view;
}

}  // namespace csgrt::test
