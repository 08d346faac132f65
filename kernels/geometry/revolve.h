// Revolve: a sketch turned about an axis, all round or by an angle. Parameters: affine (12); local z is the axis, local
// x the direction where the turn begins; then REVOLVE_CUT. Words: the sketch; its x is the distance from the axis, its
// y the height. Planes: the two of the cut, then the planes that lines across the axis sweep; these lines come first in
// the sketch. Surfaces: 0 and 1 the cut, then the surfaces that the sketch's lines and curves sweep.
//
// Each crossing of the surface that the outline sweeps all round (hyperbola.h) turns inside into outside. The two half
// planes where the turn begins and ends cut the solid out of this body.
#ifndef CSGRT_GEOMETRY_REVOLVE_H
#define CSGRT_GEOMETRY_REVOLVE_H

#include "beside.h"
#include "cut.h"
#include "hyperbola.h"
#include "plane.h"

#define REVOLVE_CUT 12   // position of this parameter (shared/layout.h has its values)
#define REVOLVE_FACES 2  // surfaces of the cut
#define FLAT_SLACK           \
    BY_PRECISION(1e-5, 1e-9, \
                 1e-9)  // along the ray, between crossings of a plane and of its line: no more than rounding

FN cut meet_profile(cut k, GLOBAL const real* p, u32 degree, u32 stride, axis_ray a, u32 surface) {
    profile_walk w;
    radial_root root;
    if (!start_profile_walk(&w, p, degree, stride, a)) return k;
    while (next_profile_crossing(&w, a, &root)) k = cut_crossing(k, a.shift + root.s / a.speed, surface);
    return k;
}

// Adds the plane that a line across the axis sweeps. Another solid may share this plane, so the plane's t is used,
// unless the ray nearly runs along the plane.
FN cut meet_flat_line(cut k, GLOBAL const real* p, axis_ray a, Geometry g, u32 plane, ray3 r, u32 surface) {
    profile_walk w;
    radial_root root;
    if (!start_profile_walk(&w, p, 1, 2, a)) return k;
    while (next_profile_crossing(&w, a, &root)) {
        real t = face_distance(g, plane, r);
        if (!(real_abs((t - a.shift) * a.speed - root.s) <= FLAT_SLACK)) t = a.shift + root.s / a.speed;
        k = cut_crossing(k, t, surface);
    }
    return k;
}

FN u32 revolve_cut_faces(GLOBAL const real* p) { return p[REVOLVE_CUT] == REAL(REVOLVE_WHOLE) ? 0u : REVOLVE_FACES; }

// Are the planes of the cut the two sides of one plane? Then nothing lies between them, not even a ray within the
// plane.
FN int nothing_between(Geometry g, u32 index) { return (g.words[index] ^ g.words[index + 1]) == 1u; }

// The interval of the ray between the two planes of the cut. A ray that is moved aside of such a plane is on one side
// of the plane all the way.
FN span between_faces(Geometry g, u32 index, GLOBAL const real* p, ray3 r, beside b) {
    span s = whole_line();
    u32 i;
    for (i = 0; i < REVOLVE_FACES; ++i) {
        const PlaneRef ref = g.words[index + i];
        if (!b.step || !runs_in(g.planes[ref >> 1], r)) {
            s = clip_to_face(s, g, index + i, r, i);
        } else if (goes_out(b, p, r, g.planes[ref >> 1], ref & 1u)) {
            s.low = REAL_INFINITY;
            s.high = -REAL_INFINITY;
        }
    }
    return s;
}

// The planes of the cut and of lines across the axis in which the ray runs.
FN beside find_flat_lines(Geometry g, SolidRecord solid, ray3 r) {
    beside b = not_beside();
    u32 i;
    for (i = 0; i < solid.plane_count; ++i) {
        const PlaneRecord plane = g.planes[g.words[solid.first_plane + i] >> 1];
        if (runs_in(plane, r)) b = add_plane(b, plane, r);
    }
    return b;
}

FN crossings revolve_cross(Geometry g, SolidRecord solid, ray3 r, crossings c, beside b, u32* near) {
    GLOBAL const real* p = g.reals + solid.first_real;
    sketch s = sketch_of(g, solid);
    axis_ray a = around_axis(moved_aside(to_local(p, r), b, p, r));
    u32 faces = revolve_cut_faces(p), i;
    u32 flat_lines = solid.plane_count - faces;
    span between = whole_line();
    cut k;
    for (i = 0; !b.step && i < solid.plane_count; ++i)
        *near |= (u32)runs_in(g.planes[g.words[solid.first_plane + i] >> 1], r);
    if (faces) between = between_faces(g, solid.first_plane, p, r, b);
    if (!faces || nothing_between(g, solid.first_plane)) {
        between.low = REAL_INFINITY;
        between.high = -REAL_INFINITY;
    }
    k = start_cut(between, p[REVOLVE_CUT] == REAL(REVOLVE_LESS), c);
    for (i = 0; i < s.line_count; ++i) {
        u32 surface = REVOLVE_FACES + i;
        k = i < flat_lines ? meet_flat_line(k, s.lines + 4 * i, a, g, solid.first_plane + faces + i, r, surface)
                           : meet_profile(k, s.lines + 4 * i, 1, 2, a, surface);
    }
    for (i = 0; i < s.curve_count; ++i)
        k = meet_profile(k, g.reals + s.curves[2 * i], s.curves[2 * i + 1], 3, a, REVOLVE_FACES + s.line_count + i);
    return end_cut(k);
}

// The local normal of the surface that a line or curve sweeps, where the ray crosses it nearest to t.
FN vec3 profile_normal(GLOBAL const real* p, u32 degree, u32 stride, axis_ray a, vec3 at, real t) {
    profile_walk w;
    radial_root root;
    real nearest = REAL_INFINITY;
    vec3 n = make_vec3(0, 0, 0);
    if (!start_profile_walk(&w, p, degree, stride, a)) return n;
    while (next_profile_crossing(&w, a, &root)) {
        real off = real_abs(a.shift + root.s / a.speed - t);
        if (off < nearest) {
            profile_point c = profile_at(p, degree, stride, root.at);
            real rho = real_sqrt(real_fma(at.x, at.x, at.y * at.y));
            nearest = off;
            // The vector across the tangent, times the distance to the axis. On the axis the vector runs along the
            // axis, since only a curve that runs across the axis has a normal there.
            n = rho > 0 ? make_vec3(c.dz * at.x, c.dz * at.y, -c.dr * rho) : make_vec3(0, 0, -c.dr);
        }
    }
    return n;
}

FN vec3 revolve_normal(Geometry g, SolidRecord solid, ray3 r, real t, u32 surface) {
    GLOBAL const real* p = g.reals + solid.first_real;
    sketch s = sketch_of(g, solid);
    u32 leaves = surface & LEAVES;
    u32 face = surface & ~LEAVES;
    vec3 n;
    if (face < REVOLVE_FACES) {
        n = face_normal(g, solid.first_plane + face);
    } else {
        axis_ray a = around_axis(to_local(p, r));
        vec3 at = local_point(to_local(p, r), t);
        u32 piece = face - REVOLVE_FACES;
        if (piece < s.line_count) {
            n = profile_normal(s.lines + 4 * piece, 1, 2, a, at, t);
        } else {
            GLOBAL const u32* curve = s.curves + 2 * (piece - s.line_count);
            n = profile_normal(g.reals + curve[0], curve[1], 3, a, at, t);
        }
        n = affine_normal(p, n);
    }
    return (dot3(n, r.d) > 0) == (leaves != 0) ? n : scale(n, REAL(-1));
}

#endif
