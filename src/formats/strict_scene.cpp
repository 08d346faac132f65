#include "formats/strict_scene.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "scene/names.hpp"
#include "scene/faults/validate.hpp"

namespace csgrt {

namespace {

Combination empty_combination(std::string name, Place place = {}) {
    Combination combination;
    combination.name = std::move(name);
    combination.place = std::move(place);
    return combination;
}

bool is_of_unknown_type(const Object& object) {
    const auto* solid = std::get_if<Solid>(&object);
    const auto* shape = solid == nullptr ? nullptr : std::get_if<Unsupported>(&solid->shape);
    return shape != nullptr && shape->reason.empty();
}

}  // namespace

Scene strict_scene(const Scene& scene) {
    Names names(scene);
    std::vector<Warning> warnings;
    validate(scene, names, {}, false, warnings);
    // The empty combination `hole` replaces members whose objects exist, but which close a cycle or whose matrices are
    // not transforms.
    std::string hole = "left_out";
    while (names.find(hole) != Names::none) hole += "_";
    Scene result = scene;
    std::unordered_set<std::string> needed;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (names.kind(i) == Names::Kind::left_out && !is_of_unknown_type(scene.objects[i])) {
            result.objects[i] = empty_combination(name_of(scene.objects[i]), place_of(scene.objects[i]));
            continue;
        }
        auto* combination = std::get_if<Combination>(&result.objects[i]);
        if (combination == nullptr) continue;
        for (std::size_t k = 0; k < combination->tree.nodes.size(); ++k) {
            if (names.child(i, k) != Names::left_out) continue;
            TreeNode& member = combination->tree.nodes[k];
            if (names.find(member.object) != Names::none) member.object = hole;
            member.matrix = identity;
            needed.insert(member.object);
        }
    }
    std::vector<std::string> sorted(needed.begin(), needed.end());
    std::sort(sorted.begin(), sorted.end());
    for (std::string& name : sorted) result.objects.emplace_back(empty_combination(std::move(name)));
    return result;
}

}  // namespace csgrt
