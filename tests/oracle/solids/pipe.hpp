// Pipes and clines as what they are made of: frusta of cones around straight parts of the centre line, and parts of
// tori around its bends, each less its bore. The centre line is rounded in 113 bits; only the frusta's ends are
// doubles.
#pragma once

#include <vector>

#include "tgc.hpp"
#include "tor.hpp"

namespace csgrt::oracle {

struct PipePart {
    ImplicitSolid solid;
    bool bore = false;
};

inline ImplicitSolid frustum(const QVec& from, const QVec& to, quad radius, quad top, const QAffine& place) {
    const QVec h = to - from, a = any_across(h), b = cross(unit(h), a);
    const auto v = [](quad s, const QVec& p) { return to_vec3(s * p); };
    return implicit(Tgc{to_vec3(from), to_vec3(h), v(radius, a), v(radius, b), v(top, a), v(top, b)}, place);
}

/// The part of a torus that a pipe follows from direction `into` at `from` to direction `out` at `to`.
inline ImplicitSolid bend(const QVec& center, const QVec& into, const QVec& out, const QVec& from, const QVec& to,
                          quad tube, const QAffine& place) {
    const QVec axis = unit(cross(into, out));
    ImplicitSolid solid =
        implicit(Tor{to_vec3(center), to_vec3(axis), to_double(length(from - center)), to_double(tube)}, place);
    // The planes at its ends, in the torus's own frame.
    const auto cut = [&](const QVec& normal, const QVec& at) {
        const QAffine back = place.inverse();
        const QVec x = back.direction(solid.to_world.x), y = back.direction(solid.to_world.y),
                   z = back.direction(solid.to_world.z), o = back.point(solid.to_world.origin);
        solid.add(PlaneFunction{{dot(normal, x), dot(normal, y), dot(normal, z)}, dot(normal, at - o)});
    };
    cut(quad(-1) * into, from);
    cut(out, to);
    return solid;
}

inline std::vector<PipePart> parts(const Pipe& pipe, const QAffine& place) {
    std::vector<PipePart> result;
    QVec at = pipe.points.front().position;
    for (std::size_t i = 0; i + 1 < pipe.points.size(); ++i) {
        const Pipe::Point &p = pipe.points[i], &q = pipe.points[i + 1];
        const QVec corner = q.position, into = unit(corner - QVec(p.position));
        QVec to = corner, after = corner, out = into;
        bool turns = false;
        if (i + 2 < pipe.points.size()) {
            out = unit(QVec(pipe.points[i + 2].position) - corner);
            turns = to_double(length(cross(into, out))) > 1e-9;
            // bend x tan(half the angle of the turn)
            const quad along = turns ? quad(q.bend) * length(cross(into, out)) / (1 + dot(into, out)) : quad(0);
            to = corner - along * into;
            after = corner + along * out;
        }
        const auto both = [&](double outer, double inner, const auto& make) {
            result.push_back({make(outer), false});
            if (inner > 0) result.push_back({make(inner), true});
        };
        if (to_double(dot(to - at, into)) > 1e-9 * (p.outer + q.outer)) {
            result.push_back({frustum(at, to, quad(p.outer) / 2, quad(q.outer) / 2, place), false});
            if (p.inner > 0 || q.inner > 0)
                result.push_back({frustum(at, to, quad(p.inner) / 2, quad(q.inner) / 2, place), true});
        }
        if (turns) {
            const QVec center = to + quad(q.bend) * unit(out - dot(out, into) * into);
            both(q.outer, q.inner,
                 [&](double width) { return bend(center, into, out, to, after, quad(width) / 2, place); });
        }
        at = after;
    }
    return result;
}

inline std::vector<PipePart> parts(const Cline& line, const QAffine& place) {
    std::vector<PipePart> result;
    const QVec from = line.v, to = QVec(line.v) + QVec(line.h);
    result.push_back({frustum(from, to, line.radius, line.radius, place), false});
    const quad bore = quad(line.radius) - quad(line.thickness);
    if (line.thickness > 0 && bore > 0) result.push_back({frustum(from, to, bore, bore, place), true});
    return result;
}

}  // namespace csgrt::oracle
