// BRL-CAD's own models, which stand beside the checkout, and what is in them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <csgrt/scene.hpp>

#include "catch.hpp"
#include "integration/scenes.hpp"

namespace csgrt::brlcad_test {

/// Objects of each type, and combinations that are regions. Counted in the text databases themselves: in v5 by the
/// third word of the lines that start with put, in v4 by the first letter and the type's number.
struct Model {
    const char* file;
    std::size_t regions;
    std::map<std::string, std::size_t> objects;
};

inline const Model models[] = {
    {"aet", 11, {{"comb", 26}, {"arb8", 7}, {"ell", 3}, {"half", 1}, {"part", 1}, {"tgc", 14}, {"tor", 3}}},
    {"arb8_showcase", 35, {{"comb", 76}, {"arb8", 35}}},
    {"axis", 9, {{"comb", 14}, {"arb8", 11}, {"ell", 2}, {"tgc", 4}, {"tor", 2}}},
    {"bearing", 3, {{"comb", 4}, {"ell", 7}, {"tgc", 15}, {"tor", 11}}},
    {"bicycle_wheel", 5, {{"comb", 309}, {"eto", 2}, {"pipe", 4}, {"tgc", 26}, {"tor", 2}}},
    {"boolean-ops", 7, {{"comb", 8}, {"arb8", 2}, {"tgc", 1}}},
    {"cube", 24, {{"comb", 34}, {"ell", 12}, {"half", 1}, {"tgc", 12}}},
    {"demo", 42, {{"comb", 58}, {"arb8", 42}, {"ell", 2}, {"tgc", 74}}},
    {"goliath", 3, {{"comb", 71}, {"arb8", 80}, {"ell", 1}, {"pipe", 5}, {"tgc", 47}, {"tor", 11}}},
    {"havoc", 305, {{"comb", 521}, {"arb8", 713}, {"ell", 149}, {"tgc", 1508}, {"tor", 59}}},
    {"moss", 6, {{"comb", 7}, {"arb8", 2}, {"ell", 2}, {"tgc", 1}, {"tor", 1}}},
    {"operators", 2, {{"comb", 11}, {"ehy", 1}, {"ell", 1}}},
    {"pawn", 4, {{"comb", 16}, {"arb8", 5}, {"ell", 1}, {"eto", 7}, {"tgc", 10}, {"tor", 6}}},
    {"prim", 0, {{"arb8", 3}, {"ell", 1}, {"tgc", 1}, {"tor", 1}}},
    {"rounds", 4, {{"comb", 8}, {"tgc", 4}, {"tor", 6}}},
    {"shipping_container", 161, {{"comb", 218}, {"arb8", 17}, {"bot", 146}}},
    {"sphflake", 8, {{"comb", 9}, {"ell", 822}, {"half", 1}}},
    {"tank_car", 88, {{"comb", 134}, {"arb8", 265}, {"ell", 10}, {"tgc", 179}, {"tor", 55}}},
    {"terra", 4, {{"comb", 5}, {"arb8", 1}, {"dsp", 2}, {"ell", 2}}},
    {"toyjeep", 61, {{"comb", 103}, {"arb8", 193}, {"ell", 2}, {"pipe", 15}, {"tgc", 60}}},
    {"truck", 179, {{"comb", 182}, {"arb8", 125}, {"ell", 5}, {"tgc", 41}, {"tor", 11}}},
};

inline std::filesystem::path model_folder() { return test::folder("CSGRT_BRLCAD"); }

/// Objects and regions of a scene are those of the model.
inline void check_counts(const Scene& scene, const Model& model) {
    std::map<std::string, std::size_t> objects;
    std::size_t regions = 0;
    for (const Object& object : scene.objects) {
        const auto* combination = std::get_if<Combination>(&object);
        ++objects[combination != nullptr ? "comb" : type_name(std::get<Solid>(object).shape)];
        if (combination != nullptr && combination->region) ++regions;
    }
    CHECK(objects == model.objects);
    CHECK(regions == model.regions);
}

}  // namespace csgrt::brlcad_test
