// A scene's regions as meshes: solids -> meshes, and their Booleans by Manifold.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "facets.hpp"
#include "method.hpp"

namespace csgrt::bench {

/// Regions as meshes, in the compiled scene's order, and what they took.
struct RegionMeshes {
    std::vector<Triangles> regions;
    double seconds = 0, cpu_seconds = 0;  ///< to make them: by the clock, of processors
    double megabytes = 0;                 ///< the most at a time
    std::size_t triangles = 0;
};

/// To the chord error that is the knob, from the folder where they are kept (CSGRT_MESHES, else one beside other
/// temporary files), or made by the Python that has manifold3d (CSGRT_PYTHON, else python3) and kept there. Throws
/// Error (usage), with words: a solid that cannot be a mesh, too many triangles, too much time or memory.
RegionMeshes region_meshes(const Subject& subject, const TraceOptions& options);

/// Throws Error (usage).
[[noreturn]] void refuse_meshes(const std::string& why);

}  // namespace csgrt::bench
