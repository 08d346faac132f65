// Solids of BRL-CAD's newer text form: put name type key value key value ...
#pragma once

#include <span>

#include <csgrt/scene.hpp>

#include "formats/tcl_words.hpp"

namespace csgrt {

/// The solid of that type with those keys and values; types that csgrt does not know are Unsupported, their values
/// unread. Throws Fault for keys that are missing, unknown or given twice, and for values that are no numbers.
Shape read_v5_solid(const TclWord& type, std::span<const TclWord> keys_and_values, TclStore& store);

}  // namespace csgrt
