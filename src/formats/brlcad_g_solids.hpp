// Solids of BRL-CAD's binary databases: numbers in a fixed order.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/brlcad_g_object.hpp"

namespace csgrt {

/// The solid that a body holds; `minor` is its type's number. Types that csgrt does not know are Unsupported, their
/// bodies unread. Throws Fault.
Shape read_g_solid(int minor, const GBlock& body);

}  // namespace csgrt
