#include "perturbation.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace csgrt::oracle {

namespace {

bool leaps(const ExactIntervals& a, const ExactIntervals& b, quad far) {
    if (a.size() != b.size()) return true;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (absolute(a[i].in.t - b[i].in.t) > far || absolute(a[i].out.t - b[i].out.t) > far) return true;
    return false;
}

/// Adds the ray moved by `by`, each component in units of `most`, both in the solid's own frame.
void add_moved(const ExactSolid& solid, const Ray& ray, const QVec& most, const QVec& by, PerturbedAnswer& answer) {
    const QVec o = ray.origin, d = ray.direction;
    const QVec moved = solid.frame.direction({by.x * most.x, by.y * most.y, by.z * most.z});
    answer.perturbed.push_back(solid.along(o + moved, d));
    answer.tie = answer.tie || leaps(answer.exact, answer.perturbed.back(), quad(1e-3 * solid.radius) / length(d));
}

/// A few roundings in every direction of the world, in the solid's own frame.
QVec most_moved(const ExactSolid& solid, double rounding) {
    return componentwise_absolute(solid.frame.inverse()).direction({rounding, rounding, rounding});
}

}  // namespace

PerturbedAnswer perturb(const ExactSolid& solid, const Ray& ray) {
    const QVec o = ray.origin, d = ray.direction, off = solid.center - o;
    const quad way = absolute(dot(off, d)) / length(d);
    const double rounding = margin * ulps * double_epsilon * (solid.placement + to_double(way) + solid.radius);
    PerturbedAnswer answer;
    answer.delta = solid.condition * rounding;
    answer.exact = solid.along(o, d);
    const QVec most = most_moved(solid, rounding);
    for (const double x : {-1, 0, 1})
        for (const double y : {-1, 0, 1})
            for (const double z : {-1, 0, 1}) {
                const double sides = x * x + y * y + z * z;
                if (sides == 1 || sides == 3) add_moved(solid, ray, most, {x, y, z}, answer);
            }
    if (solid.half_way) {
        const QAffine to_own = solid.frame.inverse();
        const QVec at = to_own.point(o + dot(off, d) / dot(d, d) * d), from_axis{at.x, at.y, 0};
        const quad least = smaller(most.x, most.y);
        for (const quad side : {least, -least}) {
            if (length(from_axis) > least) break;
            const QVec by = side * *solid.half_way - from_axis;
            add_moved(solid, ray, most, {by.x / most.x, by.y / most.y, 0}, answer);
        }
    }
    return answer;
}

void perturb_at_random(const ExactSolid& solid, const Ray& ray, Random& random, PerturbedAnswer& answer) {
    const QVec most = most_moved(solid, answer.delta / solid.condition);
    for (int i = 0; i < 400; ++i) {
        const QVec corner = random.in_cube();
        add_moved(solid, ray, most, quad(i % 2 == 0 ? 1 : random.unit()) * corner, answer);
    }
}

namespace {

/// Does one of the intervals hold [low, high]?
bool holds(const ExactIntervals& set, quad low, quad high) {
    for (const ExactInterval& i : set)
        if (i.in.t <= low && high <= i.out.t) return true;
    return false;
}

bool misses(const ExactIntervals& set, quad low, quad high) {
    for (const ExactInterval& i : set)
        if (i.in.t <= high && low <= i.out.t) return false;
    return true;
}

}  // namespace

