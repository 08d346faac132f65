// The laboratory's meshes against the 113-bit reference; skipped where there is no Embree, or no Manifold.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "bench/chart/truth.hpp"
#include "bench/methods/list.hpp"
#include "catch.hpp"
#include "stress/random.hpp"

using namespace csgrt;
using namespace csgrt::bench;

namespace {

/// Every operator; regions that overlap, one behind the other, one that is bored through.
Scene some_scene() {
    const char* path = "method_meshes_scene.json";
    std::ofstream(path) << R"({"csgrt": 1, "units": "mm", "solids": {
        "ball": {"type": "sphere", "center": [0, 0, 0], "radius": 10},
        "bore": {"type": "cylinder", "base": [0, 0, -20], "height": [0, 0, 40], "radius": 4},
        "box": {"type": "box", "low": [5, -3, -3], "high": [18, 3, 3]},
        "left": {"type": "sphere", "center": [-20, 0, 0], "radius": 6},
        "right": {"type": "sphere", "center": [-14, 0, 0], "radius": 6}},
        "combinations": {
        "bored": {"region": true, "tree": {"difference": ["ball", "bore"]}},
        "bar": {"region": true, "tree": {"union": ["box", {"intersection": ["bore", "ball"]}]}},
        "apart": {"region": true, "tree": {"xor": ["left", "right"]}}}})";
    Scene scene = load_scene(path);
    std::filesystem::remove(path);
    return scene;
}

std::vector<Ray> some_rays(std::size_t count) {
    stress::Random random(3);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 from = random.in_cube(), to = random.in_cube();
        rays.push_back({{100 * from.x, 100 * from.y, 100 * from.z},
                        {20 * to.x - 100 * from.x, 12 * to.y - 100 * from.y, 12 * to.z - 100 * from.z}});
    }
    return rays;
}

/// Where meshes are kept: empty before, and gone afterwards.
struct Folder {
    Folder() {
        std::filesystem::remove_all("method_meshes_folder");
        setenv("CSGRT_MESHES", "method_meshes_folder", 1);
    }
    ~Folder() { std::filesystem::remove_all("method_meshes_folder"); }
};

struct Setting {
    Scene scene = some_scene();
    std::vector<std::string> objects;
    CompiledScene compiled = compile(scene);
    std::vector<Ray> rays = some_rays(600);
    std::vector<TrueRay> truth = true_rays(scene, objects, rays);

    /// None: what it needs is not there.
    std::optional<Accuracy> accuracy(const TraceOptions& options) const {
        std::unique_ptr<Tracer> tracer;
        try {
            tracer = meshes().prepare({scene, objects, compiled}, options);
        } catch (const Error& error) {
            const std::string why = error.what();
            if (why.find("libembree") == why.npos && why.find("manifold3d") == why.npos) throw;
            WARN("skipped: " << why);
            return {};
        }
        CHECK(tracer->figures().at("triangles") > 100);
        Accuracy all;
        const std::vector<Answer> answers = tracer->trace(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (options.first_hits) {  // of the truth, too, the first one, and of that where it begins
                TrueRay first = truth[i];
                first.sequence.resize(std::min<std::size_t>(first.sequence.size(), 1));
                for (Stretch& s : first.sequence) s.out = HUGE_VAL;
                all.add(first, joined(answers[i].stretches));
            } else {
                all.add(truth[i], joined(answers[i].stretches));
            }
        }
        return all;
    }
};

}  // namespace

TEST_CASE("rays meet in meshes what they meet in solids, up to the chord error") {
    const Folder folder;
    const Setting setting;
    for (const bool first_hits : {false, true}) {
        CAPTURE(first_hits);
        TraceOptions options;
        options.first_hits = first_hits;
        options.knob = 0.001;
        const std::optional<Accuracy> fine = setting.accuracy(options);
        if (!fine) return;
        CHECK(fine->decided > 500);
        CHECK(fine->wrong <= 3);
        CHECK(fine->error_mm.quantile(0.9) < 0.01);
        CHECK(fine->error_mm.quantile(0.9) > 1e-6);

        options.knob = 0.3;
        const std::optional<Accuracy> coarse = setting.accuracy(options);
        CHECK(coarse->wrong > fine->wrong);
        CHECK(coarse->error_mm.quantile(0.9) > 10 * fine->error_mm.quantile(0.9));

        options.planted = true;
        CHECK(setting.accuracy(options)->wrong > coarse->wrong + 50);
    }
}
