// What a ray does to surfaces of triangles, as whole scenes need it: the exact spans, and what stays so when the ray
// moves by what rounding may do to it. Where an edge is that near, rays beside it are tried, all around.
#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "intersect.hpp"
#include "mesh_solids.hpp"

namespace csgrt::oracle {

inline bool is_closed(const Parts& parts) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const MeshSurface::Face& f : parts.faces)
        for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(f[k], f[(k + 1) % 3])];
    return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second % 2 == 0; });
}

/// Equal points are one vertex, and triangles without area are none. A surface is a set of points, and has each once:
/// of several triangles with the same vertices one counts. Where that leaves it open, and with all of them every edge
/// has an even number of triangles, as between two parts that have a side in common, pairs of them bound nothing.
inline Parts parts_of(const Bot& bot) {
    Parts all;
    for (const auto& face : bot.faces)
        all.triangle(bot.vertices[face[0]], bot.vertices[face[1]], bot.vertices[face[2]]);
    std::map<MeshSurface::Face, int> times;
    const auto sorted = [](MeshSurface::Face face) {
        std::sort(face.begin(), face.end());
        return face;
    };
    for (const MeshSurface::Face& face : all.faces) ++times[sorted(face)];
    if (times.size() == all.faces.size()) return all;
    const auto each_once = [&](const auto& counts) {
        Parts parts = all;
        std::map<MeshSurface::Face, int> seen;
        std::erase_if(parts.faces, [&](const MeshSurface::Face& face) {
            return ++seen[sorted(face)] > 1 || !counts(times[sorted(face)]);
        });
        return parts;
    };
    Parts once = each_once([](int) { return true; });
    return is_closed(once) || !is_closed(all) ? once : each_once([](int count) { return count % 2 == 1; });
}

/// Flat faces of loops: all triangles from one corner to a face's edges cover it by parity.
inline Parts parts_of(const Nmg& nmg) {
    Parts parts;
    for (const auto& face : nmg.faces) {
        const Vec3& corner = nmg.vertices[face[0][0]];
        for (const Nmg::Loop& loop : face)
            for (std::size_t i = 0; i < loop.size(); ++i)
                parts.triangle(corner, nmg.vertices[loop[i]], nmg.vertices[loop[(i + 1) % loop.size()]]);
    }
    return parts;
}

/// Tries a ray and, if `edge_distance` is within reach, others beside it.
/// `spans_of(o)`: where the line from o is inside, and how near it comes to an edge.
template <class SpansOf>
Answer perturbed_answer(const QVec& o, const QVec& d, double moved, const SpansOf& spans_of) {
    Answer answer;
    quad edge_distance = 0;
    const Spans exact = spans_of(o, edge_distance);
    answer.inner = answer.outer = exact;
    answer.tie = edge_distance <= quad(moved);
    if (answer.tie) {
        const QVec aside = any_across(d), aside2 = unit(cross(d, aside));
        for (int k = 0; k < 8; ++k) {
            const double turn = k * std::acos(-1.0) / 4;
            quad ignored = 0;
            const Spans other =
                spans_of(o + quad(moved * std::cos(turn)) * aside + quad(moved * std::sin(turn)) * aside2, ignored);
            answer.inner = intersect(answer.inner, other);
            answer.outer = unite(answer.outer, other);
        }
    }
    for (const Span& s : exact) {
        Interval interval;
        interval.in.t = to_double(s.in.at);
        interval.out.t = to_double(s.out.at);
        answer.intervals.push_back(interval);
    }
    return answer;
}

/// By how much rounding may displace a surface's triangles, millimetres; as in intersect.hpp.
inline double displacement(const MeshSurface& surface, const QVec& o, const QVec& d) {
    const double way = to_double(absolute(dot(surface.center - o, d)) / length(d));
    return surface.condition *
           (precision * surface.radius + margin * ulps * double_epsilon * (surface.placement + way + surface.radius));
}
inline bool misses(const MeshSurface& surface, const QVec& o, const QVec& d, double moved) {
    const QVec to_center = surface.center - o;
    const quad t = dot(to_center, d) / dot(d, d);
    return length(to_center - t * d) > quad(surface.radius * 1.0001 + 2 * moved);
}

/// Larger than the distance from which on misses() is true.
inline BoundingSphere bounding_sphere_of(const MeshSurface& surface) {
    const double rounding = 4 * margin * ulps * double_epsilon * surface.condition;
    return {to_vec3(surface.center),
            1.001 * surface.radius + 4 * precision * surface.condition * surface.radius +
                rounding * (surface.placement + surface.radius),
            rounding};
}

/// A solid that triangles enclose, by parity. One with gaps encloses nothing for certain: all between the first and
/// the last triangle that a ray meets is in doubt.
class MeshSolid {
public:
    MeshSolid(const Parts& parts, const QAffine& place)
        : surface_(parts.vertices, parts.faces, place * parts.place), closed_(is_closed(parts)) {}

