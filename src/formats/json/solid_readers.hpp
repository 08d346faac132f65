// One function a type of solid, each for the object that has the form of that name.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/json/node.hpp"

namespace csgrt {

// json_solids_curved.cpp
Shape read_json_part(const JsonObject& o);
Shape read_json_epa(const JsonObject& o);
Shape read_json_rpc(const JsonObject& o);
Shape read_json_rhc(const JsonObject& o);
Shape read_json_eto(const JsonObject& o);
Shape read_json_hyp(const JsonObject& o);
Shape read_json_superell(const JsonObject& o);
Shape read_json_hrt(const JsonObject& o);
Shape read_json_metaball(const JsonObject& o);
Shape read_json_pipe(const JsonObject& o);
Shape read_json_cline(const JsonObject& o);

// json_solids_meshes.cpp
Shape read_json_bot(const JsonObject& o);
Shape read_json_ars(const JsonObject& o);
Shape read_json_nmg(const JsonObject& o);

// json_solids_cells.cpp
Shape read_json_ebm(const JsonObject& o);
Shape read_json_vol(const JsonObject& o);
Shape read_json_dsp(const JsonObject& o);

// json_solids_sketches.cpp
Shape read_json_extrude(const JsonObject& o);
Shape read_json_revolve(const JsonObject& o);

}  // namespace csgrt
