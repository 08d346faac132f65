// Solids of BRL-CAD's older text form.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/brlcad/objects.hpp"
#include "formats/brlcad/v4/lines.hpp"

namespace csgrt {

/// Whether records with this letter are solids or parts of solids.
bool is_v4_solid(char letter);

/// Reads the object whose first line is `line`, and takes its other lines. Sets `name` as soon as it is known, also if
/// a Fault is thrown later.
BrlcadItem read_v4_solid(const Line& line, LineReader& lines, std::string& name);

// Readers of single types, by family. The record's letter is already read. So is its name, except for functions with
// the parameter `name`.
Shape read_v4_bot(Fields& fields, LineReader& lines);
Shape read_v4_pipe(Fields& fields, LineReader& lines);
Shape read_v4_ars(Fields& fields, LineReader& lines, std::string& name);
Shape read_v4_nmg(Fields& fields, LineReader& lines, std::string& name);
Sketch read_v4_sketch(Fields& fields, LineReader& lines);
Shape read_v4_extrude(Fields& fields);

}  // namespace csgrt
