// Trees (Boolean) of BRL-CAD's newer text form: {u {l a} {- {l b} {l c {matrix}}}}.
#pragma once

#include <string>

#include <csgrt/scene.hpp>

#include "formats/brlcad/tcl_words.hpp"

namespace csgrt {

/// Reads the tree in a word; an empty word is the empty tree. A node is `l name`, `l name matrix`, or an operator with
/// operands in braces: u (union), n or + (intersection), - and ^ (xor) have two, ! has one. Throws Fault. The function
/// is not recursive, so a deep tree needs no deep stack. `object`: the combination's name, for findings.
Tree read_v5_tree(const TclWord& word, const TextSource& source, const std::string& object, TclStore& store);

}  // namespace csgrt
