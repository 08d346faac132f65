// Attributes of BRL-CAD's release 5, in text and in binary databases: keys and values, both texts.
#pragma once

#include <span>
#include <string_view>

#include <csgrt/scene.hpp>

#include "formats/source.hpp"
#include "formats/brlcad/tcl_words.hpp"

namespace csgrt {

struct Attribute {
    std::string_view key;
    TclWord value;
};

/// Sets what the key stands for, in any of BRL-CAD's spellings; false if it is not one that csgrt knows. Throws Fault.
bool set_attribute(Combination& combination, const Attribute& attribute);

/// Sets all that csgrt knows. Where one thing is given in two spellings (shader and oshader), the standard one holds,
/// whatever their order, as in BRL-CAD. What is wrong with one is borne, if `findings` can; the others hold.
void set_attributes(Combination& combination, std::span<const Attribute> attributes, Findings& findings);

/// Sets the title, the unit or the region colours, which _GLOBAL, the database itself, has as attributes; other keys
/// are passed over. A unit that is none is a warning. Throws Fault.
void set_global_attribute(Scene& scene, const Attribute& attribute, const Source& source);

/// An entry of the colour table: low high red green blue. Throws Fault.
RegionColor read_region_color(std::span<const TclWord, 5> numbers);

}  // namespace csgrt
