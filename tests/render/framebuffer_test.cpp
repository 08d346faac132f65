// A picture drawn again and again is what a new one would be, whatever was drawn into it before.
#include <algorithm>

#include <csgrt/renderer.hpp>

#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "stress/parts.hpp"

using namespace csgrt;

namespace {

/// From `azimuth`, moved aside by `shift` and seen `zoom` times as large.
View view_of(const Renderer& renderer, int width, int height, double azimuth, double shift, double zoom) {
    const Box& box = renderer.model().bounds();
    const double size = box.high.x - box.low.x;
    View view{.width = width, .height = height};
    view.camera.azimuth = azimuth;
    view.camera.center = Vec3{0.5 * (box.low.x + box.high.x) + shift * size, 0.5 * (box.low.y + box.high.y), box.low.z};
    view.camera.view_size = 1.5 * size / zoom;
    view.every_partition = false;
    return view;
}

void require_redrawn(Renderer& renderer, Framebuffer& framebuffer, const View& view) {
    renderer.render(view, framebuffer);
    const Image fresh = renderer.render(view);
    CHECK(framebuffer.image().width == fresh.width);
    CHECK(framebuffer.image().height == fresh.height);
    CHECK(framebuffer.image().attributes == fresh.attributes);
    test::require_same(framebuffer.image(), fresh);
}

}  // namespace

TEST_CASE("a framebuffer holds the last frame alone", "[promise:models]") {
    Scene scene = stress::scene_of_parts(20);
    Renderer renderer(scene, {}, test::on_device());
    Settings by_reference{.reference = true};
    Renderer reference(scene, {}, by_reference);
    scene.background = {0.2, 0.3, 0.4};
    Renderer other(scene, {}, test::on_device());

    Framebuffer framebuffer;
    CHECK(framebuffer.image().channels.empty());
    const auto seen = [&] {
        const std::span<const std::uint32_t> region = framebuffer.image().ids("region");
        return std::count_if(region.begin(), region.end(), [](float id) { return id > 0; });
    };
    // The model moves away, is not there, and comes back.
    for (const double shift : {0.0, 0.3, 0.6, 5.0, -0.5}) {
        INFO("moved by " << shift);
        require_redrawn(renderer, framebuffer, view_of(renderer, 133, 101, 35, shift, 1));
        CHECK((seen() > 0) == (shift != 5.0));
    }
    for (const double zoom : {0.2, 3.0, 0.1})
        require_redrawn(renderer, framebuffer, view_of(renderer, 133, 101, 80, 0, zoom));

    View view = view_of(renderer, 133, 101, 10, 0, 0.5);
    SECTION("another background") {
        require_redrawn(other, framebuffer, view);
        require_redrawn(renderer, framebuffer, view);
    }
    SECTION("another size, with as many pixels, too") {
        for (const auto& [width, height] : {std::pair{101, 133}, {64, 64}, {200, 150}, {133, 101}})
            require_redrawn(renderer, framebuffer, view_of(renderer, width, height, 10, 0.2, 0.5));
    }
    SECTION("other channels") {
        view.channels = channel::color | channel::ids;
        require_redrawn(renderer, framebuffer, view);
        view.channels = channel::distance;
        require_redrawn(renderer, framebuffer, view);
        view.channels = channel::all;
        view.every_partition = true;
        require_redrawn(renderer, framebuffer, view);
        require_redrawn(renderer, framebuffer, view_of(renderer, 133, 101, 10, 0, 0.2));
    }
    SECTION("the reference, which writes every pixel") {
        require_redrawn(reference, framebuffer, view_of(renderer, 133, 101, 10, 0, 3));
        require_redrawn(renderer, framebuffer, view);
    }
    SECTION("taken away, moved and copied") {
        const Image taken = framebuffer.take();
        CHECK(framebuffer.image().channels.empty());
        CHECK(taken.channels.size() == 10);
        require_redrawn(renderer, framebuffer, view);
        Framebuffer moved = std::move(framebuffer);
        const Framebuffer copy = moved;
        require_redrawn(renderer, framebuffer, view_of(renderer, 133, 101, 10, 0.4, 0.5));
        require_redrawn(renderer, moved, view_of(renderer, 133, 101, 10, -0.4, 0.5));
        test::require_same(copy.image(), renderer.render(view));
    }
}

TEST_CASE("a framebuffer with memory for a few rays at a time, and after frames that were stopped",
          "[promise:models][promise:interrupts]") {
    const Scene scene = stress::scene_of_parts(20);
    Renderer renderer(scene, {}, test::on_device());
    renderer.render({.width = 8, .height = 8, .camera = {}, .every_partition = false});
    Settings little = test::on_device();
    little.max_memory = renderer.statistics().device_bytes + 2'000;
    int left = -1;  // calls until it is stopped
    little.progress = [&](double) { return left < 0 || left-- > 0; };
    Renderer few(scene, {}, little);

    Framebuffer framebuffer;
    require_redrawn(renderer, framebuffer, view_of(renderer, 40, 32, 35, 0, 2));
    renderer.render(view_of(renderer, 40, 32, 80, 0, 0.7), framebuffer);
    require_redrawn(few, framebuffer, view_of(renderer, 40, 32, 35, 0.3, 1));
    CHECK(few.statistics().batches > 40 * 32 / 64);  // parts of tiles, too
    require_redrawn(few, framebuffer, view_of(renderer, 40, 32, 35, -0.3, 0.5));
    for (int calls = 0; calls < 20; calls += 3) {
        left = calls;  // at first before anything is drawn, then at some time that the machine decides
        try {
            few.render(view_of(renderer, 40, 32, 10, 0, 2), framebuffer);
            CHECK(calls > 0);
        } catch (const Error& error) {
            CHECK(error.status() == Status::interrupted);
        }
        left = -1;
        require_redrawn(renderer, framebuffer, view_of(renderer, 40, 32, 35, 0.1 * calls, 0.5));
    }
}
