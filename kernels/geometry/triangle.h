// Triangle: a ray and the triangles of one mesh, watertight. The boundary of a volume is crossed an even number of
// times, whatever the rounding, through edges and vertices too.
//
// The axes are turned so that the ray runs mostly along z, and sheared so that it runs exactly along z (Woop, Benthin,
// Wald 2013). A vertex is transformed by the same arithmetic for all its triangles:
//
//        y |    c                 The ray is the point 0. It meets a triangle whose three edges all have it on the
//          |   / \                same side: sign(a x b) = sign(b x c) = sign(c x a).
//          |  / 0 \               These signs are exact. A zero (0 on an edge, or on a vertex) is decided as if the ray
//          | a-----b              stood a hair aside, at (e, e^2): then every point of the plane lies in as many
//          +---------- x          triangles as a point beside it (simulation of simplicity, Edelsbrunner, Muecke 1990).
//
// Parameters: affine (12). A mesh keeps its vertices around its middle, scaled by a power of two so that all of them
// lie within MESH_RADIUS of it.
#ifndef CSGRT_GEOMETRY_TRIANGLE_H
#define CSGRT_GEOMETRY_TRIANGLE_H

#include "beside.h"
#include "polynomial.h"

#define MESH_RADIUS REAL(1)

// Words of a mesh, which all its instances share; then three vertices a triangle, in the order of the hierarchy's
// leaves.
#define MESH_VERTICES 0  // position of the vertices in `reals`
#define MESH_NODES 1     // position of the hierarchy in `inner_nodes`
#define MESH_NODE_COUNT 2
#define MESH_FACING 3     // 0: any; else corners run counterclockwise (1) or clockwise (2), seen from outside
#define MESH_TRIANGLES 4  // the first triangle's word

// A ray after its axes are turned and sheared, so that it runs along z.
typedef struct {
    local_ray ray;
    int axis;      // the axis along which the ray runs most
    real slope_x;  // the shears of the other two axes
    real slope_y;
} upright_ray;

// The coordinates in cyclic order, with the coordinate of `axis` last.
FN vec3 turned(vec3 v, int axis) {
    return axis == 2 ? v : axis == 1 ? make_vec3(v.z, v.x, v.y) : make_vec3(v.y, v.z, v.x);
}

FN upright_ray make_upright(local_ray l) {
    upright_ray u;
    real x = real_abs(l.d.x), y = real_abs(l.d.y), z = real_abs(l.d.z);
    vec3 d;
    u.axis = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
    d = turned(l.d, u.axis);
    u.ray = l;
    u.slope_x = d.x / d.z;
    u.slope_y = d.y / d.z;
    return u;
}

// The coordinate, or 0 if it is so small that it may be rounding: the products of two such coordinates would not be
// exact.
FN real flushed(real x) { return real_abs(x) < REAL(0x1p-50) ? REAL(0) : x; }

// A point seen along the ray: (x, y) is 0 on the ray, and z measures along the ray's main axis.
FN vec3 seen_along(upright_ray u, vec3 point) {
    const vec3 p = turned(subtract(point, u.ray.o), u.axis);
    return make_vec3(flushed(real_fma(-u.slope_x, p.z, p.x)), flushed(real_fma(-u.slope_y, p.z, p.y)), p.z);
}

FN vec3 upright_vertex(upright_ray u, GLOBAL const real* v) { return seen_along(u, make_vec3(v[0], v[1], v[2])); }

// The side of the edge from a to b on which the ray passes: 1, -1, or 0 for an edge that has no length. `product` is a
// x b. Where the product is 0, its rate of change as 0 moves to (e, e^2) decides.
FN int side_of_edge(vec3 a, vec3 b, real product) {
    real rate = product != 0 ? product : a.y != b.y ? a.y - b.y : b.x - a.x;
    return rate > 0 ? 1 : rate < 0 ? -1 : 0;
}

// The answer of the test of one triangle.
typedef struct {
    int hit;
    real t;         // along the ray
    int clockwise;  // seen along the ray
    int edge_on;    // the products of all edges' points are nearly 0: the triangle is seen edge-on, or very small
    int edge;       // the product of some edge's points is nearly 0
} triangle_hit;

