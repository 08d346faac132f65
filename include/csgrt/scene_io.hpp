// Reading and writing scenes.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Reads .json (csgrt's own format, scenes/csgrt.schema.json), .g (BRL-CAD binary, v5) or .asc (BRL-CAD text, v4 and v5),
/// by extension. "-" is standard input: of it, and of devices and pipes, the first bytes tell the format.
/// Throws Error: Status::file if it cannot be read, Status::scene with every finding if it is wrong.
/// The result is syntactically sound; `validate` checks the model.
CSGRT_API Scene load_scene(const std::string& path);

/// The same for the bytes of a file, whose first tell the format. Errors call it `name`, and files that an ebm, vol or dsp
/// names are relative to that name's folder.
CSGRT_API Scene parse_scene(std::string bytes, const std::string& name);

/// Writes the scene as .json; it loads to the same model, bit for bit. Written whole or not at all. "-": standard output.
CSGRT_API void save_scene(const Scene& scene, const std::string& path);

}  // namespace csgrt
