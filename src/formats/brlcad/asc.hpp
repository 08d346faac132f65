// Text databases of BRL-CAD, as g2asc writes them.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt {

class TextSource;

/// Reads an .asc file, v4 or v5. Throws Error (file) if the file cannot be read, Error (scene) with every finding if it
/// is wrong, and Error (out_of_memory). Solids of types that csgrt does not know become Unsupported. `lenient`: the
/// opposite of LoadOptions::strict. `file_folders`: see LoadOptions.
Scene read_brlcad_asc(const std::string& path, bool lenient = false, const std::vector<std::string>& file_folders = {});

/// Reads a text in memory: v5 if it starts with a Tcl command, else v4.
Scene parse_brlcad_asc(const TextSource& source, bool lenient = false);

/// Reads databases of release 4 and older: each line is a record, whose first letter is its kind.
Scene parse_brlcad_asc_v4(const TextSource& source, bool lenient = false);

/// Reads databases of release 5 and newer: Tcl commands (title, units, color, put, attr).
Scene parse_brlcad_asc_v5(const TextSource& source, bool lenient = false);

}  // namespace csgrt
