// Compiling many solids: several threads and batches, the same answer.
#include <cmath>
#include <string>
#include <unordered_map>

#include "bench/parts.hpp"
#include "catch.hpp"
#include "compile/compiled_scene.hpp"
#include "compile/pack_solids.hpp"
#include "sanitized.hpp"

using namespace csgrt;

TEST_CASE("batches of solids give what packing them one by one gives") {
    const Scene scene = bench::scene_of_parts(70'000);  // more than one batch
    const CompiledScene compiled = compile(scene);
    CHECK(compile(scene).hash == compiled.hash);
    if (test::sanitized) return;  // batches have been seen; each solid alone is by other tests

    CompiledScene alone;
    alone.center = compiled.center;
    alone.radius = compiled.radius;
    PlaneTable planes(compiled.center, compiled.radius * std::sqrt(3.0));
    SurfaceTable surfaces(compiled.center, compiled.radius);
    SharedParts shared;
    const FlatScene flat = flatten(scene, {"all"}, false);
    std::unordered_map<std::string, const Instance*> by_name;
    for (const Instance& instance : flat.instances) by_name[name_of(scene.objects[instance.object])] = &instance;
    for (std::size_t i = 0; i < compiled.solids.size(); ++i) {
        const Instance& instance = *by_name.at(compiled.solid_info[i].name);
        pack_solid(shape_of(scene, flat, instance), {}, instance.matrix, compiled.solid_boxes[i], alone, planes,
                   surfaces, shared);
    }
    CHECK(alone.reals == compiled.reals);
    CHECK(alone.plane_refs == compiled.plane_refs);
    CHECK(planes.records().size() == compiled.planes.size());
}
