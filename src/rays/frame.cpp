#include "rays/frame.hpp"

#include <limits>

namespace csgrt {

PreparedFrame prepare_rays(const CompiledScene& scene, std::uint32_t count, double tolerance) {
    PreparedFrame result;
    put_scene(scene, tolerance, result.frame);
    result.frame.work = WORK_RAYS;
    result.frame.t_min = -std::numeric_limits<double>::infinity();
    result.frame.width = count;
    result.frame.height = 1;
    result.rays = count;
    return result;
}

kernel::Frame frame_of(const CompiledScene& scene, const RayList& list, const RowReceiver& receiver, double tolerance) {
    kernel::Frame frame = prepare_rays(scene, static_cast<std::uint32_t>(list.size()), tolerance).frame;
    frame.first_row = receiver.first_row();
    if (list.is_grid()) list.put_camera(frame);
    list.put_planes(frame);
    return frame;
}

}  // namespace csgrt
