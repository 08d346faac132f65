// Tables of densities, as BRL-CAD's gqa and rtweight read them.
#pragma once

#include <string>
#include <vector>

#include <csgrt/scene.hpp>

#include "formats/text_source.hpp"

namespace csgrt {

/// The object of a database that is its table.
inline constexpr const char* densities_name = "_DENSITIES";

/// Reads the lines of a table. Wrong lines are left out and appended to `warnings`, or, if this is null, throw Error
/// (scene). `object`: the name in warnings.
std::vector<Density> read_densities(const TextSource& source, const std::string& object,
                                    std::vector<Warning>* warnings);

}  // namespace csgrt
