// Trees (Boolean) of BRL-CAD's binary databases: the body of a combination.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

#include "formats/brlcad/g/object.hpp"

namespace csgrt {

/// Reads the tree of a body. Throws Fault. `object`: the combination's name, for the places of the nodes.
Tree read_g_tree(const GBlock& body, const ByteSource& source, const std::string& object);

}  // namespace csgrt
