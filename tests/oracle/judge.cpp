#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "print.hpp"

namespace csgrt::oracle {

namespace {

/// How far, in millimetres, a hit's surface may be displaced.
double displacement(const ImplicitSolid& solid, const Answer& answer) {
    return precision * solid.condition * solid.size + margin * answer.delta;
}

/// How far f_k may be from 0, or from its sign, at a point whose surface may be displaced by `distance`.
quad doubt(const ImplicitSolid& solid, std::size_t k, const QVec& local, quad distance) {
    return solid.change(k, local, distance) + quad(margin) * solid.noise(k, local);
}

bool on_surface(const ImplicitSolid& solid, std::size_t k, const QVec& local, quad distance) {
    return absolute(solid.surfaces[k]->value(local)) <= doubt(solid, k, local, distance);
}

/// Does the normal belong to a surface on which the point lies? `reach`: how far the true hit may be from the point.
bool normal_fits(const ImplicitSolid& solid, const QVec& point, const Vec3& normal, quad reach) {
    const QVec local = solid.to_local.point(point), claimed = normal;
    for (std::size_t k = 0; k < solid.surfaces.size(); ++k) {
        if (!on_surface(solid, k, local, reach)) continue;
        const QVec n = solid.normal(k, point);
        quad allowed = normal_precision * solid.condition;
        const quad off = length(claimed - n);
        if (off <= allowed) return true;
        for (const QVec& axis : {QVec{1, 0, 0}, QVec{0, 1, 0}, QVec{0, 0, 1}})
            for (const quad step : {reach, -reach})
                allowed = larger(allowed, 2 * length(solid.normal(k, point + step * axis) - n));
        if (off <= allowed) return true;
    }
    return false;
}

}  // namespace

double middle(double in, double out) {
    if (std::isinf(in) && std::isinf(out)) return 0;
    if (std::isinf(in)) return out - 1;
    return std::isinf(out) ? in + 1 : in + 0.5 * (out - in);
}

Verdict judge(const ImplicitSolid& solid, const Ray& ray, const Answer& answer, const std::vector<Segment>& segments) {
    Verdict verdict;
    std::ostringstream wrong;
    wrong.precision(17);
    const auto point = [&](double t) { return QVec(ray.origin) + quad(t) * QVec(ray.direction); };
    const double speed = to_double(length(ray.direction)), moved = displacement(solid, answer);

    for (std::size_t i = 0; i < segments.size(); ++i) {
        const Segment& s = segments[i];
        if (!(s.in <= s.out) || (!answer.tie && s.in == s.out)) wrong << "segment " << i << " has no length; ";
        if (i > 0 && !(segments[i - 1].out <= s.in)) wrong << "segments " << i - 1 << " and " << i << " overlap; ";
    }
    if (!answer.tie && segments.size() != answer.intervals.size()) {
        wrong << segments.size() << " segments, not " << answer.intervals.size() << "; ";
        verdict.wrong = wrong.str();
        return verdict;
    }

    const auto check_end = [&](std::size_t i, const char* side, double t, const Vec3& normal, const End* expected) {
        if (expected && std::isinf(expected->t) && t == expected->t) return;
        if (std::isinf(t) && !solid.bounded && answer.tie) return;
        if (!std::isfinite(t)) {
            wrong << side << " of segment " << i << " is " << t << "; ";
            return;
        }
        const QVec p = point(t);
        quad reach = moved;
        if (expected) {
            const double off = std::abs(t - expected->t) / expected->tolerance;
            verdict.worst = std::max(verdict.worst, off);
            if (!(off <= 1)) wrong << side << " of segment " << i << " is off by " << off << " tolerances; ";
            reach += expected->tolerance * speed;
        } else {
            const quad slack = quad(moved) + quad(4 * double_epsilon * std::abs(t) * speed);
            const QVec local = solid.to_local.point(p);
            bool on = false;
            for (std::size_t k = 0; k < solid.surfaces.size(); ++k) on = on || on_surface(solid, k, local, slack);
            if (!on) wrong << side << " of segment " << i << " is on no surface; ";
            reach = slack;
        }
        const double norm = to_double(length(normal));
        if (!(std::abs(norm - 1) <= 1e-12))
            wrong << side << " normal of segment " << i << " has length " << norm << "; ";
        if (!normal_fits(solid, p, normal, reach))
            wrong << side << " normal of segment " << i << " is not the surface's; ";
    };
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const Interval* expected = answer.tie ? nullptr : &answer.intervals[i];
        check_end(i, "in", segments[i].in, segments[i].in_normal, expected ? &expected->in : nullptr);
        check_end(i, "out", segments[i].out, segments[i].out_normal, expected ? &expected->out : nullptr);
    }

    if (answer.tie) {
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const double t = middle(segments[i].in, segments[i].out);
            const QVec local = solid.to_local.point(point(t));
            const quad slack = quad(moved) + quad(4 * double_epsilon * std::abs(t) * speed);
            for (std::size_t k = 0; k < solid.surfaces.size(); ++k)
                if (solid.surfaces[k]->value(local) > doubt(solid, k, local, slack)) {
                    wrong << "segment " << i << " is outside at its middle; ";
                    break;
                }
        }
        for (const Span& certain : answer.inner) {
            const double t = middle(to_double(certain.in.at), to_double(certain.out.at));
            bool found = false;
            for (const Segment& s : segments) found = found || (s.in <= t && t <= s.out);
            if (!found) wrong << "inside at " << t << " for certain, but in no segment; ";
        }
    }
    verdict.wrong = wrong.str();
    return verdict;
}

std::string report(const std::string& what, const Ray& ray, const Answer& answer, const std::vector<Segment>& segments,
                   const Verdict& verdict) {
    std::ostringstream out;
    out.precision(17);
    out << verdict.wrong << "\n  " << what << "\n  " << describe(ray) << "\n  solver: " << segments.size()
        << " segments";
    for (const Segment& s : segments)
        print(print(out << "\n    [" << s.in << ", " << s.out << "] normals ", s.in_normal) << ' ', s.out_normal);
    out << "\n  oracle: " << describe(answer);
    return out.str();
}

}  // namespace csgrt::oracle
