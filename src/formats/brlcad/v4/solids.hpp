// Solids of BRL-CAD's older text form.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/brlcad/objects.hpp"
#include "formats/brlcad/v4/lines.hpp"

namespace csgrt {

/// Whether a record of that letter is a solid, or a part of one.
bool is_v4_solid(char letter);

/// The object that `line` starts; takes the further lines that belong to it. `name` is set as soon as it is known, also
/// when a Fault leaves.
BrlcadItem read_v4_solid(const Line& line, LineReader& lines, std::string& name);

// Its parts, by family. The record's letter is read, and its name too but for those that set it.
Shape read_v4_bot(Fields& fields, LineReader& lines);
Shape read_v4_pipe(Fields& fields, LineReader& lines);
Shape read_v4_ars(Fields& fields, LineReader& lines, std::string& name);
Shape read_v4_nmg(Fields& fields, LineReader& lines, std::string& name);
Sketch read_v4_sketch(Fields& fields, LineReader& lines);
Shape read_v4_extrude(Fields& fields);

}  // namespace csgrt
