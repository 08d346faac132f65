// What a type of solid needs (CONTRIBUTING.md) beside what csgrt does not compile without: a sample, an oracle
// that agrees with what is packed and traced, and a test of its geometry: a row of solid_kinds_test.cpp, or a title.
#include "catch.hpp"
#include "folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <regex>
#include <set>

#include <csgrt/csgrt.hpp>

#include "integration/samples.hpp"
#include "oracle/random.hpp"
#include "oracle/scene_judge.hpp"
#include "scene/solids/shape_forms.hpp"

using namespace csgrt;

namespace {

/// JSON's names of all types but the one that stands for what csgrt does not support.
std::set<std::string> all_types() {
    std::set<std::string> types;
    const auto add = [&]<class... S>(const std::variant<S...>*) { (types.emplace(form::of<S>.head.name), ...); };
    add(static_cast<const Shape::variant*>(nullptr));
    types.erase(std::string(form::of<Unsupported>.head.name));
    return types;
}

/// The texts of the tests in folders beside the scenes.
std::string tests_in(std::initializer_list<const char*> folders) {
    std::string texts;
    const std::filesystem::path scenes = std::getenv("CSGRT_SCENES");
    for (const char* folder : folders) {
        for (const auto& entry : std::filesystem::directory_iterator(scenes / "../tests" / folder)) {
            texts += test::read_file(entry.path());
        }
    }
    return texts;
}

}  // namespace

TEST_CASE("solid types: each has a sample, and a test of its geometry or of the pieces that it is cut into",
          "[promise:solids]") {
    std::set<std::string> sampled;
    for (const Object& object : test::scene_of_samples().objects)
        sampled.emplace(type_name(std::get<Solid>(object).shape));
    CHECK(sampled == all_types());
    if (std::getenv("CSGRT_SCENES") == nullptr) return;
    const std::string tests = tests_in({"kernels/geometry", "compile/flatten"});
    for (const std::string& type : all_types()) {
        const std::string name = type == "arb8" ? "arb" : type;  // arb4 to arb8 are one
        INFO(name);
        CHECK((tests.find("{\"" + name + "\", oracle::Kind::") != std::string::npos ||
               std::regex_search(tests, std::regex("TEST_CASE\\(\"[^\"]*\\b" + name + "s?\\b"))));
    }
}

TEST_CASE("solid types: an oracle knows each and agrees with what is packed and traced", "[promise:solids]") {
    for (const test::Sample& sample : test::samples) {
        INFO(sample.name);
        oracle::Random random(1);
        const Scene scene = scene_of(R"({"csgrt": 1, "solids": {"s": )" + std::string(sample.solid) + "}}");
        const oracle::SceneOracle oracle(scene);
        Renderer renderer(scene, {}, {.reference = true, .threads = 1});
        const oracle::SceneJudge judge(oracle, renderer.model().regions(), renderer.statistics().tolerance);
        std::size_t hits = 0, ties = 0;
        for (int i = 0; i < 20; ++i) {
            const oracle::QVec d = random.direction(), through = oracle::quad(0.7) * random.in_cube();
            const Ray ray = {oracle::to_vec3(through - oracle::quad(9) * d), oracle::to_vec3(d)};
            const RayPartitions found = renderer.shoot({ray}).front();
            CHECK(judge.judge(ray, found, ties).empty());
            hits += found.partitions.size();
        }
        CHECK(hits > 0);
        CHECK(ties < 10);
    }
}
