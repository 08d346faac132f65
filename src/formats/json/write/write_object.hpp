// Objects as JSON: one solid, one combination.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include <csgrt/scene.hpp>

namespace csgrt {

class JsonUnit;

/// {"type": ...}: a simple type if it reads back to the same bits.
nlohmann::ordered_json json_of(const Shape& shape, JsonUnit& unit);

/// {"tree": ...} with the attributes that differ from their defaults. Sets `fault` if the tree is not a tree.
nlohmann::ordered_json json_of(const Combination& combination, JsonUnit& unit, std::string& fault);

/// {"path": ..., "material": ..., "state": ...}
nlohmann::ordered_json json_of(const Look& look, JsonUnit& unit);

}  // namespace csgrt
