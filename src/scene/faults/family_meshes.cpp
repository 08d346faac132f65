#include <algorithm>
#include <cmath>

#include "scene/faults/families.hpp"

namespace csgrt {

namespace {

/// Checks that vertices are finite and in range. Only the first wrong vertex is reported.
bool check_places(Faults& faults, const std::vector<Vec3>& places, const std::string& what) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool finite = is_finite(places[i]);
        if (finite && largest(places[i]) <= Limits::length) continue;
        faults.push_back(what + std::to_string(i) +
                         (finite ? " lies too far away, at " + number_text(largest(places[i])) + "; " + length_limit()
                                 : " has a number that is not finite"));
        return false;
    }
    return true;
}

bool has_area(const Vec3& p, const Vec3& q, const Vec3& r) { return length(cross(q - p, r - p)) > 0; }

void check_plates(Faults& faults, const Bot& s) {
    if (s.thickness.size() != s.faces.size() || (!s.append.empty() && s.append.size() != s.faces.size())) {
        faults.push_back("plates need a thickness and a side for each of the " + std::to_string(s.faces.size()) +
                         " faces, found " + std::to_string(s.thickness.size()) + " and " +
                         std::to_string(s.append.size()));
        return;
    }
    for (std::size_t i = 0; i < s.faces.size(); ++i) {
        const std::string of = " of face " + std::to_string(i);
        if (!(s.thickness[i] >= 0 && s.thickness[i] <= Limits::length)) {
            faults.push_back("the thickness" + of + " must be 0 or more, and finite; " + length_limit());
            return;
        }
        if (!s.append.empty() && s.append[i] > 1) {
            faults.push_back("the side" + of + " must be 0 (half on each side) or 1 (behind the face)");
            return;
        }
    }
}

/// The first fault of a face, or an empty text. A face that is not flat is allowed: its projection along its normal is
/// cut into triangles.
std::string face_fault(const std::vector<Nmg::Loop>& face, const std::vector<Vec3>& vertices) {
    if (face.empty()) return " has no outline";
    for (const Nmg::Loop& loop : face) {
        if (loop.size() < 3) return " has a loop of fewer than 3 vertices";
        const std::uint32_t vertex = *std::max_element(loop.begin(), loop.end());
        if (vertex >= vertices.size()) return uses_missing_vertex(vertex, vertices.size());
    }
    return {};
}

bool has_area(const Nmg::Loop& loop, const std::vector<Vec3>& vertices) {
    for (std::size_t i = 2; i < loop.size(); ++i) {
        if (has_area(vertices[loop[0]], vertices[loop[i - 1]], vertices[loop[i]])) return true;
    }
    return false;
}

}  // namespace

/// An open mesh is allowed, as many of BRL-CAD's are. Each ray decides by its own hits what is inside.
void check_further(Faults& faults, const Bot& s) {
    if (!require_at_most(faults, "faces", s.faces.size(), Limits::triangles)) return;
    if (!require_at_most(faults, "vertices", s.vertices.size(), Limits::triangles)) return;
    if (!check_places(faults, s.vertices, "vertex ")) return;
    if (s.faces.empty()) return faults.push_back("it has no faces");
    bool solid = false;
    for (std::size_t i = 0; i < s.faces.size(); ++i) {
        const std::array<std::uint32_t, 3>& face = s.faces[i];
        const std::uint32_t vertex = *std::max_element(face.begin(), face.end());
        if (vertex >= s.vertices.size()) {
            return faults.push_back("face " + std::to_string(i) + uses_missing_vertex(vertex, s.vertices.size()));
        }
        solid = solid || has_area(s.vertices[face[0]], s.vertices[face[1]], s.vertices[face[2]]);
    }
    if (!solid) faults.push_back("none of its faces has an area");
    if (s.mode == Bot::Mode::plate || s.mode == Bot::Mode::plate_nocos) check_plates(faults, s);
}

void check_further(Faults& faults, const Ars& s) {
    if (s.curves.size() < 2) return faults.push_back("it has fewer than 2 curves");
    const std::size_t count = s.curves.front().size();
    if (count < 3) return faults.push_back("its curves have fewer than 3 points");
    if (!require_at_most(faults, "points", s.curves.size() * count, Limits::triangles / 2)) return;
    bool solid = false;
    for (std::size_t i = 0; i < s.curves.size(); ++i) {
        const std::vector<Vec3>& curve = s.curves[i];
        if (curve.size() != count) {
            return faults.push_back("curve " + std::to_string(i) + " has " + std::to_string(curve.size()) +
                                    " points, and curve 0 has " + std::to_string(count));
        }
        if (!check_places(faults, curve, "curve " + std::to_string(i) + ": point ")) return;
        for (std::size_t k = 0; i > 0 && k < count && !solid; ++k) {
            const std::vector<Vec3>& last = s.curves[i - 1];
            const std::size_t next = (k + 1) % count;
            solid = has_area(last[k], last[next], curve[k]) || has_area(last[next], curve[next], curve[k]);
        }
    }
    if (!solid) faults.push_back("its curves lie in one another: there is no surface");
}

void check_further(Faults& faults, const Nmg& s) {
    std::size_t corners = 0;
    for (const std::vector<Nmg::Loop>& face : s.faces) {
        for (const Nmg::Loop& loop : face) corners += loop.size();
    }
    if (!require_at_most(faults, "corners of faces", corners, Limits::triangles)) return;
    if (!check_places(faults, s.vertices, "vertex ")) return;
    if (s.faces.empty()) return faults.push_back("it has no faces");
    bool solid = false;
    for (std::size_t i = 0; i < s.faces.size(); ++i) {
        const std::string fault = face_fault(s.faces[i], s.vertices);
        if (!fault.empty()) return faults.push_back("face " + std::to_string(i) + fault);
        solid = solid || has_area(s.faces[i].front(), s.vertices);
    }
    if (!solid) faults.push_back("none of its faces has an area");
}

}  // namespace csgrt
