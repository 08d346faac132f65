// Each function of OpenCL that csgrt calls fails at each of its calls: the call of csgrt's throws, or its answer is
// right; nothing is left behind, and the next call is right.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "catch.hpp"
#include "device/choice.hpp"
#include "device/compiling_device.hpp"
#include "device/discovery.hpp"
#include "device/faulty_opencl.hpp"
#include "faults/draw.hpp"
#include "integration/deep_scenes.hpp"
#include "integration/same_answers.hpp"
#include "native/driver.hpp"
#include "pipeline/scheduling/device_group.hpp"
#include "reference/reference.hpp"
#include "sanitized.hpp"
#include "stress/parts.hpp"

using namespace csgrt;
using test::Call;
using test::FaultyOpenCl;

namespace {

/// What a call of csgrt's gives, whichever kind of call it is.
struct Answer {
    Image image;
    std::vector<RayPartitions> partitions;
};

void require_same(const Answer& a, const Answer& b) {
    test::require_same(a.image, b.image);
    test::require_same(a.partitions, b.partitions);
}

bool is_of_discovery(Call call) {
    return call == Call::GetPlatformIDs || call == Call::GetPlatformInfo || call == Call::GetDeviceIDs ||
           call == Call::GetDeviceInfo;
}

/// The status that such an error must have. A device that cannot be described is none.
bool fits(Status status, Call call, cl_int code) {
    if (status == Status::no_device) return is_of_discovery(call);
    const bool is_memory = code == CL_OUT_OF_HOST_MEMORY || code == CL_MEM_OBJECT_ALLOCATION_FAILURE;
    return status == (is_memory ? Status::out_of_memory : Status::device_fault);
}

/// Calls that draw or shoot, made on something that lives for one of them or for all.
struct Case {
    std::string name;
    std::function<std::function<Answer()>()> make;  ///< makes it, and what calls it; may throw
    bool is_kept = false;                           ///< made once, without a fault
};

struct Figures {
    std::size_t calls = 0, runs = 0, thrown = 0, right = 0;
};

/// How many of the calls fail.
enum class Calls { some, each, each_with_every_code };

Figures fail_everywhere(const Case& one, FaultyOpenCl& faulty, Calls which, test::FaultDraw& draw) {
    Figures figures;
    std::function<Answer()> kept;
    if (one.is_kept) kept = one.make();
    const auto run = [&] { return one.is_kept ? kept() : one.make()(); };
    const Answer expected = run();
    if (!one.is_kept) REQUIRE(FaultyOpenCl::live() == 0);
    faulty.reset();
    require_same(run(), expected);
    std::array<std::size_t, test::calls> counts;
    for (std::size_t i = 0; i < test::calls; ++i) counts[i] = faulty.count(static_cast<Call>(i));
    const long live = FaultyOpenCl::live();

    for (std::size_t i = 0; i < test::calls; ++i) {
        const Call call = static_cast<Call>(i);
        const std::vector<cl_int> codes = test::codes_of(call);
        figures.calls += counts[i];
        for (std::size_t number = 1; number <= counts[i]; ++number)
            for (std::size_t c = 0; c < codes.size(); ++c) {
                if (which != Calls::each_with_every_code && c != number % codes.size()) continue;
                if (!draw.draws()) continue;
                ++figures.runs;
                INFO(one.name << ": " << test::call_names[i] << ", call " << number << " of " << counts[i] << ", "
                              << opencl_error_name(codes[c]));
                faulty.reset();
                faulty.fail(call, number, codes[c]);
                std::optional<Answer> answer;
                std::function<Answer()> again = kept;
                try {
                    if (!one.is_kept) again = one.make();
                    answer = again();
                } catch (const Error& error) {
                    INFO(error.what());
                    CHECK(fits(error.status(), call, codes[c]));
                    if (error.status() != Status::no_device && codes[c] != CL_BUILD_PROGRAM_FAILURE)
                        CHECK(std::string(error.what()).find(test::call_names[i]) != std::string::npos);
                }
                figures.thrown += !answer;
                figures.right += answer.has_value();
                if (answer) require_same(*answer, expected);
                const bool is_over =
                    faulty.count(call) >= number;  // else it is at the end, or of a wait that was short
                if (again && is_over) require_same(again(), expected);
                again = nullptr;
                if (!one.is_kept) REQUIRE(FaultyOpenCl::live() == 0);
                if (one.is_kept) REQUIRE(FaultyOpenCl::live() <= live + 64);  // rings that have grown, no more
            }
    }
    return figures;
}

const View every{.width = 40, .height = 24};
View first_hits() {
    View view = every;
    view.every_partition = false;
    return view;
}

Scene small_scene() { return stress::scene_of_parts(6); }

/// On a native device, from its discovery to its end.
std::vector<Case> native_cases() {
    Settings settings{.device = "native", .threads = 2};
    const auto on = [=](const Scene& scene, const std::function<Answer(Renderer&)>& call) {
        return [=]() -> std::function<Answer()> {
            const auto renderer = std::make_shared<Renderer>(scene, std::vector<std::string>{}, settings);
            return [=] { return call(*renderer); };
        };
    };
    const auto draw = [](const View& view) {
        return [=](Renderer& renderer) { return Answer{renderer.render(view), {}}; };
    };
    const auto shoot = [](Renderer& renderer) {
        return Answer{{}, renderer.shoot(test::random_rays(renderer.model().bounds(), 20))};
    };
    return {{"every partition", on(small_scene(), draw(every))},
            {"first hits", on(small_scene(), draw(first_hits()))},
            {"rays", on(small_scene(), shoot)}};
}

void tell(const Case& one, const Figures& figures, Calls which) {
    WARN(one.name << ": " << figures.calls << " calls, " << figures.runs << " runs: " << figures.thrown << " threw, "
                  << figures.right << " were right");
    CHECK(figures.thrown > 0);
    if (which != Calls::some) CHECK(figures.right > 0);
}

test::FaultDraw draw_of(Calls which) {
    return test::FaultDraw(which == Calls::some ? test::some_faults : test::all_faults);
}

void fail_on_native(Calls which) {
    if (find_native_devices().empty()) return;
    FaultyOpenCl faulty(native::functions());
    const NativeTable table(&faulty.functions());
    test::FaultDraw draw = draw_of(which);
    for (const Case& one : native_cases()) tell(one, fail_everywhere(one, faulty, which, draw), which);
}

/// The way in which GPUs draw, on a device of OpenCL's; its programs are made once.
std::vector<Case> asynchronous_cases(FaultyOpenCl& faulty) {
    const auto on = [&faulty](const Scene& scene, const View& view, bool is_registered) {
        return [=, &faulty]() -> std::function<Answer()> {
            struct Parts {
                Scene scene;
                Renderer renderer;
                CompiledScene compiled = compile(scene, {});
                std::unique_ptr<RecordConverter> records = make_converter(compiled);
                std::unique_ptr<DeviceGroup> group = nullptr;
            };
            Settings reference{.reference = true};
            const auto parts = std::make_shared<Parts>(Parts{scene, Renderer(scene, {}, reference)});
            const std::vector<FoundDevice> all = find_devices().devices;
            FoundDevice device = all.at(choose_device(infos_of(all), test::compiling_device()));
            device.cl = &faulty.functions();
            parts->group = std::make_unique<DeviceGroup>(std::vector{device}, parts->compiled, *parts->records,
                                                         Settings{}, Readback::asynchronous);
            parts->group->prepare(true);
            parts->group->prepare(view.every_partition);
            return [=] {
                Answer answer{parts->renderer.render(view), {}};
                Image& image = answer.image;
                std::vector<ChannelMemory> channels;
                for (std::size_t c = 0; c < image.names.size(); ++c) {
                    const float far = std::numeric_limits<float>::infinity(), opaque = image.names[c] == "A" ? 1 : 0;
                    std::ranges::fill(image.channels[c], -1.0f);
                    channels.push_back({image.channels[c].data(), image.names[c] == "Z" ? far : opaque});
                }
                std::vector<std::uint8_t> covered(15, 1);
                const PreparedFrame frame =
                    prepare_frame(parts->compiled, view, parts->renderer.statistics().tolerance);
                PipelineCounts counts;
                const std::shared_ptr<RegisteredMemory> registered =
                    is_registered ? parts->group->register_memory(channels, image.channels[0].size()) : nullptr;
                parts->group->render(frame, {.channels = channels, .covered = covered, .registered = registered.get()},
                                     nullptr, counts);
                return answer;
            };
        };
    };
    return {{"asynchronous, every partition", on(small_scene(), every, false), true},
            {"asynchronous, first hits", on(small_scene(), first_hits(), false), true},
            {"asynchronous, into registered memory", on(small_scene(), first_hits(), true), true}};
}

void fail_asynchronously(Calls which) {
    const std::vector<FoundDevice> all = find_devices().devices;
    const auto compiles = [](const FoundDevice& device) { return !is_native(device.info) && device.info.fp64; };
    if (std::ranges::none_of(all, compiles)) return;
    FaultyOpenCl faulty(*all.at(choose_device(infos_of(all), test::compiling_device())).cl);
    test::FaultDraw draw = draw_of(which);
    for (const Case& one : asynchronous_cases(faulty)) {
        tell(one, fail_everywhere(one, faulty, which, draw), which);
        CHECK(FaultyOpenCl::live() == 0);
    }
}

}  // namespace

TEST_CASE("a call of OpenCL fails: an error of the right status or the same bits, and nothing is left",
          "[promise:failures]") {
    fail_on_native(Calls::some);
}

TEST_CASE("a call of a GPU's frame fails: an error of the right status or the same bits, and nothing is left",
          "[promise:failures]") {
    fail_asynchronously(Calls::some);
}

TEST_CASE("each call of OpenCL fails once: an error of the right status or the same bits", "[.faults]") {
    fail_on_native(Calls::each);
    fail_asynchronously(Calls::each);
}

TEST_CASE("each call of OpenCL fails once with each error that it may have", "[.long][promise:failures]") {
    fail_on_native(Calls::each_with_every_code);
    fail_asynchronously(Calls::each_with_every_code);
}
