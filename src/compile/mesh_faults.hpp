// Bots as they come: what is wrong with their faces, and what becomes of it.
//
// Of a bot that encloses a volume, equal points are one vertex, whatever their numbers, and then
//
// - a face that is given several times counts once. Where two cells have it in common, that is where with it an edge would
//   have an odd number of faces, and without it none has, it is a wall inside and does not count at all.
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
// - where a surface with open edges is said to wind one way, faces that wind against their neighbours are turned over.
//
// Plates are each a solid of its own: those without an area, and those given before with the same thickness, do not count.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compile/triangles.hpp"

namespace csgrt {

struct MendedMesh {
    Triangles mesh;
    std::vector<std::uint32_t> from;  ///< of each face, which of the bot's it is, or is a part of
    bool is_closed = true;            ///< no edge is open; of plates nobody asks
    std::vector<std::string> notes;   ///< what was wrong, with counts; what there is of it makes a sentence with the bot's name
};

/// In expected time proportional to the number of faces, where edges are not open; else n log n for usual meshes.
MendedMesh mend(const Bot& bot);

}  // namespace csgrt
