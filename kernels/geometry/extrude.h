// Extrude, ebm: the inside of a sketch, moved along a line. Parameters: affine (12); local x and y are the sketch's
// own, z runs from -1 to 1 along the height. Words: the sketch. Planes: the cap at z = -1, the cap at z = 1, then the
// walls over the sketch's lines. Surfaces: 0 and 1 the caps, then the walls over the sketch's lines and curves.
//
// Seen along the height the ray is a line in the sketch's plane. Each crossing of the outline turns inside into outside
// (even-odd), and the caps cut the solid out of this prism. The side of the line on which a point lies is the sign of
// one expression. So all lines and curves that meet in a point get the same side, and a closed outline has an even
// number of crossings, whether the ray hits vertices or not.
#ifndef CSGRT_GEOMETRY_EXTRUDE_H
#define CSGRT_GEOMETRY_EXTRUDE_H

#include "../traversal/bvh_cursor.h"
#include "bernstein.h"
#include "curve.h"
#include "cut.h"
#include "plane.h"
#include "polynomial.h"
#include "triangle.h"

#define EXTRUDE_ENDS 2
#define WALL_SLACK           \
    BY_PRECISION(1e-5, 1e-9, \
                 1e-9)  // along the ray, between crossings of a plane and of its line: no more than rounding

// A line in the sketch's plane; (dx, dy) is a unit vector.
typedef struct {
    real ox, oy, dx, dy;
} line2;

FN real side_of(line2 l, real x, real y) { return difference_of_products(l.dx, y - l.oy, l.dy, x - l.ox); }
FN real place_along(line2 l, real x, real y) { return real_fma(l.dx, x - l.ox, l.dy * (y - l.oy)); }

// The ray in the sketch's plane.
typedef struct {
    local_ray ray;
    line2 line;
    real speed;  // change of the line's parameter as t grows; 0: the ray runs along the height
    real slack;  // WALL_SLACK in units of t
    int steep;   // the ray nearly runs along the height: then rounding decides the line's direction
} sketch_ray;
#define STEEP REAL(0x1p-20)

// The sketch_ray of a local ray. A ray along the height has no direction in the sketch's plane. Then any line through
// the ray's point serves.
FN sketch_ray to_sketch(local_ray l) {
    sketch_ray w;
    const real length = real_sqrt(dot3(l.d, l.d));
    real most;
    w.ray = l;
    w.slack = WALL_SLACK / length;
    w.line.ox = w.ray.o.x;
    w.line.oy = w.ray.o.y;
    w.line.dx = 1;
    w.line.dy = w.speed = 0;
    most = real_max(real_abs(w.ray.d.x), real_abs(w.ray.d.y));
    if (most > 0) {
        real x = w.ray.d.x / most, y = w.ray.d.y / most;
        real size = real_sqrt(real_fma(x, x, y * y));
        w.line.dx = x / size;
        w.line.dy = y / size;
        w.speed = most * size;
    }
    w.steep = w.speed < STEEP * length;
    return w;
}

// The distance of a point along the line. A ray along the height is inside the outline all the way if an odd number of
// crossings lies to one side of it. Crossings on this side get the distance -infinity, the others +infinity.
FN real distance_at(sketch_ray w, real place) {
    if (w.speed == 0) return place > 0 ? -REAL_INFINITY : REAL_INFINITY;
    return w.ray.shift + place / w.speed;
}

// May the ray run in the wall over a line? add_wall tests more exactly. The limit is above rounding, however far away
// the ray starts.
#define IN_WALL REAL(0x1p-30)
FN int may_run_in_wall(sketch_ray w, GLOBAL const real* p) {
    if (real_abs(side_of(w.line, p[0], p[1])) <= IN_WALL && real_abs(side_of(w.line, p[2], p[3])) <= IN_WALL) return 1;
    return w.steep &&
           real_abs(difference_of_products(p[2] - p[0], w.line.oy - p[1], p[3] - p[1], w.line.ox - p[0])) <= IN_WALL;
}

