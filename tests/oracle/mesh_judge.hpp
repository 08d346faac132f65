// Puts a solver's segments in a closed surface of triangles before the oracle.
//
// Every ray: segments in order, the set that they make differs from the exact one only by stretches that hug the
// surface; every end lies on the surface, its normal is that of a triangle there, against the ray where it goes in,
// along it where it goes out. Where the ray keeps clear of all edges it is decided: then also the number of segments is
// right, and each end lies within the tolerance of intersect.hpp of its place.
#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "judge.hpp"
#include "mesh.hpp"

namespace csgrt::oracle {

struct MeshVerdict {
    std::string wrong;
    bool tie = false, hit = false;
    double worst = 0;  ///< the largest error of an end, in tolerances; decided rays only
};

class MeshJudge {
public:
    MeshJudge(const MeshSurface& surface, const Ray& ray) : surface_(surface), o_(ray.origin), d_(ray.direction) {
        const quad speed = length(d_), way = absolute(dot(surface.center - o_, d_)) / speed;
        const double numbers = surface.placement + to_double(way) + surface.radius;
        speed_ = to_double(speed);
        moved_ = surface.condition *
                 (precision * surface.radius + margin * ulps * double_epsilon * numbers);  // as in intersect.hpp
        crossings_ = surface.cross_all(o_, d_, moved_);
        // Through a vertex or an edge even these digits may disagree about one triangle's side: a hair beside they do
        // not.
        if (crossings_.all.size() % 2 != 0) {
            const quad edge_distance = crossings_.edge_distance;
            crossings_ = surface.cross_all(o_ + quad(1e-3 * moved_) * any_across(d_), d_, moved_);
            crossings_.edge_distance = smaller(edge_distance, crossings_.edge_distance);
        }
    }

    const MeshCrossings& crossings() const { return crossings_; }

    MeshVerdict judge(const std::vector<Segment>& segments) {
        verdict_.tie = crossings_.edge_distance <= quad(moved_);
        verdict_.hit = !crossings_.all.empty();
        wrong_.precision(17);
        if (crossings_.all.size() % 2 != 0) wrong_ << "the oracle itself finds an odd number of crossings; ";
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const Segment& s = segments[i];
            if (!(s.in <= s.out)) wrong_ << "segment " << i << " has no length; ";
            if (i > 0 && !(segments[i - 1].out <= s.in)) wrong_ << "segments " << i - 1 << " and " << i << " overlap; ";
            check_end(i, "in", s.in, s.in_normal, -1);
            check_end(i, "out", s.out, s.out_normal, 1);
        }
        for (const Segment& s : segments) {
            const QVec middle = point((quad(s.in) + quad(s.out)) / 2);
            if (!surface_.contains(middle) && !surface_.is_near(middle, quad(moved_ + rounding(s.in) * speed_)))
                wrong_ << "outside at the middle of [" << s.in << ", " << s.out << "]; ";
        }
        if (!verdict_.tie) compare_ends(segments);
        compare_sets(segments);
        verdict_.wrong = wrong_.str();
        return verdict_;
    }

private:
    QVec point(quad t) const { return o_ + t * d_; }
    double rounding(double t) const { return 4 * double_epsilon * std::abs(t); }

    void check_end(std::size_t i, const char* side, double t, const Vec3& normal, int direction) {
        if (!std::isfinite(t)) {
            wrong_ << side << " of segment " << i << " is " << t << "; ";
            return;
        }
        const double norm = to_double(length(normal));
        if (!(std::abs(norm - 1) <= 1e-12))
            wrong_ << side << " normal of segment " << i << " has length " << norm << "; ";
        bool on = false, fits = false;
        const QVec n = normal;
        const quad reach = quad(2 * moved_ + rounding(t) * speed_);
        for (std::size_t k = 0; k < surface_.size() && !fits; ++k) {
            if (!surface_.is_near(k, point(t), reach)) continue;
            on = true;
            const double allowed =
                surface_.condition * (normal_precision + 64 * double_epsilon * surface_.radius / surface_.height(k));
            if (!(allowed < 1)) fits = true;  // a sliver: its normal is rounding
            const quad along = dot(n, surface_.normal(k));
            const QVec off = along > 0 ? n - surface_.normal(k) : n + surface_.normal(k);
            if (length(off) <= quad(allowed) && quad(direction) * dot(n, d_) >= quad(-allowed * speed_)) fits = true;
        }
        if (!on) wrong_ << side << " of segment " << i << " is not on the surface; ";
        if (on && !fits) wrong_ << side << " normal of segment " << i << " is not the surface's; ";
    }

    double tolerance(const MeshCrossing& c) const {
        const double cosine = std::max(to_double(c.cosine), 1e-300);
        return std::min(moved_ / cosine, surface_.radius) / speed_ + rounding(to_double(c.t));
    }

    void compare_ends(const std::vector<Segment>& segments) {
        const auto& all = crossings_.all;
        if (2 * segments.size() != all.size()) {
            wrong_ << segments.size() << " segments, not " << all.size() / 2 << "; ";
            return;
        }
        for (std::size_t i = 0; i < all.size(); ++i) {
            // Two crossings within their tolerances may change places.
            double allowed = tolerance(all[i]);
            for (const MeshCrossing& c : all)
                if (to_double(absolute(c.t - all[i].t)) <= tolerance(c)) allowed = std::max(allowed, tolerance(c));
            const double t = i % 2 == 0 ? segments[i / 2].in : segments[i / 2].out;
            const double off = to_double(absolute(quad(t) - all[i].t)) / allowed;
            verdict_.worst = std::max(verdict_.worst, off);
            if (!(off <= 1)) wrong_ << "end " << i << " is off by " << off << " tolerances; ";
        }
    }

    void compare_sets(const std::vector<Segment>& segments) {
        struct Change {
            quad t;
            int set;
        };
        std::vector<Change> changes;
        for (const MeshCrossing& c : crossings_.all) changes.push_back({c.t, 0});
        for (const Segment& s : segments) changes.push_back({s.in, 1}), changes.push_back({s.out, 1});
        std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.t < b.t; });
        bool inside[2] = {false, false};
        for (std::size_t i = 0; i + 1 < changes.size(); ++i) {
            inside[changes[i].set] = !inside[changes[i].set];
            if (inside[0] == inside[1]) continue;
            const quad in = changes[i].t, out = changes[i + 1].t;
            const quad slack = quad(moved_ + rounding(to_double(in)) * speed_);
            for (const double share : {0.1, 0.5, 0.9})
                if (!surface_.is_near(point(in + quad(share) * (out - in)), slack)) {
                    wrong_ << (inside[0] ? "missed" : "outside") << " from " << to_double(in) << " to "
                           << to_double(out) << "; ";
                    break;
                }
        }
    }

    const MeshSurface& surface_;
    QVec o_, d_;
    double speed_ = 1, moved_ = 0;
    MeshCrossings crossings_;
    MeshVerdict verdict_;
    std::ostringstream wrong_;
};

}  // namespace csgrt::oracle
