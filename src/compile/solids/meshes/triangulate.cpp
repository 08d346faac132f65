#include "compile/solids/meshes/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "compile/linear.hpp"

namespace csgrt {

namespace {

struct Point {
    long double x, y;
    friend bool operator==(const Point&, const Point&) = default;
};

/// Twice the area of a triangle, positive counterclockwise.
long double area(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Newell's normal: its components are the loop's areas seen along each axis.
Wide normal_of(const std::vector<Vec3>& vertices, const std::vector<std::uint32_t>& loop) {
    Wide n(0);
    const Wide origin = wide(vertices[loop[0]]);
    for (std::size_t i = 0; i < loop.size(); ++i)
        n += glm::cross(wide(vertices[loop[i]]) - origin, wide(vertices[loop[(i + 1) % loop.size()]]) - origin);
    return n;
}

/// One polygon as a ring of corners, from which ears are cut.
class Polygon {
public:
    Polygon(const std::vector<Vec3>& vertices, const Wide& normal) : vertices_(vertices) {
        // The polygon is seen along the axis that the normal is nearest to, counterclockwise.
        const Wide size = glm::abs(normal);
        const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        x_ = (axis + 1) % 3;
        y_ = (axis + 2) % 3;
        if (normal[axis] < 0) std::swap(x_, y_);
    }

    void outline(const std::vector<std::uint32_t>& loop) { start_ = ring(loop, area_of(loop) < 0); }
    void holes(const std::vector<std::vector<std::uint32_t>>& loops, std::size_t outline) {
        std::vector<std::size_t> rightmost;
        for (std::size_t i = 0; i < loops.size(); ++i) {
            if (i == outline || loops[i].empty()) continue;
            const std::size_t first = ring(loops[i], area_of(loops[i]) > 0);
            std::size_t best = first;
            for (std::size_t c = corners_[first].next; c != first; c = corners_[c].next)
                if (at(c).x > at(best).x) best = c;
            rightmost.push_back(best);
        }
        std::stable_sort(rightmost.begin(), rightmost.end(),
                         [&](std::size_t a, std::size_t b) { return at(a).x > at(b).x; });
        for (const std::size_t corner : rightmost) bridge(corner);
    }
    void cut(std::vector<std::array<std::uint32_t, 3>>& triangles);

private:
    struct Corner {
        std::uint32_t vertex;
        std::size_t prev, next;
    };

    Point point(std::uint32_t vertex) const {
        const Wide p = wide(vertices_[vertex]);
        return {p[x_], p[y_]};
    }
    Point at(std::size_t corner) const { return point(corners_[corner].vertex); }
    long double turn(std::size_t corner) const {
        return area(at(corners_[corner].prev), at(corner), at(corners_[corner].next));
    }
    long double area_of(const std::vector<std::uint32_t>& loop) const {
        long double sum = 0;
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            sum += area(point(loop[0]), point(loop[i]), point(loop[i + 1]));
        return sum;
    }

    std::size_t ring(const std::vector<std::uint32_t>& loop, bool backward) {
        const std::size_t first = corners_.size(), count = loop.size();
        for (std::size_t i = 0; i < count; ++i)
            corners_.push_back(
                {loop[backward ? count - 1 - i : i], first + (i + count - 1) % count, first + (i + 1) % count});
        return first;
    }
    void join(std::size_t a, std::size_t b) {
        corners_[a].next = b;
        corners_[b].prev = a;
    }

    /// Does the direction from a corner to p lead into the polygon? Bridges make copies of a corner; for one of the
    /// copies the answer is yes.
    bool opens_towards(std::size_t corner, const Point& p) const {
        const bool in = area(at(corners_[corner].prev), at(corner), p) >= 0;
        const bool out = area(at(corner), at(corners_[corner].next), p) >= 0;
        return turn(corner) < 0 ? in || out : in && out;
    }

    void bridge(std::size_t hole);
    bool is_ear(std::size_t corner) const;

    const std::vector<Vec3>& vertices_;
    int x_ = 0, y_ = 1;
    std::vector<Corner> corners_;
    std::size_t start_ = 0;
};

/// Joins a hole to the outline by a bridge: an edge there and back, from the hole's rightmost corner to a visible
/// corner of the outline.
void Polygon::bridge(std::size_t hole) {
    const Point h = at(hole);
    // The nearest edge to the right, and its end that lies farther right.
    long double nearest = std::numeric_limits<long double>::infinity();
    std::size_t seen = start_;
    bool found = false;
    std::size_t c = start_;
    do {
        const std::size_t next = corners_[c].next;
        const Point p = at(c), q = at(next);
        if (p.y != q.y && std::min(p.y, q.y) <= h.y && h.y <= std::max(p.y, q.y)) {
            const long double x = p.x + (h.y - p.y) / (q.y - p.y) * (q.x - p.x);
            // The outline runs counterclockwise: its inside is to the left of an upward edge. The edge's end may have
            // several copies; the ray ends at the copy that opens towards the hole.
            const std::size_t end = p.y == h.y ? c : q.y == h.y ? next : p.x > q.x ? c : next;
            const bool meets = at(end).y != h.y || opens_towards(end, h);
            if (x >= h.x && x < nearest && p.y < q.y && meets) {
                nearest = x;
                seen = end;
                found = true;
            }
        }
        c = next;
    } while (c != start_);
    // Corners within the triangle of hole, edge and this end may hide the end. Then the bridge leads to the corner that
    // is least off the line.
    if (found && at(seen).y != h.y) {
        const Point foot{nearest, h.y}, end = at(seen);
        const long double side = area(h, foot, end) > 0 ? 1 : -1;
        long double least = std::fabs(end.y - h.y) / (end.x - h.x);
        const std::size_t target = seen;
        c = start_;
        do {
            const Point p = at(c);
            if (c != target && p != h && p.x >= h.x && opens_towards(c, h) && side * area(h, foot, p) >= 0 &&
                side * area(foot, end, p) >= 0 && side * area(end, h, p) >= 0 && p.x > h.x) {
                const long double slope = std::fabs(p.y - h.y) / (p.x - h.x);
                if (slope < least || (slope == least && p.x < at(seen).x)) {
                    least = slope;
                    seen = c;
                }
            }
            c = corners_[c].next;
        } while (c != start_);
    }
    const std::size_t seen_again = corners_.size(), hole_again = seen_again + 1;
    corners_.push_back(corners_[seen]);
    corners_.push_back(corners_[hole]);
    join(seen_again, corners_[seen].next);
    join(corners_[hole].prev, hole_again);
    join(seen, hole);
    join(hole_again, seen_again);
}

/// An ear is a corner that turns left, with no other corner in its triangle. Only corners that turn right can be in it.
bool Polygon::is_ear(std::size_t corner) const {
    const std::size_t prev = corners_[corner].prev, next = corners_[corner].next;
    const Point a = at(prev), b = at(corner), c = at(next);
    if (!(area(a, b, c) > 0)) return false;
    for (std::size_t i = corners_[next].next; i != prev; i = corners_[i].next) {
        const Point p = at(i);
        if (p == a || p == b || p == c || turn(i) > 0) continue;
        if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
    }
    return true;
}

void Polygon::cut(std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::size_t left = 1;
    for (std::size_t c = corners_[start_].next; c != start_; c = corners_[c].next) ++left;
    std::size_t corner = start_, misses = 0;
    bool any = false;  // no corner is an ear: the next corner is cut off
    while (left >= 3) {
        const std::size_t prev = corners_[corner].prev, next = corners_[corner].next;
        if (!any && turn(corner) != 0 && !is_ear(corner)) {
            any = ++misses > left;
            corner = next;
            continue;
        }
        triangles.push_back({corners_[prev].vertex, corners_[corner].vertex, corners_[next].vertex});
        join(prev, next);
        --left;
        misses = 0;
        corner = corners_[next].next;  // alternates, so that no corner becomes the tip of a fan
    }
}

}  // namespace

void triangulate(const std::vector<Vec3>& vertices, const std::vector<std::vector<std::uint32_t>>& loops,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::size_t outline = loops.size();
    Wide normal(0);
    for (std::size_t i = 0; i < loops.size(); ++i) {
        if (loops[i].empty()) continue;
        const Wide n = normal_of(vertices, loops[i]);
        if (outline < loops.size() && glm::dot(n, n) <= glm::dot(normal, normal)) continue;
        outline = i;
        normal = n;
    }
    if (outline == loops.size()) return;
    Polygon polygon(vertices, normal);
    polygon.outline(loops[outline]);
    polygon.holes(loops, outline);
    polygon.cut(triangles);
}

}  // namespace csgrt
