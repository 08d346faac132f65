// Reading and writing scenes.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Reads .json (csgrt's own format, scenes/csgrt.schema.json), .g (BRL-CAD binary, v5) or .asc (BRL-CAD text, v4 and v5),
/// by extension. "-" is standard input: of it, and of devices and pipes, the first bytes tell the format.
/// BRL-CAD's databases are lenient scenes: an object that cannot be read is an Unsupported solid, with the reason, and other
/// faults are in `warnings`. `strict`: they are read as .json always is, and refused if anything is wrong.
/// Throws Error: Status::file if it cannot be read, Status::scene with every finding if it is wrong.
/// The result is syntactically sound; `validate` checks the model.
CSGRT_API Scene load_scene(const std::string& path, bool strict = false);

/// The same for the bytes of a file, whose first tell the format. Errors call it `name`, and files that an ebm, vol or dsp
/// names are relative to that name's folder.
CSGRT_API Scene parse_scene(std::string bytes, const std::string& name, bool strict = false);

/// Writes the scene as .json; it loads to the same model, bit for bit. Written whole or not at all. "-": standard output.
CSGRT_API void save_scene(const Scene& scene, const std::string& path);

/// Reads the view of a script as MGED's `saveview` writes it and rt reads it: viewsize, orientation (or viewrot, ae, lookat_pt)
/// and eye_pt, and the perspective of rt's option -p. Of several frames the first. Throws Error (file, scene).
CSGRT_API Camera load_view(const std::string& path);

}  // namespace csgrt
