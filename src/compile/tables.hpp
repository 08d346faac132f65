// Tables of a compiled scene, in the form that the kernels' geometry reads.
#pragma once

#include "base/laboratory.hpp"
#include "compile/compiled_scene.hpp"
#include "kernel_host/geometry.hpp"

namespace csgrt {

inline kernel::Geometry tables(const CompiledScene& scene, Quartic quartic = Quartic::bracketed) {
    return {scene.solids.data(), scene.reals.data(),       scene.planes.data(),
            scene.words.data(),  scene.inner_nodes.data(), static_cast<kernel::u32>(quartic)};
}

}  // namespace csgrt
