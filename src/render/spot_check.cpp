#include "render/spot_check.hpp"

#include <bit>
#include <charconv>

#include "kernel_host/geometry.hpp"

namespace csgrt {
namespace {

[[noreturn]] void fail(const std::string& device, const std::string& what) {
    throw Error(Status::device_fault,
                {Diagnostic{.message = device + " computed wrongly: " + what + " (--check, Settings::check)",
                            .suggestion = "Use another device; 'csgrt verify' compares this one's answers with exact "
                                          "ones."}});
}

std::string text_of(float value) {
    char text[32];
    return {text, std::to_chars(text, std::end(text), value).ptr};
}

}  // namespace

const Reference& SpotCheck::reference(const CompiledScene& scene) {
    if (!reference_) {
        kernels_ = make_kernels_to_run(scene, settings_);
        reference_.emplace(scene, *kernels_);
    }
    return *reference_;
}

std::vector<std::uint32_t> SpotCheck::rays_of(const std::vector<RayBatch>& batches) {
    std::vector<std::uint32_t> rays;
    for (const RayBatch& batch : batches) {
        if (settings_.check == 0 || batches_++ % settings_.check != 0) continue;
        for (std::uint32_t i = 0; i < batch.rays; ++i) rays.push_back(batch.first + i);
    }
    return rays;
}

void SpotCheck::compare(const CompiledScene& scene, const PreparedFrame& frame, const FrameMemory& memory,
                        const std::vector<RayBatch>& batches, const std::string& device, Watch& watch) {
    std::vector<std::uint32_t> pixels;
    for (const std::uint32_t ray : rays_of(batches))
        if (const kernel::pixel_position at = kernel::pixel_of(ray, frame.frame.screen); at.inside)
            pixels.push_back(at.y * frame.frame.width + at.x);
    if (pixels.empty()) return;
    ReferenceCounts counts;
    const std::vector<kernel::Pixel> right = reference(scene).render(frame, &watch, counts, &pixels);
    const kernel::ScreenBounds& screen = frame.frame.screen;
    const auto is_wanted = [&](std::size_t pixel, float distance) {
        const std::size_t x = pixel % frame.frame.width - screen.left, y = pixel / frame.frame.width - screen.top;
        return frame.ends.empty() || distance < frame.ends[y / TILE * kernel::tiles_across(screen) + x / TILE];
    };
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (!is_wanted(pixels[i], right[i].z) && !is_wanted(pixels[i], memory.channels[0].pixels[pixels[i]])) continue;
        for (std::size_t c = 0; c < memory.channels.size(); ++c) {
            const float found = memory.channels[c].pixels[pixels[i]],
                        expected = memory.sources[c]->value(right[i], scene.display[0]);
            if (std::bit_cast<std::uint32_t>(found) == std::bit_cast<std::uint32_t>(expected)) continue;
            fail(device, "the pixel in column " + std::to_string(pixels[i] % frame.frame.width) + " of line " +
                             std::to_string(pixels[i] / frame.frame.width) + " has " + text_of(found) +
                             " in the channel " + memory.sources[c]->name + ", the reference " + text_of(expected));
        }
    }
}

void SpotCheck::compare(const CompiledScene& scene, const kernel::Frame& frame, const RayList& rays,
                        const RowReceiver& given, const std::vector<RayBatch>& batches, const std::string& device,
                        Watch& watch) {
    const std::vector<std::uint32_t> numbers = rays_of(batches);
    if (numbers.empty()) return;
    const RayList some = rays.some(numbers);
    ReferenceCounts counts;
    Partitions right;
    RowCollector expected(right, given.fields(), numbers.size());
    reference(scene).trace(frame, some, expected, &watch, counts);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (!given.has(numbers[i], right, i))
            fail(device, "the partitions of ray " + std::to_string(numbers[i]) + " are not the reference's");
}

}  // namespace csgrt
