// Beside: a ray that runs in flat faces of a solid whose crossings are found one by one (meshes, extrusions, ...).
// Rounding decides on which side of each face the ray is. So the solid is intersected with the ray moved a step aside
// of all these faces: above them (touch.h), then below. A segment that is found on one side alone is marked with the
// other sides.
//
//                  above                   Seen along the ray, which is the point 0: the faces are lines through 0.
//         high \     ^     / low           Their normals are turned to point above, and the two outermost of them are
//               \ 1  |    /                kept. A step between these goes to one side of every face.
//          4     \   |   /     3
//       ----------\--0--/-----------       Where the ray runs in several faces, the solid may lie between them, on the
//                 /     \                  ray's left and right alone: steps 3 and 4.
//                /   2   \                 (drawn: the steps and the two outermost faces)
//
// The result has four sides: above, below, left and right. A step gives the result for each side that lies between the
// same faces; left and right may lie above all faces, or below.
//
// A normal n is known by n . above and n . left (touch.h): n . d is 0.
#ifndef CSGRT_GEOMETRY_BESIDE_H
#define CSGRT_GEOMETRY_BESIDE_H

#include "quadratic.h"
#include "touch.h"

// Distances in units of the rounding of one number. IN_FACE: a face's corner that is no farther off a plane through the
// ray counts as in this plane. ASIDE: the distance by which the ray is moved.
#define IN_FACE REAL(1)
#define ASIDE REAL(8)
#define STEEPEST REAL(0x1p60)
#define SAME_FACE REAL(0x1p-20)  // two faces are one if the angle between their normals is smaller

// The outermost faces in which a ray runs, and the current step aside.
typedef struct {
    u32 step;        // 0: the ray is not moved; else 1 to 4
    u32 found;       // the ray runs in some face
    real low, high;  // n . left / n . above of the two outermost faces
} beside;

FN beside not_beside(void) {
    beside b;
    b.step = b.found = 0;
    b.low = b.high = 0;
    return b;
}

// Adds a face. Its normal has the given products with `above` and `left`.
FN beside add_face(beside b, real n_above, real n_left) {
    real slope = n_left / n_above;
    if (!(real_abs(slope) < STEEPEST)) slope = n_left < 0 ? -STEEPEST : STEEPEST;
    b.low = b.found && b.low < slope ? b.low : slope;
    b.high = b.found && b.high > slope ? b.high : slope;
    b.found = 1;
    return b;
}

// Adds a face in a plane of the world, or a face across n in the solid's own space.
RARE_FN beside add_plane(beside b, PlaneRecord plane, ray3 r) {
    const vec3 n = narrow(plane_normal(plane));
    return add_face(b, dot3(n, above_faces()), dot3(n, left_of_ray(r)));
}
RARE_FN beside add_local_face(beside b, vec3 n, GLOBAL const real* p, ray3 r) {
    return add_face(b, dot3(n, affine_linear(p, above_faces())), dot3(n, affine_linear(p, left_of_ray(r))));
}

// The normal of a face in the solid's own space, from its products with `above` and `left`.
RARE_FN vec3 local_normal(GLOBAL const real* p, ray3 r, real n_above, real n_left) {
    const vec3 d = affine_linear(p, r.d), above = affine_linear(p, above_faces()),
               left = affine_linear(p, left_of_ray(r));
    const vec3 n = add_scaled(scale(cross3(left, d), n_above), n_left, cross3(d, above));
    return normalize3(dot3(d, cross3(above, left)) < 0 ? scale(n, REAL(-1)) : n);
}

// The vector by which the local ray is moved.
RARE_FN vec3 aside(beside b, GLOBAL const real* p, ray3 r) {
    const vec3 low = local_normal(p, r, REAL(1), b.low), high = local_normal(p, r, REAL(1), b.high);
    const vec3 way = b.step <= 2 ? add(high, low) : subtract(high, low);
    const vec3 e = local_roundings(p, r);
    const real most = real_abs(way.x) * e.x + real_abs(way.y) * e.y + real_abs(way.z) * e.z;
    const real size = ASIDE * most / dot3(way, way);
    return scale(way, b.step & 1u ? size : -size);
}

// Does the moved ray go out of a face of the solid that lies in this plane?
RARE_FN int goes_out(beside b, GLOBAL const real* p, ray3 r, PlaneRecord plane, u32 flipped) {
    const vec3 n = narrow(plane_normal(plane));
    const vec3 out = local_normal(p, r, dot3(n, above_faces()), dot3(n, left_of_ray(r)));
    return (dot3(out, aside(b, p, r)) > 0) == !flipped;
}

FN local_ray moved_aside(local_ray l, beside b, GLOBAL const real* p, ray3 r) {
    if (b.step) l.o = add(l.o, aside(b, p, r));
    return l;
}

// The sides to which the current step belongs; 0: none.
FN u32 sides_of_step(beside b) {
    const u32 left_is_above = b.low >= 0, left_is_below = b.high < 0, is_between = !left_is_above && !left_is_below;
    if (b.step == 1) return MISSED_ABOVE | (left_is_above ? MISSED_LEFT : left_is_below ? MISSED_RIGHT : 0u);
    if (b.step == 2) return MISSED_BELOW | (left_is_above ? MISSED_RIGHT : left_is_below ? MISSED_LEFT : 0u);
    return !is_between ? 0u : b.step == 3 ? MISSED_LEFT : MISSED_RIGHT;
}

// The marks of the segments' boundaries: all other sides.
FN u32 missed_beside(beside b) { return b.step == 0 ? 0 : MISSED & ~sides_of_step(b); }

// Moves to the next step. Returns 0 if no step is left.
FN u32 next_step(beside* b) {
    const u32 last = b->high - b->low > SAME_FACE * (REAL(1) + real_abs(b->high * b->low)) ? 4u : 2u;
    ++b->step;
    return b->found && b->step <= last;
}

// Corners seen along the ray, which is the point 0 (triangle.h). Do they lie in one line through the ray, with the ray
// among them, as far as rounding lets csgrt tell? `direction`: the direction of the line.
RARE_FN int in_line(vec3 a, vec3 b, vec3 c, vec3 d, real rounding, vec3* direction) {
    const real low_x = real_min(real_min(a.x, b.x), real_min(c.x, d.x));
    const real high_x = real_max(real_max(a.x, b.x), real_max(c.x, d.x));
    const real low_y = real_min(real_min(a.y, b.y), real_min(c.y, d.y));
    const real high_y = real_max(real_max(a.y, b.y), real_max(c.y, d.y));
    vec3 far = a;
    real reach;
    if (low_x > rounding || high_x < -rounding || low_y > rounding || high_y < -rounding) return 0;
    if (real_abs(b.x) + real_abs(b.y) > real_abs(far.x) + real_abs(far.y)) far = b;
    if (real_abs(c.x) + real_abs(c.y) > real_abs(far.x) + real_abs(far.y)) far = c;
    if (real_abs(d.x) + real_abs(d.y) > real_abs(far.x) + real_abs(far.y)) far = d;
    *direction = far;
    reach = rounding * (real_abs(far.x) + real_abs(far.y));
    return reach > 0 && real_abs(difference_of_products(far.x, a.y, far.y, a.x)) <= reach &&
           real_abs(difference_of_products(far.x, b.y, far.y, b.x)) <= reach &&
           real_abs(difference_of_products(far.x, c.y, far.y, c.x)) <= reach &&
           real_abs(difference_of_products(far.x, d.y, far.y, d.x)) <= reach;
}

#endif
