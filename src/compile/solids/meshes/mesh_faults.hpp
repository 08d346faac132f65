// Bots as they come: what is wrong with their faces, and what becomes of it.
//
// Of a bot that encloses a volume, equal points are one vertex, whatever their numbers, and then
//
// - a face that is given several times counts once. Only if that leaves open more edges (see below): where an edge
//   would have an odd number of faces with it, and an even one without, it is a wall between two parts and does not
//   count at all; nor do the two sides of a sheet.
// - a face without an area does not count, unless it joins others: a triangle of three points in line closes the gap
//   between one face's edge and two of its neighbour's.
// - a vertex in the middle of another face's edge splits that face, where that closes the surface (T-junction):
//
//        +-----+          +-----+
//       / \   / \        / \   / \       The two faces above have the edge in two parts, the one below in one.
//      +---+-+---+  ->  +---+-+---+
//       \       /        \   |   /
//        \     /          \  |  /
//
// - an edge with an odd number of faces is open. In a surface without open edges, what it encloses is told by parity,
//   whichever way its faces wind, and however many meet in an edge.
// - where a surface with open edges is said to wind one way, faces that wind against their neighbours are turned over,
//   and what it encloses is told by the way they wind. So does BRL-CAD with a surface that cutting has closed and whose
//   faces all wind the other way than is said: what it encloses is what is outside, and that is kept.
//
// Plates are each a solid of its own: those without an area, and those given before with the same thickness, do not
// count.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compile/solids/meshes/triangles.hpp"

namespace csgrt {

struct MendedMesh {
    Triangles mesh;
    std::vector<std::uint32_t> from;  ///< of each face, which of the bot's it is, or is a part of
    bool is_closed = true;            ///< no edge is open; of plates nobody asks
    bool told_by_facing = false;  ///< what it encloses: by the way its faces wind, as it is said to be; else by parity
    std::vector<std::string>
        notes;  ///< what was wrong, with counts; what there is of it makes a sentence with the bot's name
};

/// In expected time proportional to the number of faces, where edges are not open; else n log n for usual meshes.
MendedMesh mend(const Bot& bot);

}  // namespace csgrt
