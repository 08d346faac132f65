// Solids and other objects of BRL-CAD's newer text form, except combinations: put name type key value key value ...
#pragma once

#include <span>

#include <csgrt/scene.hpp>

#include "formats/brlcad/objects.hpp"
#include "formats/brlcad/v5/parameters.hpp"
#include "formats/brlcad/tcl_words.hpp"

namespace csgrt {

/// Reads an object of a type with keys and values. Solids of types that csgrt does not know become Unsupported, and
/// their values are not read. Throws Fault for keys that are missing, unknown or given twice, and for values that are
/// not numbers.
BrlcadItem read_v5_object(const TclWord& type, std::span<const TclWord> keys_and_values, TclStore& store);

// Readers of single types, by family.
Shape read_v5_bot(Parameters& p);
Shape read_v5_ars(Parameters& p);
Shape read_v5_nmg(Parameters& p);
Shape read_v5_pipe(Parameters& p);
Shape read_v5_metaball(Parameters& p);
BrlcadItem read_v5_ebm(Parameters& p);
BrlcadItem read_v5_vol(Parameters& p);
BrlcadItem read_v5_dsp(Parameters& p);
BrlcadNumbers read_v5_numbers(Parameters& p);
Sketch read_v5_sketch(Parameters& p);
Shape read_v5_extrude(Parameters& p);
Shape read_v5_revolve(Parameters& p);

}  // namespace csgrt
