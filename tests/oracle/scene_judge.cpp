#include "scene_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

#include "../integration/region_paths.hpp"
#include "print.hpp"

namespace csgrt::oracle {

SceneJudge::SceneJudge(const SceneOracle& oracle, const std::vector<RegionInfo>& regions, double slack)
    : oracle_(oracle), slack_(slack) {
    // The n-th region of a path is the oracle's n-th of it.
    std::map<std::string, std::vector<std::uint32_t>> known;
    for (std::size_t i = 0; i < oracle.regions().size(); ++i)
        known[oracle.regions()[i].path].push_back(static_cast<std::uint32_t>(i));
    std::map<std::string, std::size_t> used;
    for (const RegionInfo& region : regions) {
        const std::string path = test::without_numbers(region.path);
        const std::vector<std::uint32_t>& same = known[path];
        const std::size_t n = used[path]++;
        if (n < same.size())
            to_oracle_.push_back(same[n]);
        else
            unknown_ += "the oracle has no region " + region.path + "; ";
    }
}

std::string SceneJudge::judge(const Ray& ray, const RayPartitions& found, std::size_t& ties) const {
    const SceneAnswer answer = oracle_.shoot(ray, slack_);
    std::ostringstream wrong;
    wrong.precision(17);
    ties += answer.tie ? 1 : 0;
    check_order(found, wrong);
    bool overlaps = !found.overlaps.empty();  // some are no longer than the slack
    for (const Piece& piece : answer.pieces) {
        check_piece(piece, found, wrong);
        overlaps = overlaps || contested(piece);
    }
    overlaps = overlaps || overlap_behind(answer, slack_ / to_double(length(QVec(ray.direction))));
    if (!answer.tie && !overlaps) check_spans(ray, answer, found, wrong);
    if (!answer.tie) check_ends(ray, answer, found, wrong);
    check_normals(ray, answer, found, wrong);
    if (wrong.str().empty()) return {};
    wrong << "\n  " << describe(ray) << "\n  found:";
    for (const Partition& p : found.partitions)
        print(
            print(wrong << "\n    [" << p.in << ", " << p.out << "] " << name(to_oracle_[p.region]) << ' ', p.in_normal)
                << ' ',
            p.out_normal);
    for (const Overlap& o : found.overlaps) {
        wrong << "\n    overlap [" << o.in << ", " << o.out << ']';
        for (const std::uint32_t r : o.regions) wrong << ' ' << name(to_oracle_[r]);
    }
    wrong << "\n  oracle" << (answer.tie ? ", a tie:" : ":");
    for (const Piece& piece : answer.pieces) {
        if (piece.claims.empty()) continue;
        wrong << "\n    [" << piece.in << ", " << piece.out << ']';
        for (const Piece::Claim& c : piece.claims) wrong << ' ' << name(c.region) << (c.certain ? "" : "?");
    }
    return wrong.str();
}

std::string SceneJudge::judge_point(const Vec3& point, std::int32_t found, bool overlaps, std::size_t& decided) const {
    const SceneAnswer answer = oracle_.shoot({point, {1, 0, 0}}, slack_);
    const auto piece =
        std::find_if(answer.pieces.begin(), answer.pieces.end(), [](const Piece& p) { return p.in < 0 && 0 < p.out; });
    if (piece == answer.pieces.end()) return {};
    std::vector<std::uint32_t> claims;
    for (const Piece::Claim& claim : piece->claims) {
        if (!claim.certain) return {};
        claims.push_back(claim.region);
    }
    ++decided;
    const auto rank = [&](std::uint32_t region) { return oracle_.regions()[region].rank; };
    int first = std::numeric_limits<int>::max();
    for (const std::uint32_t region : claims) first = std::min(first, rank(region));
    std::erase_if(claims, [&](std::uint32_t region) { return rank(region) != first; });
    const bool is_right = found == -1   ? claims.empty()
                          : found == -2 ? overlaps && claims.size() > 1
                                        : !claims.empty() && (!overlaps || claims.size() == 1) &&
                                              to_oracle_[static_cast<std::size_t>(found)] == claims[0];
    if (is_right) return {};
    std::ostringstream wrong;
    wrong << "found " << found << (found >= 0 ? " " + name(to_oracle_[static_cast<std::size_t>(found)]) : "")
          << ", the oracle has";
    for (const std::uint32_t region : claims) wrong << ' ' << name(region);
    return wrong.str();
}

std::size_t SceneJudge::certain(const Piece& piece, int rank) const {
    return static_cast<std::size_t>(std::count_if(piece.claims.begin(), piece.claims.end(), [&](const Piece::Claim& c) {
        return c.certain && oracle_.regions()[c.region].rank == rank;
    }));
}

bool SceneJudge::contested(const Piece& piece) {
    return std::count_if(piece.claims.begin(), piece.claims.end(), [](const Piece::Claim& c) { return c.certain; }) > 1;
}

bool SceneJudge::overlap_behind(const SceneAnswer& answer, double slack) {
    std::vector<std::pair<double, double>> behind;
    for (const Spans& spans : answer.regions)
        for (const Span& s : spans)
            if (s.in.at < 0) behind.push_back({to_double(s.in.at), to_double(s.out.at)});
    std::sort(behind.begin(), behind.end());
    double reached = -std::numeric_limits<double>::infinity();
    for (const auto& [in, out] : behind) {
        if (std::min(reached, out) - in > slack) return true;
        reached = std::max(reached, out);
    }
    return false;
}

bool SceneJudge::claimed(const Piece& piece, std::uint32_t region) {
    return std::any_of(piece.claims.begin(), piece.claims.end(),
                       [&](const Piece::Claim& c) { return c.region == region; });
}

void SceneJudge::check_order(const RayPartitions& found, std::ostream& wrong) {
    for (std::size_t i = 0; i < found.partitions.size(); ++i) {
        if (!(found.partitions[i].in < found.partitions[i].out)) wrong << "partition " << i << " has no length; ";
        if (i > 0 && !(found.partitions[i - 1].out <= found.partitions[i].in))
            wrong << "partition " << i << " overlaps; ";
    }
}

void SceneJudge::check_piece(const Piece& piece, const RayPartitions& found, std::ostream& wrong) const {
    const double in = std::max(piece.in, 0.0), out = piece.out;
    if (!(out - in > 1e-13 * std::abs(in))) return;
    const double t = std::isinf(out) ? in + 1 + std::abs(in) : in + 0.5 * (out - in);
    const Partition* here = nullptr;
    for (const Partition& p : found.partitions)
        if (p.in <= t && t <= p.out) here = &p;
    const Overlap* overlap = nullptr;
    for (const Overlap& o : found.overlaps)
        if (o.in <= t && t <= o.out) overlap = &o;

    if (here && !claimed(piece, to_oracle_[here->region]))
        wrong << name(to_oracle_[here->region]) << " is not at " << t << "; ";
    const auto rank = [&](std::uint32_t region) { return oracle_.regions()[region].rank; };
    if (!here && std::any_of(piece.claims.begin(), piece.claims.end(), [](const Piece::Claim& c) { return c.certain; }))
        wrong << "nothing found at " << t << "; ";
    if (!here && overlap) wrong << "an overlap of nothing at " << t << "; ";
    if (!here) return;
    const std::uint32_t owner = to_oracle_[here->region];
    for (const Piece::Claim& c : piece.claims)
        if (c.certain && std::pair(rank(c.region), c.region) < std::pair(rank(owner), owner))
            wrong << name(owner) << " does not yield to " << name(c.region) << " at " << t << "; ";
    const std::size_t sure = certain(piece, rank(owner));
    if (overlap) {
        for (const std::uint32_t r : overlap->regions)
            if (!claimed(piece, to_oracle_[r]) || rank(to_oracle_[r]) != rank(owner))
                wrong << name(to_oracle_[r]) << " does not overlap at " << t << "; ";
        for (const Piece::Claim& c : piece.claims) {
            bool listed = false;
            for (const std::uint32_t r : overlap->regions) listed = listed || to_oracle_[r] == c.region;
            if (c.certain && !listed && rank(c.region) == rank(owner))
                wrong << name(c.region) << " is missing from the overlap at " << t << "; ";
        }
    } else if (sure > 1) {
        wrong << "no overlap listed at " << t << "; ";
    }
}

void SceneJudge::check_spans(const Ray& ray, const SceneAnswer& answer, const RayPartitions& found,
                             std::ostream& wrong) const {
    const double speed = to_double(length(QVec(ray.direction)));
    double widest = 0;
    for (const Event& e : answer.events) widest = std::max(widest, e.tolerance);
    const double allowed = slack_ / speed + widest;
    std::vector<std::size_t> met;
    for (std::size_t r = 0; r < answer.regions.size(); ++r)
        if (!answer.regions[r].empty()) met.push_back(r);
    for (const Partition& p : found.partitions)
        if (answer.regions[to_oracle_[p.region]].empty()) met.push_back(to_oracle_[p.region]);
    for (const std::size_t r : met) {
        std::vector<const Partition*> mine;
        for (const Partition& p : found.partitions)
            if (to_oracle_[p.region] == r && p.out > allowed) mine.push_back(&p);
        std::size_t next = 0;
        for (const Span& span : answer.regions[r]) {
            const double in = to_double(span.in.at), out = to_double(span.out.at);
            if (out <= allowed) continue;  // behind the start, or at it
            const auto close = [&](double a, double b) { return a == b || std::abs(a - b) <= allowed; };
            if (next == mine.size() || !close(mine[next]->in, in) || !close(mine[next]->out, out))
                wrong << name(static_cast<std::uint32_t>(r)) << " should be at [" << in << ", " << out << "]; ";
            else
                ++next;
        }
        if (next < mine.size()) wrong << name(static_cast<std::uint32_t>(r)) << " has too many partitions; ";
    }
}

void SceneJudge::check_ends(const Ray& ray, const SceneAnswer& answer, const RayPartitions& found,
                            std::ostream& wrong) const {
    const double slack = slack_ / to_double(length(QVec(ray.direction)));
    for (const Partition& p : found.partitions)
        for (const double t : {p.in, p.out}) {
            const bool known = !std::isfinite(t) ||
                               std::any_of(answer.events.begin(), answer.events.end(),
                                           [&](const Event& e) { return std::abs(e.t - t) <= slack + e.tolerance; });
            if (!known) wrong << "no solid has an end at " << t << "; ";
        }
}

void SceneJudge::check_normals(const Ray& ray, const SceneAnswer& answer, const RayPartitions& found,
                               std::ostream& wrong) const {
    const QVec d = ray.direction;
    const double speed = to_double(length(d));
    const auto check = [&](double t, const Vec3& normal, double turned) {
        if (!std::isfinite(t)) return;
        if (std::abs(to_double(length(normal)) - 1) > 1e-12) wrong << "the normal at " << t << " is no unit vector; ";
        const Event* only = nullptr;
        for (const Event& e : answer.events) {
            if (std::abs(e.t - t) > 3 * slack_ / speed + e.tolerance) continue;
            if (only) return;
            only = &e;
        }
        // Where the hit itself may be displaced, curvature turns the normal: left to the judge of single solids.
        if (!only || only->tolerance * speed > 1e-8 || only->normal == Vec3{}) return;
        const double side = to_double(dot(only->normal, d)) * turned > 0 ? 1 : -1;
        if (to_double(length(quad(side) * QVec(only->normal) - QVec(normal))) > 1e-6 &&
            !oracle_.has_normal(only->solid, QVec(ray.origin) + quad(t) * d, normal, only->tolerance * speed))
            wrong << "the normal at " << t << " is not the surface's; ";
    };
    for (const Partition& p : found.partitions) {
        check(p.in, p.in_normal, -1);
        check(p.out, p.out_normal, 1);
    }
}

}  // namespace csgrt::oracle
