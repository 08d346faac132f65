// What a scene's regions are along a ray, from the oracle of point membership, by the rule for coincident surfaces:
// a skin or a gap that exists only because rounding moved one of two equal surfaces is none.
//
// The oracle says for every region where it is for certain, where it is not for certain, and where that depends on the
// last bits. What is unsure between two equal certainties is a skin (or a gap) of no thickness: it does not count. But
// the ray is a tie
//   - if a single solid is touched within rounding, so that it is not sure how often the ray is in it;
//   - if the numbers as they are make the skin thicker than their rounding could;
//   - if the surfaces that meet there are not one surface, their normals being different: an edge, a corner.
// Overlaps go to the first region of the first rank, and regions of later ranks (air, where a solid is) are no part of
// them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/filtered_solid.hpp"
#include "oracle/scene_oracle.hpp"
#include "stress/families.hpp"

namespace csgrt::test {

/// A stretch of the ray in which the set of claiming regions is constant, with how well its ends are known.
struct TrueStretch {
    double in = 0, out = 0;
    double in_tolerance = 0, out_tolerance = 0;  ///< along the ray
    std::vector<std::uint32_t> claims;           ///< those of the first rank, ascending, never empty
};
struct Truth {
    bool tie = false;
    bool certain = true;                 ///< false: the filter's normals are not exact enough to tell; ask in 113 bits
    std::vector<TrueStretch> stretches;  ///< of the whole line, in order
};

class TrueScene {
public:
    /// `filtered`, `air`: as in SceneOracle.
    TrueScene(const Scene& scene, const std::vector<std::string>& objects, bool filtered = false, bool air = false)
        : oracle_(scene, objects, false, filtered, air), filtered_(filtered), ranks_(objects.size()) {
        for (const oracle::OracleRegion& region : oracle_.regions()) {
            const std::string name = region.path.substr(region.path.rfind('/') + 1);
            const auto at = std::find(objects.begin(), objects.end(), name);
            number_.push_back(static_cast<std::uint32_t>(at - objects.begin()));
            ranks_[number_.back()] = region.rank;
        }
    }

    /// Regions are numbered as in `objects`.
    Truth shoot(const Ray& ray) const {
        const oracle::SceneAnswer answer = oracle_.shoot(ray, 0);
        Truth truth;
        truth.tie = answer.tie && answer.solid_tie;
        std::vector<Edge> edges;
        for (std::uint32_t r = 0; r < answer.regions.size(); ++r) add_edges(answer, r, edges, truth);
        std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.t < b.t; });
        weave(answer, edges, truth);
        yield(truth);
        return truth;
    }

