// What a pixel without a hit holds, and how it is told from one with a hit.
#include <csgrt/renderer.hpp>

#include "base/srgb.hpp"
#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "stress/parts.hpp"

using namespace csgrt;

TEST_CASE("the background is opaque, or with View::transparent nothing; `region` tells what is hit",
          "[promise:colors]") {
    Scene scene = stress::scene_of_parts(20);
    scene.background = {0.2, 0.5, 1};
    Settings by_reference{.reference = true};
    Renderer renderer(scene, {}, test::on_device()), reference(scene, {}, by_reference);
    View view{.width = 99, .height = 77};
    view.every_partition = GENERATE(true, false);
    const Image opaque = renderer.render(view);
    Framebuffer framebuffer;  // that another background was in
    renderer.render(view, framebuffer);
    view.transparent = true;
    renderer.render(view, framebuffer);
    const Image& transparent = framebuffer.image();
    test::require_same(transparent, reference.render(view));
    test::require_same(transparent, renderer.render(view));

    const float background[] = {static_cast<float>(linear_of_display(0.2)), static_cast<float>(linear_of_display(0.5)),
                                1, 1};
    const std::span<const std::uint32_t> region = opaque.ids("region");
    std::size_t hits = 0, right = 0;
    for (std::size_t i = 0; i < region.size(); ++i) {
        hits += region[i] > 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const float seen = opaque.channels[c][i];
            right += region[i] > 0 ? transparent.channels[c][i] == seen && (c < 3 || seen == 1)
                                   : transparent.channels[c][i] == 0 && seen == background[c];
        }
    }
    CHECK(hits > 500);
    CHECK(hits < region.size() - 500);
    CHECK(right == 4 * region.size());
    CHECK(std::ranges::equal(transparent.ids("region"), region));
}
