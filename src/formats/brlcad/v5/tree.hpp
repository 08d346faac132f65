// Trees (Boolean) of BRL-CAD's newer text form: {u {l a} {- {l b} {l c {matrix}}}}.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

#include "formats/brlcad/tcl_words.hpp"

namespace csgrt {

/// Reads the tree of a word; an empty word is the empty tree. A node is `l name`, `l name matrix`, or an operator and
/// its operands, each in braces: two for u (union), n or + (intersection), - and ^ (xor), one for !. Throws Fault. It
/// needs no stack, however deep the tree is. `object`: the combination's name, for the places of the nodes.
Tree read_v5_tree(const TclWord& word, const TextSource& source, const std::string& object, TclStore& store);

}  // namespace csgrt
