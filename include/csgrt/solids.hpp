// Solids: what each is made of. Lengths are millimetres.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <csgrt/error.hpp>

namespace csgrt {

struct Vec3 {
    double x = 0, y = 0, z = 0;
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// 4x4 matrix, row-major, applied to column vectors: p' = M p. The last row is 0 0 0 w; BRL-CAD's uniform scale
/// 1/w is divided out by the readers, so here w is 1.
using Matrix = std::array<double, 16>;
inline constexpr Matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// Axis-aligned box; empty while any low > high.
struct Box {
    Vec3 low, high;
};

/// Half-space: inside is normal . p <= distance. The normal is a unit vector, outward.
struct Plane {
    Vec3 normal;
    double distance = 0;
};

// ---- Solids. Names and parameters are BRL-CAD's (librt's rtgeom.h). ----

/// Ellipsoid: centre and three semi-axes, linearly independent.
struct Ell {
    Vec3 v, a, b, c;
};
/// Truncated general cone: base ellipse (v; a, b), top ellipse (v + h; c, d); c parallel to a, d parallel to b.
/// Cylinders, cones, elliptical and oblique forms are all this one.
struct Tgc {
    Vec3 v, h, a, b, c, d;
};
/// arb4 to arb8: polyhedron of up to six faces, convex or what its flat faces enclose, given by eight vertices in BRL-CAD's order
/// (faces 0123, 4567, 0347, 1265, 0154, 3267); arb4 to arb7 repeat vertices.
struct Arb {
    std::array<Vec3, 8> vertices;
};
/// Convex polyhedron: the intersection of half-spaces. Must be bounded.
struct Arbn {
    std::vector<Plane> planes;
};
/// Half-space.
struct Half {
    Plane plane;
};
/// Torus: centre, axis (any length), radius of the circle r_a, radius of the tube r_h, 0 < r_h <= r_a.
struct Tor {
    Vec3 v, h;
    double r_a = 0, r_h = 0;
};
/// Elliptical hyperboloid: base centre v, height vector h towards the apex, unit direction a of the semi-axis r_1,
/// semi-axes r_1 and r_2 at the base, and c, the distance from the apex to the vertex of the asymptotic cone.
struct Ehy {
    Vec3 v, h, a;
    double r_1 = 0, r_2 = 0, c = 0;
};
/// Two balls (v, r_v) and (v + h, r_h) and the cone that touches both. h is not 0, no ball holds the other: |r_v - r_h|
/// < |h| or the solid is the greater ball alone.
struct Part {
    Vec3 v, h;
    double r_v = 0, r_h = 0;
};
/// Elliptic paraboloid: base centre v, apex v + h, unit direction a (perpendicular to h) of the semi-axis r_1, the
/// other r_2.
struct Epa {
    Vec3 v, h, a;
    double r_1 = 0, r_2 = 0;
};
/// Parabolic cylinder: v is the middle of one end's straight edge, h runs along the cylinder, b (perpendicular to h)
/// from the edge to the parabola's vertex, r is half the width of the base.
struct Rpc {
    Vec3 v, h, b;
    double r = 0;
};
/// Hyperbolic cylinder: as Rpc, with c the distance from the hyperbola's vertex to that of its asymptotes.
struct Rhc {
    Vec3 v, h, b;
    double r = 0, c = 0;
};
/// Elliptical torus: an ellipse of semi-axes c (a vector, in the plane of the axis and a radius) and r_d (a length,
/// perpendicular to c) turned about the axis n through v; its centre goes round at radius r.
struct Eto {
    Vec3 v, n, c;
    double r = 0, r_d = 0;
};
/// Hyperboloid of one sheet between two ellipses: v is the centre of the first, v + h of the other; semi-axes a (a
/// vector) and b (a length) at both; `neck` is the waist's share of them, 0 < neck < 1.
struct Hyp {
    Vec3 v, h, a;
    double b = 0, neck = 0;
};
/// Superellipsoid: centre, semi-axes; n shapes the profile towards c, e the outline in the plane of a and b. 1 and 1:
/// an ellipsoid.
///   (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) <= 1
struct Superell {
    Vec3 v, a, b, c;
    double n = 1, e = 1;
};
/// Heart: centre, three semi-axes, and the distance d of its cusps (kept for conversion; the shape follows from the
/// axes).
///   (x^2 + 9/4 y^2 + z^2 - 1)^3 - x^2 z^3 - 9/80 y^2 z^3 <= 0
struct Hrt {
    Vec3 v, x, y, z;
    double d = 0;
};
/// Metaball: where the fields of the points add up to the threshold or more. With r the distance to a point of strength
/// s and softness w (BRL-CAD's sweat):
struct Metaball {
    enum class Method : std::uint8_t {
        metaball,      ///< (1 - (r/s)^2)^2 for r < s; BRL-CAD knows the name only
        isopotential,  ///< s^2 / r^2
        blob           ///< exp(w - w (r/s)^2)
    };
    struct Point {
        Vec3 position;
        double strength = 0, softness = 0;
    };
    Method method = Method::isopotential;
    double threshold = 1;
    std::vector<Point> points;
};
/// Pipe: a tube of changing width through its points, rounded with `bend` at the inner ones.
struct Pipe {
    struct Point {
        Vec3 position;
        double outer = 0, inner = 0;  ///< diameters; inner 0: solid there
        double bend = 0;              ///< radius of the centre line's bend here
    };
    std::vector<Point> points;
};
/// FASTGEN's cylinder along a line: v, h, radius; a thickness greater than 0 makes it a tube with closed ends' walls
/// left open.
struct Cline {
    Vec3 v, h;
    double radius = 0, thickness = 0;
};
/// Triangle mesh.
struct Bot {
    enum class Mode : std::uint8_t {
        surface,     ///< no inside: rendered as a skin of twice the scene's tolerance, along the ray
        volume,      ///< closed: a ray enters and leaves by turns. Only where gaps are does `orientation` matter
        plate,       ///< each triangle a plate of its thickness; one of thickness 0 is rendered as a skin
        plate_nocos  ///< the thickness is measured along the ray
    };
    enum class Orientation : std::uint8_t { unoriented, counterclockwise, clockwise };
    Mode mode = Mode::volume;
    Orientation orientation = Orientation::unoriented;
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;
    std::vector<double> thickness;  ///< plates: one a face
    std::vector<std::uint8_t>
        append;                 ///< plates: one a face. 1: the thickness lies behind the face; 0: half on each side
    std::vector<Vec3> normals;  ///< kept for conversion
    std::vector<std::array<std::uint32_t, 3>> face_normals;
};
/// Closed surface through curves of equal length (BRL-CAD's "waterlines"): neighbouring curves are joined by triangles.
struct Ars {
    std::vector<std::vector<Vec3>> curves;  ///< each as long as the others; closed by its first point
};
/// Polyhedron with flat faces, each of one or more loops of vertices: BRL-CAD's nmg as far as it is solid.
struct Nmg {
    using Loop = std::vector<std::uint32_t>;
    std::vector<Vec3> vertices;
    std::vector<std::vector<Loop>> faces;  ///< a face's first loop is its outline, the others are holes
};
/// Cells of a picture, extruded: x and y count cells, z millimetres from 0 to `height`; `matrix` places that.
struct Ebm {
    std::string file;  ///< where the cells came from
    std::uint32_t width = 0, depth = 0;
    double height = 0;
    Matrix matrix = identity;
    std::vector<std::uint8_t> cells;  ///< row by row from y = 0; other than 0 is solid
};
/// Cells of a volume, each a box of `cell`; those with low <= value <= high are solid. `matrix` places that.
struct Vol {
    std::string file;
    std::uint32_t width = 0, depth = 0, height = 0;
    std::uint8_t low = 0, high = 255;
    Vec3 cell{1, 1, 1};
    Matrix matrix = identity;
    std::vector<std::uint8_t> cells;  ///< x fastest, then y, then z
};
/// Terrain: heights at the corners of a grid, solid down to z = 0; `matrix` turns cells and heights into millimetres.
struct Dsp {
    enum class Cut : std::uint8_t { adaptive, lower_left, upper_left };  ///< which diagonal splits a cell
    std::string file;
    std::uint32_t width = 0, depth = 0;
    bool smooth = false;  ///< kept for conversion: normals of shading only
    Cut cut = Cut::adaptive;
    Matrix matrix = identity;
    std::vector<std::uint16_t> heights;  ///< row by row from y = 0
};

/// A plane outline made of curves over common vertices.
struct Sketch {
    struct Point {
        double u = 0, v = 0;
    };
    struct Line {
        std::uint32_t start = 0, end = 0;
    };
    /// Arc from start to end, or, with a radius below 0, the full circle around `end` through `start`.
    struct Arc {
        std::uint32_t start = 0, end = 0;
        double radius = 0;
        bool center_left = false;  ///< the centre lies to the left of start -> end
        bool clockwise = false;    ///< the way from start to end
    };
    struct Bezier {
        std::vector<std::uint32_t> points;
    };
    struct Nurb {
        std::uint32_t order = 0;
        std::vector<double> knots;
        std::vector<std::uint32_t> points;
        std::vector<double> weights;  ///< empty: not rational
    };
    using Curve = std::variant<Line, Arc, Bezier, Nurb>;
    std::string name;  ///< of the object it came from; may be empty
    std::vector<Point> vertices;
    std::vector<Curve> curves;
    std::vector<std::uint8_t> reversed;  ///< one a curve
};
/// What a sketch encloses (even-odd), in the plane v + u a + v b, moved along h.
struct Extrude {
    Vec3 v, h, a, b;
    Sketch sketch;
};
/// A sketch turned about an axis: its u runs from v along r (perpendicular to the axis), its v along the axis.
struct Revolve {
    Vec3 v, axis, r;
    double angle = 0;  ///< radians, 2 pi for all round
    Sketch sketch;
};
/// A solid that csgrt knows by name only: refused, with its name and its user, when a rendered object needs it.
struct Unsupported {
    std::string type;
    std::string reason = {};  ///< what it lacks, if csgrt supports the type: its file of cells, its sketch
};

/// Any one of them. A variant (std::visit, std::get, std::holds_alternative), whose copying and end are in the library:
/// compiled for every type in every file that holds a scene, they were a third of what such a file takes to compile.
struct CSGRT_API Shape
    : std::variant<Ell, Tgc, Arb, Arbn, Half, Tor, Ehy, Part, Epa, Rpc, Rhc, Eto, Hyp, Superell, Hrt, Metaball, Pipe, Cline, Bot,
                   Ars, Nmg, Ebm, Vol, Dsp, Extrude, Revolve, Unsupported> {
    using variant::variant;
    using variant::operator=;
    Shape() noexcept;
    Shape(const Shape& other);
    Shape(Shape&& other) noexcept;
    Shape& operator=(const Shape& other);
    Shape& operator=(Shape&& other) noexcept;
    ~Shape();
};

}  // namespace csgrt
