// Small pictures of a stress scene: pixels that are neither what their neighbours are nor what the oracle says, and
// whether the trees in other words give the same picture.
#pragma once

#include <cstring>

#include "compile/compiled_scene.hpp"
#include "compile/frame.hpp"
#include "kernel_host/geometry.hpp"
#include "integration/stress/check.hpp"

namespace csgrt::test {

struct Speckles {
    std::size_t pictures = 0, pixels = 0;
    std::size_t speckles = 0;
    std::size_t others = 0;  ///< pictures of the trees in other words that differ in any bit

    void operator+=(const Speckles& other) {
        pictures += other.pictures;
        pixels += other.pixels;
        speckles += other.speckles;
        others += other.others;
    }
};

inline constexpr int picture_size = 64;

/// The pixels whose eight neighbours are all of one region, which is not their own.
inline std::vector<std::size_t> lone_pixels(const Image& image) {
    const std::span<const std::uint32_t> region = image.ids("region");
    const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
    std::vector<std::size_t> lone;
    for (std::size_t y = 1; y + 1 < height; ++y)
        for (std::size_t x = 1; x + 1 < width; ++x) {
            const std::size_t at = y * width + x;
            const std::uint32_t around = region[at - 1];
            bool agreed = region[at] != around;
            for (const std::size_t row : {at - width, at, at + width})
                for (const std::size_t n : {row - 1, row, row + 1}) agreed = agreed && (n == at || region[n] == around);
            if (agreed) lone.push_back(at);
        }
    return lone;
}

inline bool same_pictures(const Image& a, const Image& b) {
    for (std::size_t c = 0; c < a.channels.size(); ++c)
        if (std::memcmp(a.channels[c].data(), b.channels[c].data(), a.channels[c].size() * sizeof(float)) != 0)
            return false;
    return true;
}

/// Slanted, along an axis, and from below; all of what the scene's own box holds, since that of a tree in other words
/// may be another.
inline Speckles look(const stress::StressScene& made, const Settings& settings) {
    Speckles found;
    const TrueScene truth(made.scene, made.objects);
    Box box = Renderer(made.scene, made.objects, settings).model().bounds();
    if (!std::isfinite(box.high.x - box.low.x)) box = {{-8, -8, -8}, {8, 8, 8}};  // half-spaces in every region
    const auto middle = [](double a, double b) { return 0.5 * (a + b); };
    for (const auto& [azimuth, elevation] : {std::array{35.0, 25.0}, std::array{0.0, 90.0}, std::array{215.0, -40.0}}) {
        View view{.width = picture_size, .height = picture_size};
        view.camera.azimuth = azimuth;
        view.camera.elevation = elevation;
        view.camera.center = {middle(box.low.x, box.high.x), middle(box.low.y, box.high.y),
                              middle(box.low.z, box.high.z)};
        view.camera.view_size = std::hypot(box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z);
        const Image image = Renderer(made.scene, made.objects, settings).render(view);
        ++found.pictures;
        found.pixels += image.channels[0].size();

        const CompiledScene compiled = compile(made.scene, made.objects, {});
        const PreparedFrame prepared = prepare_frame(compiled, view, -1);
        for (const std::size_t at : lone_pixels(image)) {
            const auto x = static_cast<std::uint32_t>(at % picture_size),
                       y = static_cast<std::uint32_t>(at / picture_size);
            const kernel::world_ray r = kernel::camera_ray(&prepared.frame, {x, y, 1});
            const Ray ray{{r.o.x, r.o.y, r.o.z}, {r.d.x, r.d.y, r.d.z}};
            const Truth one = truth.shoot(ray);
            bool tie = one.tie;
            const Sequence sequence = sequence_of(one, tie);
            // As the picture says it: 0 for nothing, else the renderer's region and 1.
            std::uint32_t expected = 0;
            for (std::uint32_t i = 0; i < compiled.region_info.size() && !sequence.empty(); ++i)
                if (compiled.region_info[i].path == "/" + made.objects[sequence.front().region]) expected = i + 1;
            if (tie || static_cast<std::uint32_t>(expected) == image.ids("region")[at]) continue;
            if (found.speckles++ == 0) keep_finding("speckle", made, made.scene, ray);
        }
        for (std::size_t c = 0; c < changes.size(); ++c) {
            if (!changes[c].to_the_bit) continue;
            const Changed other = changed(made, c, 1, {});
            if (!same_pictures(image, Renderer(other.scene, other.objects, settings).render(view))) ++found.others;
        }
    }
    return found;
}

}  // namespace csgrt::test