FN beside add_wall(beside b, sketch_ray w, GLOBAL const real* p, GLOBAL const real* place, ray3 r) {
    const upright_ray u = make_upright(w.ray);
    const vec3 low0 = seen_along(u, make_vec3(p[0], p[1], REAL(-1)));
    const vec3 low1 = seen_along(u, make_vec3(p[2], p[3], REAL(-1)));
    const vec3 high0 = seen_along(u, make_vec3(p[0], p[1], REAL(1)));
    const vec3 high1 = seen_along(u, make_vec3(p[2], p[3], REAL(1)));
    vec3 direction;
    if (in_line(low0, low1, high0, high1, seen_rounding(u, place, r), &direction))
        b = add_local_face(b, normal_of_line(u, direction), place, r);
    return b;
}

FN cut meet_line(cut k, sketch_ray w, GLOBAL const real* p, Geometry g, u32 plane, ray3 r, u32 surface) {
    real side0 = side_of(w.line, p[0], p[1]), side1 = side_of(w.line, p[2], p[3]);
    real place, t, to_wall;
    if ((side0 > 0) == (side1 > 0)) return k;
    place = place_along(w.line, p[0], p[1]);
    place = real_fma(place_along(w.line, p[2], p[3]) - place, side0 / (side0 - side1), place);
    t = distance_at(w, place);
    // Another solid may share the wall's plane, so the plane's t is used, except for rays that nearly run along the
    // wall.
    to_wall = face_distance(g, plane, r);
    return cut_crossing(k, real_abs(to_wall - t) <= w.slack ? to_wall : t, surface);
}

// Can the line cross anything in a box? Boxes have a padding that is far larger than rounding.
FN int enters_box(line2 l, BvhNode box) {
    real x = REAL(0.5) * (REAL(box.low[0]) + REAL(box.high[0])), y = REAL(0.5) * (REAL(box.low[1]) + REAL(box.high[1]));
    real half_x = REAL(box.high[0]) - x, half_y = REAL(box.high[1]) - y;
    return real_abs(side_of(l, x, y)) <= real_fma(real_abs(l.dx), half_y, real_abs(l.dy) * half_x);
}

FN cut meet_lines(cut k, sketch_ray w, Geometry g, SolidRecord solid, sketch s, ray3 r, u32* near) {
    bvh_cursor c = bvh_over(s.node_count);
    while (bvh_goes_on(c)) {
        const BvhNode node = s.nodes[c.node];
        const u32 leaf = bvh_step(&c, node, enters_box(w.line, node));
        u32 line = leaf >> BVH_LEAF_SHIFT, end = line + (leaf & BVH_LEAF_MASK);
        for (; line < end; ++line) {
            u32 surface = EXTRUDE_ENDS + line;
            *near |= (u32)may_run_in_wall(w, s.lines + 4 * line);
            k = meet_line(k, w, s.lines + 4 * line, g, solid.first_plane + surface, r, surface);
        }
    }
    return k;
}

// The walls in which the ray runs.
FN beside find_walls(Geometry g, SolidRecord solid, ray3 r) {
    GLOBAL const real* place = g.reals + solid.first_real;
    const sketch s = sketch_of(g, solid);
    const sketch_ray w = to_sketch(to_local(place, r));
    beside b = not_beside();
    bvh_cursor c = bvh_over(s.node_count);
    while (bvh_goes_on(c)) {
        const BvhNode node = s.nodes[c.node];
        const u32 leaf = bvh_step(&c, node, enters_box(w.line, node));
        u32 line = leaf >> BVH_LEAF_SHIFT, end = line + (leaf & BVH_LEAF_MASK);
        for (; line < end; ++line)
            if (may_run_in_wall(w, s.lines + 4 * line)) b = add_wall(b, w, s.lines + 4 * line, place, r);
    }
    return b;
}

// The point of a curve on the line. Between the two parameters of `found` the curve changes sides.
FN curve_point point_on_line(GLOBAL const real* p, u32 degree, line2 l, sign_walk found) {
    bracket b = start_bracket(found.low, found.high, !found.positive);
    curve_point at = curve_at(p, degree, b.at);
    int step;
    for (step = 0; step < BRACKET_STEPS && !b.done; ++step) {
        real value = difference_of_products(l.dx, real_fma(-l.oy, at.w, at.y), l.dy, real_fma(-l.ox, at.w, at.x));
        real slope = difference_of_products(l.dx, real_fma(-l.oy, at.dw, at.dy), l.dy, real_fma(-l.ox, at.dw, at.dx));
        b = newton_step(b, value, slope);
        at = curve_at(p, degree, b.at);
    }
    return at;
}

