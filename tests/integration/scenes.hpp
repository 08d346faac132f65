// Where tests find scenes and models.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "catch.hpp"

namespace csgrt::test {

/// The folder that an environment's variable names; empty, with a word, if there is none.
inline std::string folder(const char* variable) {
    const char* value = std::getenv(variable);
    if (value && std::filesystem::is_directory(value)) return value;
    WARN("skipped: " << variable << " names no folder");
    return "";
}

/// Every .json scene in CSGRT_SCENES, sorted; the schema is none.
inline std::vector<std::string> scene_files() {
    std::vector<std::string> files;
    const std::string scenes = folder("CSGRT_SCENES");
    if (scenes.empty()) return files;
    for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
        const std::string path = entry.path().string();
        if (path.ends_with(".json") && !path.ends_with("schema.json")) files.push_back(path);
    }
    std::sort(files.begin(), files.end());
    return files;
}

struct Model {
    std::string file;
    std::vector<std::string> objects;
    bool main = false;  ///< one of those that every method is tried on first
};

/// BRL-CAD's sample models, and what to draw of them.
inline std::vector<Model> models() {
    return {{"boolean-ops.asc", {"all"}, true},
            {"operators.asc", {"operators"}, true},
            {"truck.asc", {"g1", "g2", "g4"}, true},
            {"tank_car.asc", {"tank_car", "track"}, true},
            {"havoc.asc", {"havoc"}, true},
            {"goliath.asc", {"Goliath.c"}},
            {"aet.asc", {"rings.c", "diagram.r"}},
            {"arb8_showcase.asc", {"arb8_showcase"}},
            {"axis.asc", {"all"}},
            {"bearing.asc", {"bearing"}},
            {"bicycle_wheel.asc", {"rwheel"}},
            {"cube.asc", {"all.g"}},
            {"demo.asc", {"track.rt", "track.lt", "widgets", "crod", "BRL"}},
            {"moss.asc", {"all.g"}},
            {"pawn.asc", {"scene.g"}},
            {"prim.asc", {"ellg", "arb8", "arb7", "arb5", "tor", "tgc"}},
            {"rounds.asc", {"all.g"}},
            {"shipping_container.asc", {"all"}},
            {"sphflake.asc", {"scene.r"}},
            {"terra.asc", {"all.g"}},
            {"toyjeep.asc", {"all"}}};
}

/// The same with their paths; none if there is no folder of them. `few`: the main ones, and the goliath.
inline std::vector<Model> models_there(bool few = false) {
    const std::string models_folder = folder("CSGRT_BRLCAD");
    std::vector<Model> there;
    for (Model& model : models()) {
        if (models_folder.empty() || (few && !model.main && model.file != "goliath.asc")) continue;
        there.push_back({models_folder + "/" + model.file, model.objects, model.main});
    }
    return there;
}

}  // namespace csgrt::test
