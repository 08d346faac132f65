// Where tests find scenes and models.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace csgrt::test {

inline std::string folder(const char* variable) {
    const char* value = std::getenv(variable);
    return value && std::filesystem::is_directory(value) ? value : "";
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
};

/// The models that the device and the reference must agree on to the last bit.
inline std::vector<Model> models() {
    return {{"boolean-ops.asc", {"all"}},
            {"operators.asc", {"operators"}},
            {"truck.asc", {"g1", "g2", "g4"}},
            {"tank_car.asc", {"tank_car", "track"}},
            {"havoc.asc", {"havoc"}}};
}

}  // namespace csgrt::test
