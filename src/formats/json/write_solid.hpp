// One solid as JSON, for the files that write them by family.
#pragma once

#include <nlohmann/json.hpp>

#include <csgrt/scene.hpp>

#include "formats/json/unit.hpp"
#include "formats/json/write_object.hpp"

namespace csgrt {

struct SolidToJson {
    JsonUnit& unit;

    // json_write_solid.cpp: planes, quadrics and the torus
    nlohmann::ordered_json operator()(const Ell& s) const;
    nlohmann::ordered_json operator()(const Tgc& s) const;
    nlohmann::ordered_json operator()(const Arb& s) const;
    nlohmann::ordered_json operator()(const Arbn& s) const;
    nlohmann::ordered_json operator()(const Half& s) const;
    nlohmann::ordered_json operator()(const Tor& s) const;
    nlohmann::ordered_json operator()(const Ehy& s) const;
    nlohmann::ordered_json operator()(const Unsupported& s) const;

    // json_write_curved.cpp
    nlohmann::ordered_json operator()(const Part& s) const;
    nlohmann::ordered_json operator()(const Epa& s) const;
    nlohmann::ordered_json operator()(const Rpc& s) const;
    nlohmann::ordered_json operator()(const Rhc& s) const;
    nlohmann::ordered_json operator()(const Eto& s) const;
    nlohmann::ordered_json operator()(const Hyp& s) const;
    nlohmann::ordered_json operator()(const Superell& s) const;
    nlohmann::ordered_json operator()(const Hrt& s) const;
    nlohmann::ordered_json operator()(const Metaball& s) const;
    nlohmann::ordered_json operator()(const Pipe& s) const;
    nlohmann::ordered_json operator()(const Cline& s) const;

    // json_write_meshes.cpp
    nlohmann::ordered_json operator()(const Bot& s) const;
    nlohmann::ordered_json operator()(const Ars& s) const;
    nlohmann::ordered_json operator()(const Nmg& s) const;

    // json_write_cells.cpp
    nlohmann::ordered_json operator()(const Ebm& s) const;
    nlohmann::ordered_json operator()(const Vol& s) const;
    nlohmann::ordered_json operator()(const Dsp& s) const;

    // json_write_sketches.cpp
    nlohmann::ordered_json operator()(const Extrude& s) const;
    nlohmann::ordered_json operator()(const Revolve& s) const;

    nlohmann::ordered_json plane(const Plane& plane) const;
    nlohmann::ordered_json places(const std::vector<Vec3>& points) const;
};

}  // namespace csgrt