private:
    struct Edge {
        double t = 0, tolerance = 0;
        std::uint32_t region = 0;
    };

    static Edge edge_at(const oracle::SceneAnswer& answer, double t) {
        Edge edge{t, 0, 0};
        for (const oracle::Event& e : answer.events)
            if (e.t == t || std::abs(e.t - t) <= e.tolerance) edge.tolerance = std::max(edge.tolerance, e.tolerance);
        return edge;
    }

    /// Do all solids that end between the two do so on one surface, up to rounding, each once?
    bool one_surface(const oracle::SceneAnswer& answer, double low, double high, Truth& truth) const {
        const oracle::Event* first = nullptr;
        std::vector<std::size_t> solids;
        double least = 0, most = 0, rounding = 0;
        for (const oracle::Event& e : answer.events) {
            if (e.t < low || e.t > high) continue;
            if (std::find(solids.begin(), solids.end(), e.solid) != solids.end()) return false;
            solids.push_back(e.solid);
            rounding = std::max(rounding, e.rounding);
            if (first == nullptr) {
                first = &e;
                least = most = e.t;
                continue;
            }
            least = std::min(least, e.t);
            most = std::max(most, e.t);
            if (first->normal == Vec3{} || e.normal == Vec3{} || !one_direction(first->normal, e.normal, truth))
                return false;
        }
        return most - least <= rounding;
    }
    /// Up to rounding. In doubles, and where these could make a difference in 113 bits.
    bool one_direction(const Vec3& a, const Vec3& b, Truth& truth) const {
        constexpr double apart = 1e-13, doubtful = 3 * oracle::normal_error;
        const double x = a.y * b.z - a.z * b.y, y = a.z * b.x - a.x * b.z, z = a.x * b.y - a.y * b.x;
        const double turn = std::sqrt(x * x + y * y + z * z);
        if (std::abs(turn - apart) > doubtful) return turn < apart;
        truth.certain = truth.certain && !filtered_;
        return oracle::to_double(oracle::length(oracle::cross(oracle::QVec(a), oracle::QVec(b)))) <= apart;
    }

    /// Where region r begins and ends.
    void add_edges(const oracle::SceneAnswer& answer, std::uint32_t r, std::vector<Edge>& edges, Truth& truth) const {
        std::vector<double> crossings;
        for (const oracle::Span& span : answer.regions[r])
            for (const oracle::quad t : {span.in.at, span.out.at})
                if (oracle::absolute(t) < oracle::infinity()) crossings.push_back(oracle::to_double(t));
        std::size_t next = 0;
        bool inside = false, unsure = false;
        double unsure_from = 0;
        for (const oracle::Piece& piece : answer.pieces) {
            const auto claim = std::find_if(piece.claims.begin(), piece.claims.end(),
                                            [&](const oracle::Piece::Claim& c) { return c.region == r; });
            const bool certain = claim != piece.claims.end() && claim->certain;
            if (claim != piece.claims.end() && !certain) {
                if (!unsure) unsure_from = piece.in;
                unsure = true;
                continue;
            }
            // From one certainty to the next, and the crossings on the way.
            std::vector<double> here;
            while (next < crossings.size() && crossings[next] <= piece.in) here.push_back(crossings[next++]);
            if ((here.size() % 2 == 1) != (certain != inside)) truth.tie = true;
            if (unsure) {
                double widest = 0;
                for (const oracle::Event& e : answer.events)
                    if (e.t >= unsure_from && e.t <= piece.in) widest = std::max(widest, e.tolerance);
                if (answer.solid_tie && piece.in - unsure_from > 4 * widest) truth.tie = true;
                if (!one_surface(answer, unsure_from, piece.in, truth)) truth.tie = true;
            }
            if (certain != inside) {
                Edge edge = edge_at(answer, here.empty() ? piece.in : here.front());
                edge.region = number_[r];
                edges.push_back(edge);
            }
            inside = certain;
            unsure = false;
        }
        if (unsure) truth.tie = true;
    }

    /// Edges that rounding alone keeps apart are one.
    void weave(const oracle::SceneAnswer& answer, const std::vector<Edge>& edges, Truth& truth) const {
        std::vector<std::uint32_t> inside;
        for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
            double tolerance = edges[begin].tolerance;
            for (end = begin + 1; end < edges.size(); ++end) {
                const double apart = edges[end].t - edges[end - 1].t;
                if (apart > edges[end].tolerance + edges[end - 1].tolerance) break;
                tolerance = std::max(tolerance, edges[end].tolerance);
            }
            const double t = edges[begin].t;
            if (end - begin > 1 && !one_surface(answer, t, edges[end - 1].t, truth)) truth.tie = true;
            std::vector<std::uint32_t> next = inside;
            for (std::size_t i = begin; i < end; ++i) {
                const auto at = std::lower_bound(next.begin(), next.end(), edges[i].region);
                if (at != next.end() && *at == edges[i].region)
                    next.erase(at);
                else
                    next.insert(at, edges[i].region);
            }
            if (next == inside) continue;
            if (!inside.empty()) {
                truth.stretches.back().out = t;
                truth.stretches.back().out_tolerance = tolerance;
            }
            if (!next.empty()) truth.stretches.push_back({t, t, tolerance, tolerance, next});
            inside = next;
        }
        if (!inside.empty()) truth.tie = true;  // no end: not in these scenes
    }

    /// Leaves the first rank's claims; stretches that do not differ any more are one.
    void yield(Truth& truth) const {
        std::vector<TrueStretch> left;
        for (TrueStretch& s : truth.stretches) {
            int first = ranks_[s.claims.front()];
            for (const std::uint32_t r : s.claims) first = std::min(first, ranks_[r]);
            std::erase_if(s.claims, [&](std::uint32_t r) { return ranks_[r] != first; });
            if (!left.empty() && left.back().out == s.in && left.back().claims == s.claims) {
                left.back().out = s.out;
                left.back().out_tolerance = s.out_tolerance;
            } else {
                left.push_back(std::move(s));
            }
        }
        truth.stretches = std::move(left);
    }

    oracle::SceneOracle oracle_;
    bool filtered_;
    std::vector<int> ranks_;             ///< by place in `objects`
    std::vector<std::uint32_t> number_;  ///< of the oracle's regions
};

}  // namespace csgrt::test
