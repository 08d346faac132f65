// Solids and other objects of BRL-CAD's binary databases, except combinations: numbers in a fixed order.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/brlcad/g/object.hpp"
#include "formats/brlcad/objects.hpp"

namespace csgrt {

/// The object that a body holds; `minor` is its type's number. Solids of types that csgrt does not know are
/// Unsupported, their bodies unread. Throws Fault.
BrlcadItem read_g_solid(int minor, const GBlock& body);
/// BRL-CAD's name of a type, or its number.
std::string g_type_name(int minor);

// Readers of single types, by family.
Shape read_g_bot(ByteReader& bytes);
Shape read_g_ars(ByteReader& bytes);
Shape read_g_nmg(ByteReader& bytes);
Shape read_g_pipe(ByteReader& bytes);
Shape read_g_metaball(ByteReader& bytes);
BrlcadItem read_g_ebm(ByteReader& bytes);
BrlcadItem read_g_vol(ByteReader& bytes);
BrlcadItem read_g_dsp(ByteReader& bytes);
Sketch read_g_sketch(ByteReader& bytes);
Shape read_g_extrude(ByteReader& bytes);
Shape read_g_revolve(ByteReader& bytes);

}  // namespace csgrt
