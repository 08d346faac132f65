// Solids of BRL-CAD's older text form.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/brlcad/objects.hpp"
#include "formats/brlcad/v4/lines.hpp"

namespace csgrt {

/// Whether a record of this letter is a solid, or a part of one.
bool is_v4_solid(char letter);

/// Reads the object that `line` starts, and takes its other lines. `name` is set as soon as it is known, also when a
/// Fault is thrown.
BrlcadItem read_v4_solid(const Line& line, LineReader& lines, std::string& name);

// Readers of single types, by family. The record's letter is read already, and its name, except by those that set it.
Shape read_v4_bot(Fields& fields, LineReader& lines);
Shape read_v4_pipe(Fields& fields, LineReader& lines);
Shape read_v4_ars(Fields& fields, LineReader& lines, std::string& name);
Shape read_v4_nmg(Fields& fields, LineReader& lines, std::string& name);
Sketch read_v4_sketch(Fields& fields, LineReader& lines);
Shape read_v4_extrude(Fields& fields);

}  // namespace csgrt
