// csgrt computes in one way, and leaves the host its own.
#include <iterator>

#include "cli/command.hpp"
#include "host/host_states.hpp"
#include "host/process.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

/// What csgrt answers about a scene, through all that computes, and whether the host's state was the same before, in
/// callbacks and after.
struct Answer {
    std::string bytes;
    bool kept = true;
};

Answer ask(const std::string& text, const std::string& name, const std::string& who, const std::string& file) {
    Answer answer;
    const test::State before;
    const auto look = [&] { answer.kept = answer.kept && test::State() == before; };
    Settings settings = on(who);
    settings.progress = [&](double) {
        look();
        return true;
    };
    const Scene scene = parse_scene(text, name);
    look();
    answer.bytes += std::to_string(validate(scene).size());
    look();
    for (const std::string& top : top_objects(scene)) answer.bytes += name_of(*object_at(scene, "/" + top));
    look();
    prepare_devices(settings);
    if (who == "pocl") answer.bytes += std::to_string(devices().size());
    look();
    Renderer renderer(scene, {}, settings);
    look();
    Image image = renderer.render(small_view());
    look();
    renderer.name_pixels(image);
    look();
    renderer.name_overlaps(small_view(), image);
    look();
    for (std::size_t c = 0; c < image.channels.size(); ++c)
        append(answer.bytes, image.channels[c].data(), image.channels[c].size());
    for (const auto& [key, matrix] : image.matrices) append(answer.bytes, matrix.data(), matrix.size());
    for (const auto& [key, value] : image.attributes) answer.bytes += value;
    const std::vector<Ray> rays = renderer.model().grid_of(small_view()).rays();
    look();
    append(answer.bytes, rays.data(), rays.size());
    if (who != "pocl")  // kernels that take it seconds to compile
        for (const RayPartitions& ray : renderer.shoot(rays))
            for (const Partition& p : ray.partitions) {
                append(answer.bytes, &p.in, 1);
                append(answer.bytes, &p.out, 1);
                append(answer.bytes, &p.in_normal, 1);
                append(answer.bytes, &p.out_normal, 1);
                append(answer.bytes, &p.region, 1);
            }
    look();
    try {
        renderer.shoot({{{1e300, 0, 0}, {0, 1, 0}}});
    } catch (const Error& error) {
        answer.bytes += error.what();
    }
    look();
    save_scene(scene, file);
    answer.bytes += command_test::read_file(file);
    look();
    return answer;
}

void compare(const std::vector<std::string>& files, const std::string& who) {
    require_good(who, [&] {
        const command_test::Folder folder;
        const std::string copy = folder / "scene.json";  // a path rounds
        static_cast<void>(renderer_on(small_scene(), on(who)));
        const std::size_t states = files.size() == 1 ? std::size(host_states) : 2;  // of each, in turn
        std::size_t next = 0;
        for (const std::string& file : files) {
            const std::string text = command_test::read_file(file);
            const Answer usual = ask(text, file, who, copy);
            for (std::size_t i = 0; i < states; ++i) {
                const HostState& host = host_states[next++ % std::size(host_states)];
                INFO(file << ", " << host.name);
                const Answer answer = [&] {
                    const InState state(host);
                    return ask(text, file, who, copy);
                }();
                REQUIRE((answer.bytes == usual.bytes));
                REQUIRE(answer.kept);
            }
        }
    });
}

}  // namespace

TEST_CASE("whatever the host's rounding, traps and tiny numbers, csgrt's bits are the same",
          "[device][promise:process]") {
    const std::string operators = test::folder("CSGRT_SCENES") + "/operators.json";
    for (const std::string who : {"native", "reference"}) compare(scene_files(), who);
    for (const std::string who : {"native", "reference", "pocl"}) compare({operators}, who);
}

TEST_CASE("a verification judges alike whatever the host's floating-point state", "[device][promise:process]") {
    require_good("native", [&] {
        const Scene scene = small_scene();
        static_cast<void>(renderer_on(scene, on("native")));
        const auto judge = [&](bool& kept) {
            const test::State before;
            Settings settings = on("native");
            settings.progress = [&](double) {
                kept = kept && test::State() == before;
                return true;
            };
            Verifier verifier(scene, {}, settings);
            verifier.shoot(verifier.sample(scene.camera, 50));
            kept = kept && test::State() == before;
            const Verification& v = verifier.result();
            std::string bytes;
            append(bytes, &v.ends, 1);
            append(bytes, &v.decided, 1);
            append(bytes, &v.wrong, 1);
            append(bytes, &v.bit_differences, 1);
            append(bytes, &v.farthest.millimetres, 1);
            append(bytes, &v.worst.ulps, 1);
            return bytes;
        };
        bool kept = true;
        const std::string usual = judge(kept);
        for (const HostState& host : host_states) {
            INFO(host.name);
            const std::string bytes = [&] {
                const InState state(host);
                return judge(kept);
            }();
            REQUIRE((bytes == usual));
            REQUIRE(kept);
        }
    });
}
