// Each file of scenes/broken gives the findings that expected.txt lists for it, and no others.
#include "catch.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <csgrt/scene_io.hpp>

using namespace csgrt;

namespace {

struct Expected {
    int status = 0;
    std::string place;  // line:column
    std::string text;   // part of the message or of what it suggests
};

/// Lines of "FILE STATUS LINE:COLUMN TEXT".
std::map<std::string, std::vector<Expected>> read_expectations(const std::filesystem::path& path) {
    std::map<std::string, std::vector<Expected>> expectations;
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        std::string name;
        Expected expected;
        words >> name >> expected.status >> expected.place >> std::ws;
        std::getline(words, expected.text);
        REQUIRE_FALSE(expected.text.empty());
        expectations[name].push_back(expected);
    }
    return expectations;
}

}  // namespace

TEST_CASE("broken scenes: each gives its findings at their places", "[promise:refusals]") {
    const char* scenes = std::getenv("CSGRT_SCENES");
    if (scenes == nullptr) {
        WARN("CSGRT_SCENES is not set: the broken scenes are not read");
        return;
    }
    const auto folder = std::filesystem::path(scenes) / "broken";
    auto expectations = read_expectations(folder / "expected.txt");
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() == ".txt") continue;
        INFO(name);
        REQUIRE(expectations.count(name) == 1);
        int status = static_cast<int>(Status::scene);
        std::vector<Diagnostic> found;
        try {
            found = validate(load_scene(entry.path().string(), {.strict = true}));
        } catch (const Error& error) {
            status = static_cast<int>(error.status());
            found = error.diagnostics();
        }
        const std::vector<Expected> expected = std::move(expectations[name]);
        expectations.erase(name);
        REQUIRE(found.size() == expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            INFO(format(found[i]));
            CHECK(status == expected[i].status);
            CHECK(found[i].place.file == entry.path().string());
            CHECK(std::to_string(found[i].place.line) + ":" + std::to_string(found[i].place.column) ==
                  expected[i].place);
            CHECK((found[i].message + "; " + found[i].suggestion).find(expected[i].text) != std::string::npos);
            CHECK_FALSE(found[i].excerpt.empty());
        }
    }
    for (const auto& [name, expected] : expectations)
        FAIL_CHECK("expected.txt names " << name << ", which does not exist");
}
