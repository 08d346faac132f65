// Attributes of BRL-CAD's release 5, in text and in binary databases: keys and values, both texts.
#pragma once

#include <span>
#include <string_view>

#include <csgrt/scene.hpp>

#include "formats/source.hpp"
#include "formats/brlcad/tcl_words.hpp"

namespace csgrt {

/// An attribute's key and value.
struct Attribute {
    std::string_view key;
    TclWord value;
};

/// Sets the combination's member for an attribute's key, in any of BRL-CAD's spellings. False if csgrt does not know
/// the key. Throws Fault.
bool set_attribute(Combination& combination, const Attribute& attribute);

/// Sets all attributes that csgrt knows. If two spellings of one key are given (shader and oshader), the standard
/// spelling counts in any order, as in BRL-CAD. In a lenient scene, wrong attributes are ignored with a warning.
void set_attributes(Combination& combination, std::span<const Attribute> attributes, Findings& findings);

/// Sets the title, the unit or the region colours, which are attributes of the object _GLOBAL. Other keys are ignored.
/// An unknown unit is a warning. Throws Fault.
void set_global_attribute(Scene& scene, const Attribute& attribute, const Source& source);

/// Reads an entry of the colour table: low high red green blue. Throws Fault.
RegionColor read_region_color(std::span<const TclWord, 5> numbers);

}  // namespace csgrt
