// Binary databases of BRL-CAD's release 5.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

class ByteSource;

/// Reads a .g file. Throws Error (file) if the file cannot be read, Error (scene) with every finding if it is wrong,
/// and Error (out_of_memory). Solids of types that csgrt does not know become Unsupported. Findings give the byte and
/// the object. `lenient`: the opposite of LoadOptions::strict. `file_folders`: see LoadOptions.
Scene read_brlcad_g(const std::string& path, bool lenient = false, const std::vector<std::string>& file_folders = {});

/// Whether these bytes begin a binary database, of release 5 or 4.
bool is_brlcad_g(std::string_view bytes);

/// Reads a database in memory.
Scene parse_brlcad_g(const ByteSource& source, bool lenient = false);

}  // namespace csgrt
