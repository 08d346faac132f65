// Depths of overlaps: climbs between tangent planes, which lines through an overlap find.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "analysis/overlap_search.hpp"
#include "base/parallel.hpp"

namespace csgrt::analysis {

/// A climb from one point of an overlap to a point that is as far as possible from the boundary.
struct Climb {
    std::size_t pair = 0;
    std::uint64_t number = 0;  ///< among the pair's climbs
    Vec3 point = {};
    Ball ball = {};                  ///< the largest one so far
    std::vector<Vec3> normals = {};  ///< of the planes that are nearest to the point
};

/// A line through a point of an overlap: the part around the point that the pair shares.
struct Line {
    RayPart chord = {};
    std::vector<Vec3> ends[2] = {};  ///< of this part, and of the lines beside it, if they are in the overlap, too
};

namespace {

// Climbs to the deepest point of an overlap: starting points that are compared, rounds, and last rounds that only look
// around at the deepest point.
constexpr std::size_t starts = 8, most_normals = 6;
constexpr std::uint64_t rounds = 6, last_rounds = 2;

/// The range of a ray within a box that holds its origin, and a little more.
RayRange within(const Box& box, const Vec3& origin, const Vec3& d) {
    RayRange range = {-nowhere, nowhere};
    const Vec3 size = box.high - box.low;
    const double margin = 1e-3 * length(size);
    for (double Vec3::*const axis : axes) {
        if (d.*axis == 0) continue;
        const double a = (box.low.*axis - origin.*axis) / d.*axis, b = (box.high.*axis - origin.*axis) / d.*axis;
        range.t_near = std::max(range.t_near, std::min(a, b));
        range.t_far = std::min(range.t_far, std::max(a, b));
    }
    return {std::min(range.t_near, 0.0) - margin, std::max(range.t_far, 0.0) + margin};
}

/// The planes that touch the boundary where lines meet it, each through the ends of three lines that are side by side.
std::vector<TangentPlane> planes_of(const std::vector<Line>& lines, const Vec3& point) {
    std::vector<TangentPlane> planes;
    for (const Line& line : lines) {
        for (const std::vector<Vec3>& end : line.ends) {
            if (end.size() < 3) continue;
            const Vec3 n = cross(end[1] - end[0], end[2] - end[0]);
            if (length(n) > 0) planes.push_back({end[0], (dot(n, end[0] - point) < 0 ? -1 : 1) / length(n) * n});
        }
    }
    std::ranges::stable_sort(planes, {}, [&](const TangentPlane& p) { return p.distance(point); });
    return planes;
}

/// The radius of a ball around the point that meets none of the planes, nor the ends of the lines.
double radius_of(const std::vector<TangentPlane>& planes, const std::vector<Line>& lines, const Vec3& point) {
    double radius = nearest(planes, point);
    for (const Line& line : lines) radius = std::min({radius, -line.chord.in, line.chord.out});
    return radius;
}

/// Keeps the normals of the nearest planes as directions of the climb's next lines.
void keep_normals(Climb& climb, const std::vector<TangentPlane>& planes) {
    climb.normals.clear();
    for (std::size_t k = 0; k < std::min(most_normals, planes.size()); ++k) climb.normals.push_back(planes[k].normal);
}

}  // namespace

/// The points from which a pair's climbs begin: middles of long parts that are not near each other.
std::vector<Vec3> OverlapSearch::starts_of(std::size_t number) const {
    std::vector<RayPart> chords = pairs[number].chords;
    chords.insert(chords.begin(), pairs[number].chord);
    std::ranges::stable_sort(chords, std::greater{}, &RayPart::length);
    std::vector<Vec3> points;
    for (const RayPart& chord : chords) {
        const auto is_near = [&](const Vec3& p) { return length(p - chord.middle()) < 0.25 * chord.length(); };
        if (points.size() == starts) break;
        if (std::ranges::none_of(points, is_near)) points.push_back(chord.middle());
    }
    return points;
}

/// Shoots lines through the points of climbs, along their normals and in the directions of a turned frame, and calls
/// take(climb, lines). `beside`: whether each line has two lines beside it.
void OverlapSearch::shoot_lines(std::vector<Climb>& climbs, std::uint64_t round, bool beside,
                                const std::function<void(Climb&, std::vector<Line>&)>& take) {
    const std::size_t group = beside ? 3 : 1;
    std::vector<std::size_t> firsts;
    for (std::size_t begin = 0, end = 0; begin < climbs.size(); begin = end) {
        drop_rays();
        firsts.assign(1, 0);
        for (; end < climbs.size() && rays.size() < rays_at_once; ++end) {
            const Climb& climb = climbs[end];
            const Pair& pair = pairs[climb.pair];
            Random random{request.seed, 3, pair.first, pair.second, climb.number, round};
            const std::array<Vec3, 3> frame = random_frame(random);
            std::vector<Vec3> directions = climb.normals;
            for (int x = -1; x <= 1; ++x)
                for (int y = -1; y <= 1; ++y)
                    for (int z = -1; z <= 1; ++z)
                        if (9 * x + 3 * y + z > 0)
                            directions.push_back(unit(x * frame[0] + y * frame[1] + z * frame[2]));
            const double step = 1e-4 * std::max(climb.ball.radius, 1e-3 * pair.chord.length());
            for (const Vec3& d : directions) {
                const RayRange range = within(pair.box, climb.point, d);
                add_ray(climb.point, d, range);
                if (!beside) continue;
                const Vec3 u = unit(cross(d, std::abs(d.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
                add_ray(climb.point + step * u, d, range);
                add_ray(climb.point + step * cross(d, u), d, range);
            }
            firsts.push_back(rays.size());
        }
        trace();
        for_chunks(end - begin, 4, threads, [&](std::size_t i, std::size_t last, std::size_t) {
            std::vector<SharedPart> parts;
            std::vector<Line> lines;
            for (; i < last; ++i) {
                lines.clear();
                for (std::size_t ray = firsts[i]; ray < firsts[i + 1]; ray += group) {
                    Line line{.chord = {rays[ray], 0, 0}};
                    for (std::size_t k = 0; k < group; ++k) {
                        shared_parts(ray + k, parts);
                        const auto here = std::ranges::find_if(parts, [&](const SharedPart& p) {
                            return p.pair == climbs[begin + i].pair && p.in <= 0 && p.out >= 0;
                        });
                        if (here == parts.end()) break;
                        const auto& [origin, d] = rays[ray + k];
                        if (k == 0) line.chord = {rays[ray], here->in, here->out};
                        line.ends[0].push_back(origin + here->in * d);
                        line.ends[1].push_back(origin + here->out * d);
                    }
                    lines.push_back(line);
                }
                take(climbs[begin + i], lines);
            }
        });
    }
}

/// Finds the deepest point of each overlap along rays. Lines give planes that touch the boundary, and the next point of
/// a climb is as far as possible from all of them.
void OverlapSearch::climb_by_rays(std::span<const std::size_t> which) {
    std::vector<Climb> all, climbs;
    for (const std::size_t i : which)
        for (const Vec3& start : starts_of(i)) all.push_back({.pair = i, .point = start});
    for (std::size_t k = 0; k < all.size(); ++k)
        all[k].number = k > 0 && all[k - 1].pair == all[k].pair ? all[k - 1].number + 1 : 0;
    shoot_lines(all, 0, false, [](Climb& climb, std::vector<Line>& lines) {
        climb.ball = {climb.point, radius_of({}, lines, climb.point)};
    });
    for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
        while (end < all.size() && all[end].pair == all[first].pair) ++end;
        const auto of_pair = std::span(all).subspan(first, end - first);
        std::ranges::stable_sort(of_pair, std::greater{}, [](const Climb& c) { return c.ball.radius; });
        for (const Climb& climb : of_pair.first(std::min(climbs_of_pair, of_pair.size()))) {
            climbs.push_back(climb);
            climbs.back().ball.radius = 0;
        }
    }
    for (std::uint64_t round = 1; round <= rounds; ++round) {
        shoot_lines(climbs, round, true, [round](Climb& climb, std::vector<Line>& lines) {
            double reach = nowhere;
            for (const Line& line : lines)
                reach = std::min(reach, line.ends[0].empty() ? 0 : std::max(-line.chord.in, line.chord.out));
            if (reach == 0) {  // outside: back towards the last point that was inside
                climb.point = 0.5 * (climb.point + climb.ball.center);
                return;
            }
            const std::vector<TangentPlane> planes = planes_of(lines, climb.point);
            if (planes.empty()) return;
            const std::vector<TangentPlane> near = faced(planes, climb.point);
            if (const double radius = radius_of(near, lines, climb.point); radius > climb.ball.radius)
                climb.ball = {climb.point, radius};
            keep_normals(climb, planes);
            climb.point = climbed(planes, near, climb.point, 10 * reach, round % 2 == 1);
        });
    }
    for (Climb& climb : climbs) climb.point = climb.ball.center;
    for (std::uint64_t round = rounds + 1; round <= rounds + last_rounds; ++round) {
        shoot_lines(climbs, round, true, [](Climb& climb, std::vector<Line>& lines) {
            const std::vector<TangentPlane> planes = planes_of(lines, climb.point);
            climb.ball.radius = std::min(climb.ball.radius, radius_of(faced(planes, climb.point), lines, climb.point));
            keep_normals(climb, planes);
        });
    }
    for (const Climb& climb : climbs) {
        Pair& pair = pairs[climb.pair];
        if (climb.ball.radius > pair.ball.radius) pair.ball = climb.ball;
    }
}

void OverlapSearch::climb(std::span<const std::size_t> which) {
    climb_by_solids(which);
    std::vector<std::size_t> left;
    std::ranges::copy_if(which, std::back_inserter(left), [this](std::size_t i) { return !pairs[i].is_settled(); });
    climb_by_rays(left);
    climb_by_solids(left);
}

/// Finds a ray that shows each overlap, through its place.
void OverlapSearch::show(std::span<const std::size_t> which) {
    std::vector<Climb> climbs;
    for (const std::size_t i : which) climbs.push_back({.pair = i, .point = pairs[i].deepest().center});
    shoot_lines(climbs, 0, false, [this](Climb& climb, std::vector<Line>& lines) {
        RayPart& through = pairs[climb.pair].through;
        through = std::ranges::max_element(lines, {}, [](const Line& l) { return l.chord.length(); })->chord;
        if (!(through.length() > 0)) through = pairs[climb.pair].chord;
    });
}

}  // namespace csgrt::analysis
