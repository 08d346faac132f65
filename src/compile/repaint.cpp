#include "compile/repaint.hpp"

#include "compile/hash.hpp"
#include "compile/regions/path_table.hpp"
#include "scene/nearest.hpp"

namespace csgrt {

std::vector<std::uint32_t> regions_at(const CompiledScene& scene, const std::string& path) {
    std::vector<std::uint32_t> found = LatePathTable::find(scene, path);
    if (!found.empty()) return found;
    std::vector<std::string_view> known;
    for (const RegionInfo& region : scene.region_info) known.push_back(region.path);
    throw Error(Status::usage, {Diagnostic{.message = "the model has no region at '" + path + "', nor below it",
                                           .suggestion = did_you_mean(path, known)}});
}

CompiledScene repainted(const CompiledScene& before, const std::vector<Look>& looks, const SceneAppearance& all) {
    CompiledScene made = before;
    std::vector<std::uint32_t> changed;
    for (const Look& look : looks)
        for (const std::uint32_t i : regions_at(made, look.path)) {
            const RegionInfo& known = made.region_info[i];
            if (look.state && *look.state != known.state) {
                made.region_info.own(i).state = *look.state;
                made.set_state(i, *look.state);
            }
            if (!look.finish && (!look.color || *look.color == known.color)) continue;
            RegionInfo& region = made.region_info.own(i);
            if (look.color) region.color = *look.color;
            if (look.finish) region.finish = *look.finish;
            changed.push_back(i);
        }
    static_cast<Appearance&>(made) = appearance_of(all, made.region_info, made.region_lights, before, changed);
    made.hash = hash_of(made);
    return made;
}

}  // namespace csgrt
