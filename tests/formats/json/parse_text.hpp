// Scenes as text for tests.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

#include "formats/json/reader.hpp"
#include "formats/text_source.hpp"
#include "thrown.hpp"

namespace csgrt {

inline Scene scene_of(const std::string& text) { return parse_json_scene(TextSource("scene.json", text)); }

/// The findings that a text gives; none if it is sound.
inline std::vector<Diagnostic> findings_of(const std::string& text) {
    return test::thrown_by([&] { scene_of(text); }).findings;
}

/// The shape of one solid that is written in millimetres, or in another unit.
inline Shape shape_of(const std::string& solid, const std::string& unit = "mm") {
    const Scene scene = scene_of(R"({"csgrt": 1, "units": ")" + unit + R"(", "solids": {"s": )" + solid + "}}");
    return std::get<Solid>(scene.objects.at(0)).shape;
}

/// The tree of one combination. The objects need not exist for reading.
inline Tree tree_of(const std::string& tree, const std::string& unit = "mm") {
    const Scene scene =
        scene_of(R"({"csgrt": 1, "units": ")" + unit + R"(", "combinations": {"c": {"tree": )" + tree + "}}}");
    return std::get<Combination>(scene.objects.at(0)).tree;
}

}  // namespace csgrt
