#include "render/image_header.hpp"

namespace csgrt {

// World to camera: x right, y up, z to the viewer, the eye at the origin. Camera to screen: -1 to 1 across the height.
void describe_camera(const PreparedFrame& prepared, Image& image) {
    const auto dot = [](Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const Vec3 axes[3] = {prepared.right, prepared.up, prepared.back};
    std::vector<float> world_to_camera(16, 0.0f), camera_to_screen(16, 0.0f);
    for (std::size_t row = 0; row < 3; ++row) {
        world_to_camera[4 * row + 0] = static_cast<float>(axes[row].x);
        world_to_camera[4 * row + 1] = static_cast<float>(axes[row].y);
        world_to_camera[4 * row + 2] = static_cast<float>(axes[row].z);
        world_to_camera[4 * row + 3] =
            static_cast<float>(-dot(axes[row], prepared.center) - (row == 2 ? prepared.eye_to_center : 0));
    }
    world_to_camera[15] = 1;
    const double aspect = prepared.aspect;
    const double zoom = 2 / prepared.view_size;
    if (prepared.frame.perspective) {
        camera_to_screen[0] = static_cast<float>(prepared.eye_to_center * zoom / aspect);
        camera_to_screen[5] = static_cast<float>(prepared.eye_to_center * zoom);
        camera_to_screen[10] = -1;
        camera_to_screen[14] = -1;
    } else {
        camera_to_screen[0] = static_cast<float>(zoom / aspect);
        camera_to_screen[5] = static_cast<float>(zoom);
        camera_to_screen[10] = static_cast<float>(-zoom);
        camera_to_screen[15] = 1;
    }
    image.matrices["worldToCamera"] = std::move(world_to_camera);
    image.matrices["cameraToScreen"] = std::move(camera_to_screen);
}

// A header cannot have thousands of lines.
std::string warnings_attribute(const std::vector<Warning>& warnings) {
    constexpr std::size_t most_bytes = 4096;
    std::string text;
    for (std::size_t i = 0; i < warnings.size(); ++i) {
        const std::string line = format(warnings[i]);
        if (text.size() + line.size() > most_bytes)
            return text + (i > 0 ? "and " : "") + std::to_string(warnings.size() - i) + (i > 0 ? " more" : " warnings");
        text += line + (i + 1 < warnings.size() ? "\n" : "");
    }
    return text;
}

}  // namespace csgrt
