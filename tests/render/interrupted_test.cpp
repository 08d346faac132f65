// Calls that Settings::progress ends, and those that it does not.
#include <algorithm>
#include <atomic>
#include <limits>

#include <csgrt/csgrt.hpp>

#include "catch.hpp"
#include "device/buffer.hpp"
#include "device/discovery.hpp"
#include "device/program.hpp"
#include "integration/same_answers.hpp"
#include "thrown.hpp"
#include "stress/parts.hpp"

using namespace csgrt;

namespace {

const View picture{.width = 200, .height = 160};

/// Settings for the reference, or a device.
Settings settings_for(bool reference) {
    Settings settings = reference ? Settings{} : test::on_device();
    settings.reference = reference;
    return settings;
}

/// Whether `call` was interrupted.
template <class Call>
bool is_interrupted(const Call& call) {
    return !test::failure(Status::interrupted, call).empty();
}

}  // namespace

TEST_CASE("a frame and a list of rays: progress ends them before they begin, and keeps what is finished",
          "[promise:interrupts]") {
    const bool reference = GENERATE(false, true), every = GENERATE(false, true);
    const Scene scene = stress::scene_of_parts(20);
    Renderer plain(scene, {}, settings_for(reference));
    View view = picture;
    view.every_partition = every;
    const Image expected = plain.render(view);
    const std::vector<Ray> rays = plain.model().grid_of({.width = 40, .height = 30}).rays();
    const std::vector<RayPartitions> answers = plain.shoot(rays);

    Settings settings = settings_for(reference);
    double refused = 0;  // from which fraction on
    int calls = 0;
    double last = -1;
    settings.progress = [&](double done) {
        CHECK(done >= last);
        last = done;
        ++calls;
        return done < refused;
    };
    Renderer followed(scene, {}, settings);
    for (const bool shoots : {false, true}) {
        const auto call = [&] {
            calls = 0;
            last = -1;
            return is_interrupted([&] {
                if (shoots)
                    test::require_same(followed.shoot(rays), answers);
                else
                    test::require_same(followed.render(view), expected);
            });
        };
        refused = 0;
        CHECK(call());
        CHECK(calls == 1);
        refused = 1;  // the last call alone is answered so, or one that comes when the work is done
        CHECK(!call());
        CHECK(last == 1);
        refused = std::numeric_limits<double>::infinity();
        CHECK(!call());
        CHECK(calls >= 2);
    }
}

TEST_CASE("a native kernel leaves out the work-items that have not begun when it is to end",
          "[device][promise:interrupts]") {
    const auto found = find_devices().devices;
    const auto native = std::ranges::find_if(found, [](const FoundDevice& f) { return is_native(f.info); });
    if (native == found.end()) return;
    Device device(*native, 0, 1);
    const Program program(device, "partitions");
    Kernel clear = program.kernel("clear_status");
    constexpr cl_uint words = 1000;
    const Buffer outside(device, "outside", std::vector<cl_uint>(words, 0x5a5a5a5au));
    Buffer status(device, "status", std::vector<cl_uint>(words, 1));
    const auto launch = [&] { clear.launch(words, 64, outside, words, words, words, status); };
    const std::atomic<bool> stop{true};
    device.end_by(&stop);
    CHECK(is_interrupted(launch));
    CHECK(status.read<cl_uint>(words) == std::vector<cl_uint>(words, 1));
    device.end_by(nullptr);
    launch();
    CHECK(status.read<cl_uint>(words) == std::vector<cl_uint>(words, 0x5a5a5a5au));
}