// The sides of a curve's control points, as the coefficients of a polynomial. Its sign is the side on which the curve
// is.
FN void sides_of(GLOBAL const real* p, u32 degree, line2 l, real* c) {
    u32 i;
    for (i = 0; i <= degree; ++i) c[i] = p[3 * i + 2] * side_of(l, p[3 * i], p[3 * i + 1]);
}

FN cut meet_curve(cut k, sketch_ray w, GLOBAL const real* p, u32 degree, u32 surface) {
    real c[BERNSTEIN_SIZE];
    sign_walk signs;
    sides_of(p, degree, w.line, c);
    if (coefficient_changes(c, degree) == 0) return k;
    signs = start_sign_walk(c);
    while (next_sign_change(c, degree, &signs)) {
        curve_point at = point_on_line(p, degree, w.line, signs);
        k = cut_crossing(k, distance_at(w, place_along(w.line, at.x / at.w, at.y / at.w)), surface);
    }
    return k;
}

FN crossings extrude_cross(Geometry g, SolidRecord solid, ray3 r, crossings c, beside b, u32* near) {
    GLOBAL const real* p = g.reals + solid.first_real;
    sketch s = sketch_of(g, solid);
    span ends = whole_line();
    sketch_ray w;
    cut k;
    u32 i;
    ends = clip_to_face(ends, g, solid.first_plane, r, 0);
    ends = clip_to_face(ends, g, solid.first_plane + 1, r, 1);
    if (!(ends.low < ends.high)) return c;
    if (ends.touched) c.missed |= missed_of_planes(g, solid.first_plane, EXTRUDE_ENDS, r);
    w = to_sketch(moved_aside(to_local(p, r), b, p, r));
    k = start_cut(ends, 1, c);
    k = meet_lines(k, w, g, solid, s, r, near);
    for (i = 0; i < s.curve_count; ++i)
        k = meet_curve(k, w, g.reals + s.curves[2 * i], s.curves[2 * i + 1], EXTRUDE_ENDS + s.line_count + i);
    return end_cut(k);
}

// The normal of the wall over a curve where the ray crosses it nearest to t.
FN vec3 curved_wall_normal(GLOBAL const real* p, GLOBAL const real* curve, u32 degree, ray3 r, real t) {
    sketch_ray w = to_sketch(to_local(p, r));
    real c[BERNSTEIN_SIZE];
    real nearest = REAL_INFINITY;
    vec3 n = make_vec3(0, 0, 0);
    sign_walk signs;
    sides_of(curve, degree, w.line, c);
    signs = start_sign_walk(c);
    while (next_sign_change(c, degree, &signs)) {
        curve_point at = point_on_line(curve, degree, w.line, signs);
        real x = at.x / at.w, y = at.y / at.w;
        real off = real_abs(distance_at(w, place_along(w.line, x, y)) - t);
        if (off < nearest) {
            nearest = off;
            n = make_vec3(real_fma(-y, at.dw, at.dy), -real_fma(-x, at.dw, at.dx), 0);  // across the tangent
        }
    }
    return affine_normal(p, n);
}

FN vec3 extrude_normal(Geometry g, SolidRecord solid, ray3 r, real t, u32 surface) {
    sketch s = sketch_of(g, solid);
    u32 leaves = surface & LEAVES;
    u32 wall = surface & ~LEAVES;
    vec3 n;
    if (wall < EXTRUDE_ENDS) return face_normal(g, solid.first_plane + wall);
    if (wall < EXTRUDE_ENDS + s.line_count) {
        n = face_normal(g, solid.first_plane + wall);
    } else {
        GLOBAL const u32* curve = s.curves + 2 * (wall - EXTRUDE_ENDS - s.line_count);
        n = curved_wall_normal(g.reals + solid.first_real, g.reals + curve[0], curve[1], r, t);
    }
    // The inner side of a curve is not stored, so the ray's direction decides.
    return (dot3(n, r.d) > 0) == (leaves != 0) ? n : scale(n, REAL(-1));
}

#endif
