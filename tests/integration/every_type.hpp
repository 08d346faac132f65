// A scene with a solid of every type in it. What a device's compiler takes for a program hangs little on the types in
// it, so tests of many scenes give all of them one program; those of our own scenes have one for each set of types.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "compile/compiled_scene.hpp"
#include "compile/linear.hpp"
#include "integration/scenes.hpp"

namespace csgrt::test {

/// `scene`, and five of our own scenes that have a solid of every type between them, in a row at the middle of
/// `objects` (empty: of the top objects) and a tenth as wide. `objects` gets their name. Empty CSGRT_SCENES: nothing is
/// added.
inline Scene with_every_type(Scene scene, std::vector<std::string>& objects) {
    const std::string folder = test::folder("CSGRT_SCENES");
    if (folder.empty()) return scene;
    if (objects.empty()) objects = top_objects(scene);
    const auto middle = [](const Box& box) {
        return Vec3{(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2, (box.low.z + box.high.z) / 2};
    };
    const Box box = compile(scene, objects).bounds;
    const double width = diagonal(box) / 50;
    int place = -2;

    Combination all{.name = "every type"};
    // No scene of ours has one.
    const double reach = width / 4;
    const std::string crossed = all.name + "/crossed eto";
    scene.objects.emplace_back(
        Solid{crossed, Eto{middle(box), {0, 0, 1}, {0.9 * reach, 0, 0.9 * reach}, reach, 0.8 * reach}, {}});
    all.tree.nodes.push_back({Operator::leaf, 0, crossed, identity, {}});
    // One that ends with the model is a polyhedron: this has no end, far below all else.
    const std::string half = all.name + "/half";
    scene.objects.emplace_back(Solid{half, Half{{{0, 0, 1}, box.low.z - 10 * diagonal(box)}}, {}});
    all.tree.nodes.push_back({Operator::leaf, 0, half, identity, {}});
    for (const char* name : {"solids", "quadrics", "blobs", "meshes", "sketches"}) {
        const Scene own = load_scene(folder + "/" + name + ".json");
        const std::string before = all.name + "/" + name + "/";
        const Box own_box = compile(own).bounds;
        const double size = width / diagonal(own_box);
        const Vec3 from = middle(own_box), to = middle(box);
        const Matrix placed = {size, 0,    0,    to.x - size * from.x + place++ * width,
                               0,    size, 0,    to.y - size * from.y,
                               0,    0,    size, to.z - size * from.z,
                               0,    0,    0,    1};
        for (const std::string& top : top_objects(own))
            all.tree.nodes.push_back({Operator::leaf, 0, before + top, placed, {}});
        for (Object object : own.objects) {
            if (Combination* combination = std::get_if<Combination>(&object)) {
                combination->name.insert(0, before);
                for (TreeNode& node : combination->tree.nodes)
                    if (node.op == Operator::leaf) node.object.insert(0, before);
            } else {
                std::get<Solid>(object).name.insert(0, before);
            }
            scene.objects.push_back(std::move(object));
        }
    }
    all.tree.nodes.push_back({Operator::union_, static_cast<std::uint32_t>(all.tree.nodes.size()), "", identity, {}});
    objects.push_back(all.name);
    scene.objects.push_back(std::move(all));
    return scene;
}

/// What an OpenCL compiler takes for each program is most of the time of a test of many scenes, so a scene has its own
/// only if it brings three types of solids or more that no program before had; the others share that of every type.
class FewPrograms {
public:
    /// `scene` itself, or with every type; then `objects` gets more (with_every_type).
    Scene of(Scene scene, std::vector<std::string>& objects) {
        const std::uint32_t types = compile(scene, objects).solid_types;
        if (std::popcount(types & ~seen_) < 3) return with_every_type(std::move(scene), objects);
        seen_ |= types;
        ++own_;
        return scene;
    }
    int own() const { return own_; }  ///< scenes that have their own

private:
    std::uint32_t seen_ = 0;
    int own_ = 0;
};

}  // namespace csgrt::test
