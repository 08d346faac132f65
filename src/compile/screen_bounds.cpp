#include "compile/screen_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "compile/linear.hpp"
#include "scene/vector.hpp"

namespace csgrt {
namespace {

// The number of boxes to project: more boxes would fit closer, but would take longer than the rays that they save.
constexpr std::size_t most_boxes = 64;

std::vector<kernel::BvhNode> upper_boxes(const std::vector<kernel::BvhNode>& nodes) {
    std::vector<std::uint32_t> numbers{0};
    for (bool split = true; split;) {
        split = false;
        for (std::size_t i = 0, count = numbers.size(); i < count && numbers.size() < most_boxes; ++i) {
            if (nodes[numbers[i]].leaf) continue;
            ++numbers[i];  // the first child, which comes before the second
            numbers.push_back(nodes[numbers[i]].skip);
            split = true;
        }
    }
    std::vector<kernel::BvhNode> boxes;
    for (const std::uint32_t number : numbers) boxes.push_back(nodes[number]);
    return boxes;
}

double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A range of columns and lines, as view_ray() counts them: 0 is the middle of the first pixel.
struct Extent {
    double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
};

// Extends the range by the projection of the box, which is relative to the center and grown by `more` all around.
// Returns false if a part of the box is not before the eye.
bool take_in(const kernel::Frame& f, const Box& box, double more, Extent& extent) {
    const double low[] = {box.low.x, box.low.y, box.low.z}, high[] = {box.high.x, box.high.y, box.high.z};
    for (unsigned corner = 0; corner < 8; ++corner) {
        double p[3];
        for (unsigned k = 0; k < 3; ++k)
            p[k] = f.center[k] - f.eye[k] + (corner >> k & 1 ? high[k] + more : low[k] - more);
        double scale = 1;
        if (f.perspective) {
            scale = dot(p, f.w) / dot(f.w, f.w);
            if (!(scale > 1e-6)) return false;
        }
        const double x = dot(p, f.u) / (scale * dot(f.u, f.u)), y = dot(p, f.v) / (scale * dot(f.v, f.v));
        const double column = x - f.first_x, line = f.first_y - y;
        if (!std::isfinite(column) || !std::isfinite(line)) return false;
        extent.left = std::min(extent.left, column);
        extent.right = std::max(extent.right, column);
        extent.top = std::min(extent.top, line);
        extent.bottom = std::max(extent.bottom, line);
    }
    return true;
}

/// The pixels around an extent, in whole tiles; empty if there are none.
kernel::ScreenBounds pixels_of(const Extent& extent, const kernel::Frame& f) {
    constexpr double margin = 2;  // pixels
    const auto within = [](double at, std::uint32_t size) {
        return static_cast<std::uint32_t>(std::clamp(at, 0.0, 1.0 * size));
    };
    kernel::ScreenBounds screen;
    screen.left = within(std::floor(extent.left - margin), f.width) / TILE * TILE;
    screen.top = within(std::floor(extent.top - margin), f.height) / TILE * TILE;
    screen.right = within(std::ceil(extent.right + margin + 1), f.width);
    screen.bottom = within(std::ceil(extent.bottom + margin + 1), f.height);
    screen.right = std::min(f.width, (screen.right + TILE - 1) / TILE * TILE);
    screen.bottom = std::min(f.height, (screen.bottom + TILE - 1) / TILE * TILE);
    if (screen.left >= screen.right || screen.top >= screen.bottom) return {};
    return screen;
}

/// The pixels in which the hierarchy's upper boxes are seen. `more`: how much boxes grow.
kernel::ScreenBounds bounds_of_solids(const CompiledScene& scene, const kernel::Frame& f, double more) {
    const kernel::ScreenBounds all{0, 0, f.width, f.height};
    if (scene.unbounded_count > 0) return all;
    if (scene.nodes.empty()) return {};
    Extent extent;
    for (const kernel::BvhNode& box : upper_boxes(scene.nodes))
        if (!take_in(f, {{box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}}, more, extent))
            return all;
    return pixels_of(extent, f);
}

}  // namespace

kernel::ScreenBounds screen_bounds(const CompiledScene& scene, const kernel::Frame& f) {
    // The margin covers the growth of boxes in single precision (kernels/shared/slab.h) and the rounding of
    // coordinates. It is the same for every precision.
    double to_center = 0, center = 0;
    for (int k = 0; k < 3; ++k) {
        to_center = std::hypot(to_center, f.eye[k] - f.center[k]);
        center = std::hypot(center, f.center[k]);
    }
    const double more = (f.radius + to_center + center) * 0x1p-16;
    kernel::ScreenBounds screen = bounds_of_solids(scene, f, more);
    if (f.every_partition || !scene.claim_box || !is_finite(*scene.claim_box))
        return screen;  // every partition counts all solids
    const Box& box = *scene.claim_box;
    if (is_empty(box)) return {};
    Extent extent;
    if (!take_in(f, {box.low - scene.center, box.high - scene.center}, more, extent)) return screen;
    const kernel::ScreenBounds claimed = pixels_of(extent, f);
    screen = {std::max(screen.left, claimed.left), std::max(screen.top, claimed.top),
              std::min(screen.right, claimed.right), std::min(screen.bottom, claimed.bottom)};
    if (screen.left >= screen.right || screen.top >= screen.bottom) return {};
    return screen;
}

}  // namespace csgrt
