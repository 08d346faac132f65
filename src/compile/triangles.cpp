#include "compile/triangles.hpp"

namespace csgrt {

Triangles triangles_of(const Bot& bot) { return {bot.vertices, bot.faces, identity}; }

}  // namespace csgrt
