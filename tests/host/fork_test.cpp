// A program that uses csgrt and forks. Each case has a process of its own, which forks again.
#include <atomic>
#include <cstring>
#include <thread>
#include <utility>

#include "device/discovery.hpp"
#include "host/process.hpp"
#include "integration/same_answers.hpp"
#include "thrown.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

constexpr const char* pocl = "Portable Computing Language";

template <class Call>
void require_refusal(const Call& call) {
    REQUIRE_THAT(test::thrown_by(call).text, ContainsSubstring("before this process was forked"));
}

}  // namespace

TEST_CASE("after a fork a new Renderer works in the child, and the parent's goes on", "[device][promise:process]") {
    for (const std::string who : {"native", "reference"})
        require_good(who, [&] {
            const Scene scene = small_scene();
            Renderer renderer = renderer_on(scene, on(who));
            const Image image = renderer.render(small_view());
            const auto rays = renderer.model().grid_of(small_view()).rays();
            const auto answers = renderer.shoot(rays);
            std::atomic<bool> stop{false};
            std::thread other([&] {  // the fork may come at any time of another thread's calls
                while (!stop) Renderer(scene, {}, on(who)).render(small_view());
            });
            for (int i = 0; i < 5; ++i)
                REQUIRE(status_of([&] {
                            Renderer fresh(small_scene(), {}, on(who));
                            require_same(fresh.render(small_view()), image);
                            require_same(fresh.shoot(rays), answers);
                            Verifier verifier(scene, {}, on(who));
                            verifier.shoot(verifier.sample(scene.camera, 8));
                            REQUIRE(verifier.result().rays == 8);
                        }) == 0);
            stop = true;
            other.join();
            require_same(renderer.render(small_view()), image);
        });
}

TEST_CASE("a Model that a child inherits answers as before, also what the parent has not asked yet",
          "[device][promise:process]") {
    require_good("native", [] {
        const csgrt::Model asked(small_scene()), fresh(small_scene());
        const RayGrid rays = asked.grid_of(small_view());
        const Fields all{.solids = true, .normals = true, .overlaps = true};
        Partitions expected;
        asked.partitions(rays, expected, all);
        REQUIRE(status_of([&] {
                    Partitions found;
                    for (const csgrt::Model* const model : {&asked, &fresh}) {
                        model->partitions(rays, found, all);
                        require_same(found, expected);
                        Renderer renderer(*model, on("native"));
                        renderer.partitions(rays, found, all);
                        require_same(found, expected);
                    }
                }) == 0);
    });
}

TEST_CASE("a Renderer that a child inherits refuses every call, and goes without a word", "[device][promise:process]") {
    for (const std::string who : {"native", "reference", "pocl"})
        require_good(who, [&] {
            const Scene scene = small_scene();
            Renderer renderer = renderer_on(scene, on(who));
            renderer.render(small_view());
            REQUIRE(status_of([&] {
                        Image image;
                        require_refusal([&] { renderer.render(small_view()); });
                        require_refusal([&] { renderer.shoot({{{0, -9e3, 0}, {0, 1, 0}}}); });
                        require_refusal([&] { renderer.name_pixels(image); });
                        require_refusal([&] { renderer.name_overlaps(small_view(), image); });
                        require_refusal([&] { renderer.model(); });
                        require_refusal([&] { renderer.statistics(); });
                        require_refusal([&] { renderer.device_warnings(); });
                        Renderer moved(std::move(renderer));
                        require_refusal([&] { moved.model(); });
                        moved = Renderer(scene, {}, on("reference"));  // the one that was inherited goes
                        REQUIRE(moved.render(small_view()).width == 24);
                    }) == 0);
            REQUIRE(status_of([&] { Renderer goes(std::move(renderer)); }) == 0);
            REQUIRE(renderer.render(small_view()).width == 24);
        });
}

TEST_CASE("a Verifier that a child inherits refuses to shoot, and goes without a word", "[device][promise:process]") {
    require_good("native", [&] {
        const Scene scene = small_scene();
        static_cast<void>(renderer_on(scene, on("native")));
        Verifier verifier(scene, {}, on("native"));
        verifier.shoot(verifier.sample(scene.camera, 8));
        REQUIRE(status_of([&] {
                    require_refusal([&] { verifier.shoot({{{0, -9e3, 0}, {0, 1, 0}}}); });
                    require_refusal([&] { verifier.sample(scene.camera, 8); });
                    Verifier goes(std::move(verifier));
                    REQUIRE(goes.result().rays == 8);
                }) == 0);
    });
}

TEST_CASE("OpenCL serves the process alone that uses it first, and its children have the others",
          "[device][promise:process]") {
    require_good("pocl", [&] {
        const Scene scene = small_scene();
        REQUIRE(status_of([&] { renderer_on(scene, on("pocl")).render(small_view()); }) == 0);  // none is loaded here
        const Image image = renderer_on(scene, on("pocl")).render(small_view());
        REQUIRE(status_of([&] {
                    std::vector<std::string> notes;
                    for (const DeviceInfo& device : devices(&notes)) REQUIRE(device.platform == "csgrt");
                    REQUIRE(notes.size() == 1);
                    REQUIRE_THAT(notes[0], ContainsSubstring("before this process was forked"));
                    require_refusal([&] { Renderer(scene, {}, on("pocl")); });
                    require_same(Renderer(scene, {}, on("reference")).render(small_view()), image);
                    require_same(Renderer(scene).render(small_view()), image);
                    std::exit(0);  // as programs end
                }) == 0);
    });
}

TEST_CASE("a child may draw into a Framebuffer that a driver of its parent's knows", "[device][promise:process]") {
    require_good("pocl", [&] {
        const PretendedGpu gpu(pocl);  // its drivers register the memory
        const Scene scene = small_scene();
        Renderer renderer = renderer_on(scene, on("gpu"));
        Framebuffer framebuffer;
        for (int i = 0; i < 3; ++i) renderer.render(small_view(), framebuffer);
        REQUIRE(status_of([&] {
                    Framebuffer goes = std::move(framebuffer);
                    Renderer fresh(scene, {}, on("reference"));
                    View view = small_view();
                    view.camera.azimuth += 20;
                    fresh.render(view, goes);
                    require_same(goes.image(), fresh.render(view));
                }) == 0);
        Renderer(std::move(renderer)).render(small_view(), framebuffer);
    });
}

TEST_CASE("a child that is forked while devices are looked for ends, and has what needs no driver", "[device]") {
    for (int i = 0; i < 10; ++i)
        require_good("pocl", [&] {
            const Scene scene = small_scene();
            const PretendedGpu gpu(pocl);
            prepare_devices();
            usleep(static_cast<useconds_t>(4000 * i));
            REQUIRE(status_of([&] {
                        prepare_devices();
                        Renderer(scene, {}, on("native")).render(small_view());
                        std::exit(0);
                    }) == 0);
        });
}