// Intersects the ray and the triangle. `edge_on`: products below this limit count as nearly 0.
FN triangle_hit meet_triangle(upright_ray u, real edge_on, GLOBAL const real* vertices, GLOBAL const u32* corners) {
    triangle_hit h;
    vec3 a = upright_vertex(u, vertices + 3 * (size_t)corners[0]);
    vec3 b = upright_vertex(u, vertices + 3 * (size_t)corners[1]);
    vec3 c = upright_vertex(u, vertices + 3 * (size_t)corners[2]);
    real wc = difference_of_products(a.x, b.y, a.y, b.x);
    real wa = difference_of_products(b.x, c.y, b.y, c.x);
    real wb = difference_of_products(c.x, a.y, c.y, a.x);
    int side = side_of_edge(a, b, wc);
    real z;
    h.edge_on = real_abs(wa) <= edge_on && real_abs(wb) <= edge_on && real_abs(wc) <= edge_on;
    h.edge = real_abs(wa) <= edge_on || real_abs(wb) <= edge_on || real_abs(wc) <= edge_on;
    h.hit = side != 0 && side_of_edge(b, c, wa) == side && side_of_edge(c, a, wb) == side;
    h.t = 0;
    h.clockwise = (side > 0) == (turned(u.ray.d, u.axis).z > 0);
    if (!h.hit) return h;
    // No two weights have opposite signs, and not all are 0: a triangle without area has no hit.
    z = real_fma(wc, c.z, real_fma(wb, b.z, wa * a.z)) / (wa + wb + wc);
    z = real_max(real_min(a.z, real_min(b.z, c.z)), real_min(real_max(a.z, real_max(b.z, c.z)), z));
    h.t = u.ray.shift + z / turned(u.ray.d, u.axis).z;
    return h;
}

// The distance by which rounding may move a corner, seen along the ray, off a plane that holds the ray.
FN real seen_rounding(upright_ray u, GLOBAL const real* p, ray3 r) {
    const vec3 e = turned(local_roundings(p, r), u.axis);
    return IN_FACE * real_max(real_fma(real_abs(u.slope_x), e.z, e.x), real_fma(real_abs(u.slope_y), e.z, e.y));
}

// The normal of the plane that is seen as a line through the ray.
FN vec3 normal_of_line(upright_ray u, vec3 direction) {
    const real x = -direction.y, y = direction.x;
    const vec3 n = make_vec3(x, y, -real_fma(u.slope_x, x, u.slope_y * y));
    return turned(n, u.axis == 2 ? 2 : 1 - u.axis);
}

// Adds the plane of the triangle if the ray runs in this plane.
RARE_FN beside add_triangle(beside b, upright_ray u, GLOBAL const real* vertices, GLOBAL const u32* corners,
                            GLOBAL const real* place, ray3 r) {
    const vec3 v0 = upright_vertex(u, vertices + 3 * (size_t)corners[0]);
    const vec3 v1 = upright_vertex(u, vertices + 3 * (size_t)corners[1]);
    const vec3 v2 = upright_vertex(u, vertices + 3 * (size_t)corners[2]);
    vec3 direction;
    if (in_line(v0, v1, v2, v2, seen_rounding(u, place, r), &direction))
        b = add_local_face(b, normal_of_line(u, direction), place, r);
    return b;
}

// A vector normal to the triangle, in the mesh's own space.
FN vec3 triangle_normal(GLOBAL const real* vertices, GLOBAL const u32* corners) {
    GLOBAL const real* a = vertices + 3 * (size_t)corners[0];
    GLOBAL const real* b = vertices + 3 * (size_t)corners[1];
    GLOBAL const real* c = vertices + 3 * (size_t)corners[2];
    vec3 p = make_vec3(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    vec3 q = make_vec3(c[0] - a[0], c[1] - a[1], c[2] - a[2]);
    return make_vec3(difference_of_products(p.y, q.z, p.z, q.y), difference_of_products(p.z, q.x, p.x, q.z),
                     difference_of_products(p.x, q.y, p.y, q.x));
}

#endif
