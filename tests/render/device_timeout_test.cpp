// A device that gives no answer: the call ends in time, and nothing waits for its driver any more.
#include <optional>

#include "stress/parts.hpp"
#include "base/clock.hpp"
#include "catch.hpp"
#include "device/discovery.hpp"
#include "device/faulty_opencl.hpp"
#include "integration/same_answers.hpp"
#include "native/driver.hpp"
#include "sanitized.hpp"

using namespace csgrt;
using test::failure;
using test::FaultyOpenCl;

namespace {

constexpr double timeout = 0.05;

}  // namespace

TEST_CASE("a device that never answers ends the call in time, and its Renderer is used no more", "[promise:failures]") {
    if (find_native_devices().empty()) return;
    if (test::sanitized) return;  // what a lost device holds stays, which is a leak to it
    FaultyOpenCl faulty(native::functions());
    const NativeTable table(&faulty.functions());
    Settings settings{.device = "native", .threads = 2};
    settings.device_timeout = timeout;
    const Scene scene = stress::scene_of_parts(6);
    View every{.width = 40, .height = 24}, first = every;
    first.every_partition = false;
    const auto follow = GENERATE(false, true);  // by a thread that works for the caller's
    if (follow) settings.progress = [](double) { return true; };
    const std::vector<std::function<void(Renderer&)>> calls = {
        [&](Renderer& renderer) { renderer.render(every); },
        [&](Renderer& renderer) { renderer.render(first); },
        [&](Renderer& renderer) { renderer.shoot(test::random_rays(renderer.model().bounds(), 20)); },
    };
    for (const auto& call : calls) {
        std::optional<Renderer> renderer(std::in_place, scene, std::vector<std::string>{}, settings);
        faulty.reset();
        call(*renderer);
        const std::size_t events = faulty.events();
        REQUIRE(events > 5);
        std::size_t lost = 0;
        for (std::size_t last = 0; last < events; ++last) {
            INFO("after " << last << " of " << events << " events");
            faulty.reset();
            renderer.emplace(scene, std::vector<std::string>{}, settings);
            faulty.hang_after(faulty.events() + last);
            const auto begin = Clock::now();
            const std::string text = failure([&] { call(*renderer); });
            CHECK(seconds_since(begin) < timeout + 1);
            CHECK(faulty.waits() == 0);
            if (text.empty()) continue;  // nobody waits for the last ones
            ++lost;
            CHECK(text.find(" gave no answer for 0.05 s") != text.npos);
            const std::size_t asked = faulty.all_calls();
            CHECK(failure([&] { call(*renderer); }) == text);
            CHECK(failure([&] { calls[0](*renderer); }) == text);
            renderer.reset();
            CHECK(faulty.all_calls() == asked);
        }
        CHECK(lost > 3);
    }
    faulty.reset();
    Renderer fresh(scene, {}, settings);  // another Renderer is none of that
    CHECK_NOTHROW(fresh.render(every));
}

TEST_CASE("how long a device may take: a GPU a minute, a processor any time, and what the caller says",
          "[promise:failures]") {
    if (find_native_devices().empty()) return;
    FoundDevice device = find_native_devices().front();
    CHECK(Device(device).cl().patience == 0);
    CHECK(Device(device, 0, 3).cl().patience == 3);
    device.info.type = "gpu";
    CHECK(Device(device).cl().patience == 60);
    CHECK(Device(device, 0, 0.0).cl().patience == 0);
}
