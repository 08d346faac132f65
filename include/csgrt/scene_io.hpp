// Reading and writing scenes.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Reads .json (csgrt's own format, scenes/csgrt.schema.json), .g (BRL-CAD binary, v5) or .asc (BRL-CAD text, v4 and v5),
/// by extension.
/// Throws Error: Status::file if it cannot be read, Status::scene with every finding if it is wrong.
/// The result is syntactically sound; `validate` checks the model.
CSGRT_API Scene load_scene(const std::string& path);

/// Writes the scene as .json; it loads to the same model, bit for bit. Written whole or not at all. "-": standard output.
CSGRT_API void save_scene(const Scene& scene, const std::string& path);

/// Reads the view of a script as MGED's `saveview` writes it and rt reads it: viewsize, orientation (or viewrot, ae, lookat_pt)
/// and eye_pt, and the perspective of rt's option -p. Of several frames the first. Throws Error (file, scene).
CSGRT_API Camera load_view(const std::string& path);

}  // namespace csgrt
