// Whether a Model that edits made is the Model that is compiled from its scene.
#pragma once

#include <csgrt/edit.hpp>

#include "base/identical.hpp"
#include "catch.hpp"
#include "integration/lists.hpp"
#include "integration/same_answers.hpp"

namespace csgrt::test {

inline View small_view(const Scene& scene) {
    View view{.width = 40, .height = 30, .camera = scene.camera};
    view.channels |= channel::ghosts;
    return view;
}

/// Regions, solids, tables (by their hash), pictures and partitions of both are the same.
inline void require_same_models(const csgrt::Model& edited, const csgrt::Model& fresh) {
    REQUIRE(edited.regions().size() == fresh.regions().size());
    for (std::size_t i = 0; i < fresh.regions().size(); ++i) {
        const RegionInfo &region = edited.regions()[i], &other = fresh.regions()[i];
        REQUIRE(region.path == other.path);
        REQUIRE(region.color == other.color);
        REQUIRE(region.state == other.state);
        REQUIRE(same_bits(region.bounds, other.bounds));
    }
    REQUIRE(edited.solids().size() == fresh.solids().size());
    for (std::size_t i = 0; i < fresh.solids().size(); ++i) REQUIRE(edited.solids()[i].name == fresh.solids()[i].name);
    REQUIRE(edited.warnings().size() == fresh.warnings().size());
    Renderer a(edited, on_native_device()), b(fresh, on_native_device());
    View view = small_view(edited.scene());
    for (const bool every_partition : {true, false}) {
        view.every_partition = every_partition;
        const Image one = a.render(view), other = b.render(view);
        require_same(one, other);
        REQUIRE(one.attributes.at("csgrt:scene_hash") == other.attributes.at("csgrt:scene_hash"));
    }
    const std::vector<Ray> rays = random_rays(fresh.bounds(), 60);
    for (const bool hidden : {true, false}) {
        Partitions one, other;
        Fields fields = all_fields;
        fields.hidden = hidden;
        a.partitions(rays, one, fields);
        b.partitions(rays, other, fields);
        require_same(one, other);
    }
}

inline void require_compiled_anew(const csgrt::Model& edited) {
    require_same_models(edited, csgrt::Model(edited.scene()));
}

}  // namespace csgrt::test
