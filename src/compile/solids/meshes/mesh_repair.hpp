// Mesh repair: the faults of a bot's faces, and how csgrt repairs them.
//
// If a bot encloses a volume, equal points are one vertex, whatever their numbers, and then
//
// - a face that is given several times counts once. If this leaves more edges open (see below), another rule holds: a
//   face that gives an edge an odd number of faces, where there would be an even number without it, is a wall between
//   two parts and does not count; nor do the two sides of a sheet.
// - a face without an area does not count, unless it joins others: a triangle of three points in line closes the gap
//   between one face's edge and two of its neighbour's.
// - a vertex in the middle of another face's edge splits that face, where this closes the surface (T-junction):
//
//        +-----+          +-----+
//       / \   / \        / \   / \       The two faces above have the edge in two parts, the one below in one.
//      +---+-+---+  ->  +---+-+---+
//       \       /        \   |   /
//        \     /          \  |  /
//
// - an edge with an odd number of faces is open. The inside of a surface without open edges is decided by parity,
//   whatever the winding of its faces, and however many faces meet in an edge.
// - the faces of a surface with open edges are turned over where they wind against their neighbours, if the bot says
//   that they wind one way. The winding decides the inside. It also does, as in BRL-CAD, for a surface that cutting has
//   closed and whose faces all wind against the bot's orientation: such a surface encloses the outside.
//
// Each plate of a bot is a separate solid. Plates without an area, and plates given before with the same thickness, do
// not count.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compile/solids/meshes/triangles.hpp"

namespace csgrt {

/// A bot after repair: a surface whose inside is well defined, and notes on the faults.
struct RepairedMesh {
    Triangles mesh;
    std::vector<std::uint32_t> from;  ///< one a face: the bot's face of which this face is a part or the whole
    bool is_closed = true;            ///< no edge is open; has no meaning for plates
    bool decided_by_facing = false;   ///< the winding of faces decides the inside; else parity does
    std::vector<std::string> notes;   ///< the faults, with counts; each makes a sentence with the bot's name
};

/// Repairs a bot. Without open edges the expected time is proportional to the number of faces n; else it is n log n for
/// usual meshes.
RepairedMesh repair(const Bot& bot);

}  // namespace csgrt
