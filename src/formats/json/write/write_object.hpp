// Conversion of solids, combinations and looks to JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include <csgrt/scene.hpp>

namespace csgrt {

class JsonUnit;

/// {"type": ...}, with a simple type if this reads back to the same bits.
nlohmann::ordered_json json_of(const Shape& shape, JsonUnit& unit);

/// The name of a leaf's object, or {"object": ...} with its position.
nlohmann::ordered_json json_of(const TreeNode& leaf, JsonUnit& unit);

/// {"tree": ...}, with the attributes that differ from their defaults. Sets `fault` if the nodes do not form a tree.
nlohmann::ordered_json json_of(const Combination& combination, JsonUnit& unit, std::string& fault);

/// {"path": ..., "material": ..., "state": ...}
nlohmann::ordered_json json_of(const Look& look, JsonUnit& unit);

}  // namespace csgrt
