// Settings::check: the reference looks at batches of what devices draw and shoot.
#include "catch.hpp"
#include "device/discovery.hpp"
#include "device/faulty_opencl.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "native/driver.hpp"
#include "stress/parts.hpp"

using namespace csgrt;
using test::Call;
using test::failure;
using test::FaultyOpenCl;

namespace {

Settings checked(unsigned every) { return {.device = "native", .check = every}; }

View view_of(bool every_partition) {
    View view{.width = 48, .height = 40};
    view.every_partition = every_partition;
    return view;
}

}  // namespace

TEST_CASE("a device that draws right passes every check, with every solid", "[promise:verify]") {
    if (find_native_devices().empty()) return;
    for (const std::string& file : test::scene_files()) {
        INFO(file);
        Renderer renderer(load_scene(file), {}, checked(1));
        for (const bool every : {true, false}) CHECK_NOTHROW(renderer.render(view_of(every)));
        CHECK_NOTHROW(renderer.shoot(test::random_rays(renderer.model().bounds(), 50)));
    }
}

TEST_CASE("a bit that a device gets wrong is found where the batch is checked, and told with its place",
          "[promise:verify]") {
    if (find_native_devices().empty()) return;
    FaultyOpenCl faulty(native::functions());
    const NativeTable table(&faulty.functions());
    const Scene scene = stress::scene_of_parts(20);
    for (const bool every : {true, false}) {
        Renderer renderer(scene, {}, checked(3));
        const auto draw = [&] { return failure([&] { renderer.render(view_of(every)); }); };
        faulty.reset();
        CHECK(draw().empty());  // the first batch, which is looked at
        faulty.reset();
        CHECK(draw().empty());
        const std::size_t picture = faulty.count(Call::EnqueueMapBuffer);
        REQUIRE(picture == 2);  // which tiles see anything, and their pixels
        faulty.reset();
        faulty.tamper(Call::EnqueueMapBuffer, picture);
        CHECK(draw().empty());  // nobody looks at it
        faulty.reset();
        faulty.tamper(Call::EnqueueMapBuffer, picture);
        const std::string text = draw();
        INFO(text);
        CHECK(text.starts_with("native-"));
        CHECK(text.find(" computed wrongly: the pixel in column ") != text.npos);
        CHECK(text.find(" in the channel ") != text.npos);
    }
    Scene ball;
    ball.objects.push_back(Solid{"ball", Ell{{}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}}, {}});
    Combination part;
    part.name = "part";
    part.region = true;
    part.tree.nodes.resize(1);
    part.tree.nodes[0].object = "ball";
    ball.objects.push_back(part);
    Renderer renderer(ball, {}, checked(1));
    const std::vector<Ray> rays = {{{1, 2, -30}, {0, 0, 1}}};
    CHECK(failure([&] { renderer.shoot(rays); }).empty());
    faulty.reset();
    CHECK(failure([&] { renderer.shoot(rays); }).empty());
    const std::size_t ends = faulty.count(Call::EnqueueReadBuffer) - 1;  // the last read is of the partitions
    faulty.reset();
    faulty.tamper(Call::EnqueueReadBuffer, ends);
    const std::string text = failure([&] { renderer.shoot(rays); });
    INFO(text);
    CHECK(text.find(" computed wrongly: the partitions of ray 0 ") != text.npos);
}
