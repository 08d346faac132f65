#include "scene/mesh_faults.hpp"

#include <algorithm>
#include <cmath>

#include "scene/vector.hpp"

namespace csgrt {

namespace {

using Faults = std::vector<std::string>;

/// Corners are at most this far apart, and from the origin: squares of such lengths are numbers still.
constexpr double farthest = 1e150;

/// One sentence about the first vertex that is not a place; nothing else is worth saying then.
bool check_vertices(Faults& faults, const std::vector<Vec3>& vertices) {
    const auto bad = std::find_if(vertices.begin(), vertices.end(),
                                  [](const Vec3& v) { return !is_finite(v) || !(length(v) <= farthest); });
    if (bad == vertices.end()) return true;
    faults.push_back("vertex " + std::to_string(bad - vertices.begin()) +
                     (is_finite(*bad) ? " lies too far away" : " has a number that is not finite"));
    return false;
}

std::string no_vertex(std::uint32_t corner, std::size_t count) {
    return " uses vertex " + std::to_string(corner) + "; there " +
           (count == 0   ? "are no vertices"
            : count == 1 ? "is only vertex 0"
                         : "are only vertices 0 to " + std::to_string(count - 1));
}

}  // namespace

Faults mesh_faults(const Bot& s) {
    Faults faults;
    if (!check_vertices(faults, s.vertices)) return faults;
    if (s.faces.empty()) faults.push_back("it has no faces");
    for (std::size_t i = 0; i < s.faces.size(); ++i) {
        const std::uint32_t corner = *std::max_element(s.faces[i].begin(), s.faces[i].end());
        if (corner < s.vertices.size()) continue;
        return {"face " + std::to_string(i) + no_vertex(corner, s.vertices.size())};
    }
    return faults;
}

}  // namespace csgrt