Verdict judge(const ExactSolid& solid, const Ray& ray, const PerturbedAnswer& answer,
              const std::vector<Segment>& segments) {
    Verdict verdict;
    std::ostringstream wrong;
    wrong.precision(17);
    const double speed = to_double(length(QVec(ray.direction)));
    const double moved = precision * solid.condition * solid.radius + answer.delta;
    std::vector<Segment> kept;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const Segment& s = segments[i];
        if (!(s.in <= s.out) || !std::isfinite(s.in) || !std::isfinite(s.out))
            wrong << "segment " << i << " runs from " << s.in << " to " << s.out << "; ";
        if (i > 0 && !(segments[i - 1].out <= s.in)) wrong << "segments " << i - 1 << " and " << i << " overlap; ";
        if (s.in < s.out) kept.push_back(s);
    }
    if (answer.tie) {
        // Where a ray's own digits end; and what a graze may add beyond the rays that were tried.
        const auto blur = [&](double t) {
            return (1e-9 * solid.radius + moved) / speed + 4 * double_epsilon * std::abs(t);
        };
        for (const Segment& s : kept) {
            const quad low = quad(s.in) + blur(s.in), high = quad(s.out) - blur(s.out);
            bool possible = !(low < high) || holds(answer.exact, low, high);
            bool nowhere = misses(answer.exact, low, high);
            for (const ExactIntervals& other : answer.perturbed) {
                possible = possible || holds(other, low, high);
                nowhere = nowhere && misses(other, low, high);
            }
            // One of several that neighbours merge may be held by none, but then it is met by some.
            if (!possible && nowhere) wrong << "a segment at " << s.in << " is nowhere; ";
        }
        for (const ExactInterval& i : answer.exact) {
            const quad low = i.in.t + blur(to_double(i.in.t)), high = i.out.t - blur(to_double(i.out.t));
            bool certain = low < high;
            for (const ExactIntervals& other : answer.perturbed) certain = certain && holds(other, low, high);
            bool found = false;
            for (const Segment& s : kept) found = found || (quad(s.in) <= high && low <= quad(s.out));
            if (certain && !found) wrong << "the interval at " << to_double(low) << " is not found; ";
        }
        verdict.wrong = wrong.str();
        return verdict;
    }
    ExactIntervals exact_kept = answer.exact;
    if (kept.size() != exact_kept.size()) {
        // At a corner that no shift found: what is no longer than an end may be off.
        const auto is_short = [&](double in, double out) {
            return out - in <= 2 * moved / speed + 8 * double_epsilon * std::abs(in);
        };
        std::erase_if(kept, [&](const Segment& s) { return is_short(s.in, s.out); });
        std::erase_if(exact_kept, [&](const auto& i) { return is_short(to_double(i.in.t), to_double(i.out.t)); });
        wrong << kept.size() << " segments, not " << answer.exact.size() << "; ";
        if (kept.size() == exact_kept.size()) return verdict;
        verdict.wrong = wrong.str();
        return verdict;
    }
    for (std::size_t i = 0; i < kept.size(); ++i)
        for (const bool in : {true, false}) {
            const auto end = [&](const ExactIntervals& set) { return in ? set[i].in : set[i].out; };
            const ExactEnd exact = end(answer.exact);
            quad shift = 0, turn = 0;
            for (const ExactIntervals& other : answer.perturbed) {
                shift = larger(shift, absolute(end(other).t - exact.t));
                turn = larger(turn, length(end(other).normal - exact.normal));
            }
            const double grown = moved / answer.delta, t = in ? kept[i].in : kept[i].out;
            const double tolerance =
                std::max(to_double(shift) * grown, moved / speed) + 4 * double_epsilon * std::abs(t);
            const double off = std::abs(to_double(quad(t) - exact.t)) / tolerance;
            verdict.worst = std::max(verdict.worst, off);
            if (!(off <= 1))
                wrong << (in ? "in" : "out") << " of segment " << i << " is off by " << off << " tolerances; ";
            const QVec normal = in ? kept[i].in_normal : kept[i].out_normal;
            if (!(length(normal - exact.normal) <= quad(normal_precision * solid.condition) + 4 * grown * turn))
                wrong << (in ? "in" : "out") << " normal of segment " << i << " is not the surface's; ";
        }
    verdict.wrong = wrong.str();
    return verdict;
}

std::string report(const std::string& name, const Ray& ray, const PerturbedAnswer& answer,
                   const std::vector<Segment>& segments, const Verdict& verdict) {
    std::ostringstream text;
    text.precision(17);
    text << name << "\n  " << verdict.wrong << (answer.tie ? " (tie)" : "") << "\n  ray " << ray.origin.x << ' '
         << ray.origin.y << ' ' << ray.origin.z << "  " << ray.direction.x << ' ' << ray.direction.y << ' '
         << ray.direction.z << "\n  exact:";
    for (const ExactInterval& i : answer.exact) text << "  " << to_double(i.in.t) << " .. " << to_double(i.out.t);
    text << "\n  found:";
    for (const Segment& s : segments) text << "  " << s.in << " .. " << s.out;
    return text.str();
}

}  // namespace csgrt::oracle
