// Reading and writing scenes.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

/// Options for reading a scene.
struct LoadOptions {
    /// A BRL-CAD database in which anything is missing or broken is refused, as a .json always is.
    bool strict = false;
    /// Folders below which the scene may name files (the cells of an ebm, vol or dsp), besides its own. Links and `..`
    /// are resolved first.
    std::vector<std::string> file_folders = {};
};

/// Reads a scene file. Its extension gives the format: .json (csgrt's own format, scenes/csgrt.schema.json), .g
/// (BRL-CAD binary, v5) or .asc (BRL-CAD text, v4 and v5). For "-", which is standard input, and for devices and pipes,
/// the first bytes give the format. Lengths are converted to millimetres.
///
/// BRL-CAD's databases become lenient scenes, unless they are read strictly: an object that cannot be read becomes an
/// Unsupported solid, with the reason, and other faults become Scene::warnings. A file of cells that the scene may not
/// name is such a fault, whether the file exists or not.
///
/// Throws Error (file) if the file cannot be read, Error (scene) with every error if its text is invalid, and Error
/// (out_of_memory). validate() checks the model itself. Any thread.
CSGRT_API Scene load_scene(const std::string& path, const LoadOptions& options = {});

/// Reads a scene from the bytes of a file; the first bytes give the format. Errors call the file `name`. If the scene
/// names files of cells (of an ebm, vol or dsp), their names are relative to the folder of `name`, and they must be
/// below LoadOptions::file_folders. The same holds for standard input, devices and pipes. Throws as load_scene() does.
/// Any thread.
CSGRT_API Scene parse_scene(std::string bytes, const std::string& name, const LoadOptions& options = {});

/// Writes a scene as .json. Reading it gives the same model, bit for bit. The file has a temporary name until it is
/// complete. "-" is standard output. Throws Error: file, or scene if an object cannot be expressed. Any thread.
CSGRT_API void save_scene(const Scene& scene, const std::string& path);

/// A solid as an object of JSON, as scenes have it: {"type": "tor", "center": [0, 0, 0], ...}, in millimetres. Throws
/// Error (scene) for a solid with numbers that are not finite. Any thread.
CSGRT_API std::string json_text(const Shape& shape);

/// Reads the view from a script that MGED's `saveview` wrote, as rt reads it: viewsize, orientation (or viewrot, ae,
/// lookat_pt) and eye_pt, and the perspective of rt's option -p. Of several frames, the first one counts. Throws Error
/// (file, scene). Any thread.
CSGRT_API Camera load_view(const std::string& path);

}  // namespace csgrt