    BoundingSphere bounds() const { return bounding_sphere_of(surface_); }
    Answer along(const Ray& ray) const {
        const QVec o = ray.origin, d = ray.direction;
        const double moved = displacement(surface_, o, d), speed = to_double(length(d));
        if (misses(surface_, o, d, moved)) return {};
        Spans doubtful;
        std::vector<MeshCrossing> met;
        const auto spans_of = [&](const QVec& from, quad& edge_distance) {
            const MeshCrossings crossings = surface_.cross_all(from, d, moved);
            edge_distance = crossings.edge_distance;
            const auto all = without_pairs(crossings.all);
            if (met.empty()) met = all;
            Spans spans;
            for (std::size_t i = 0; i + 1 < all.size(); i += 2) spans.push_back({{all[i].t, 0}, {all[i + 1].t, 0}});
            if (!all.empty() && (!closed_ || all.size() % 2 != 0))
                doubtful.push_back({{all.front().t, 0}, {all.back().t, 0}});
            return spans;
        };
        Answer answer = perturbed_answer(o, d, moved, spans_of);
        if (!doubtful.empty()) {
            answer.tie = true;
            answer.outer = unite(answer.outer, doubtful);
            answer.inner = subtract(answer.inner, join(doubtful));
        }
        for (std::size_t i = 0; i < answer.intervals.size(); ++i)
            for (const bool in : {true, false}) {
                End& e = in ? answer.intervals[i].in : answer.intervals[i].out;
                const MeshCrossing& c = met[2 * i + (in ? 0 : 1)];
                const double cosine = std::max(to_double(c.cosine), 1e-300);
                e.tolerance = std::min(moved / cosine, surface_.radius) / speed + 4 * double_epsilon * std::abs(e.t);
                if (answer.tie) continue;  // no normal: another triangle's may be found
                const QVec n = surface_.normal(c.triangle);
                e.normal = to_vec3((dot(n, d) < 0) == in ? n : -n);
                e.cosine = cosine;
            }
        return answer;
    }

private:
    /// Less the pairs that an nmg's overlapping triangles make in the plane of one face.
    static std::vector<MeshCrossing> without_pairs(const std::vector<MeshCrossing>& all) {
        std::vector<MeshCrossing> kept;
        for (const MeshCrossing& c : all) {
            const bool same = !kept.empty() && absolute(kept.back().t - c.t) <= quad(1e-30) * (1 + absolute(c.t));
            if (same)
                kept.pop_back();
            else
                kept.push_back(c);
        }
        return kept;
    }

    MeshSurface surface_;
    bool closed_;
};

/// Bots without an inside: each triangle a plate of its own, or a skin along the ray.
class PlateSolid {
public:
    PlateSolid(const Bot& bot, const QAffine& place, double skin)
        : bot_(bot), inverse_(place.inverse()), skin_(skin), surface_(bot.vertices, bot.faces, place) {}

    BoundingSphere bounds() const { return bounding_sphere_of(surface_); }
    Answer along(const Ray& ray) const {
        const QVec o = ray.origin, d = ray.direction;
        const double moved = displacement(surface_, o, d), speed = to_double(length(d));
        if (misses(surface_, o, d, moved)) return {};
        Spans doubtful;
        double widest = 0;
        const auto spans_of = [&](const QVec& from, quad& edge_distance) {
            const MeshCrossings crossings = surface_.cross_all(from, d, moved);
            edge_distance = crossings.edge_distance;
            Spans spans;
            for (const MeshCrossing& c : crossings.all) {
                const Span s = slab(c, d);
                // Edge-on it may reach anywhere; and one whose face lies behind the start is not looked for.
                if (c.cosine < quad(1e-3) || to_double(c.t) * speed < moved) {
                    doubtful.push_back(s);
                    continue;
                }
                spans.push_back(s);
                const double cosine = to_double(c.cosine), thick = to_double(s.out.at - s.in.at);
                const double turn = surface_.condition * 64 * double_epsilon * surface_.radius /
                                    std::max(surface_.height(c.triangle), 1e-300);
                widest =
                    std::max(widest, 2 * moved / cosine / speed + thick * (turn / cosine + 1e-12 * surface_.condition));
            }
            return join(std::move(spans));
        };
        Answer answer = perturbed_answer(o, d, moved, spans_of);
        if (!doubtful.empty()) {
            answer.tie = true;
            answer.inner = subtract(answer.inner, join(doubtful));
            answer.outer = unite(answer.outer, doubtful);
        }
        for (Interval& i : answer.intervals)  // no normals: plates may overlap, and then either's is found
            for (End* e : {&i.in, &i.out}) e->tolerance = widest + 4 * double_epsilon * std::abs(e->t);
        return answer;
    }

private:
    Span slab(const MeshCrossing& c, const QVec& world_d) const {
        const auto& face = bot_.faces[c.triangle];
        const double thickness = bot_.thickness.empty() ? 0 : bot_.thickness[c.triangle];
        if (!(thickness > 0) || bot_.mode == Bot::Mode::surface)
            return {{c.t, 0}, {c.t + quad(skin_) / length(world_d), 0}};
        const QVec d = inverse_.direction(world_d), a = bot_.vertices[face[0]], b = bot_.vertices[face[1]],
                   p = bot_.vertices[face[2]];
        const quad rate = bot_.mode == Bot::Mode::plate ? absolute(dot(unit(cross(b - a, p - a)), d)) : length(d);
        const bool append = !bot_.append.empty() && bot_.append[c.triangle] != 0;
        const quad all = quad(thickness) / rate;
        return {{append ? c.t : c.t - all / 2, 0}, {append ? c.t + all : c.t + all / 2, 0}};
    }

    Bot bot_;
    QAffine inverse_;
    double skin_;
    MeshSurface surface_;
};

}  // namespace csgrt::oracle
