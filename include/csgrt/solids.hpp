// Solids and their parameters. Lengths and coordinates are millimetres, angles radians unless a comment says otherwise.
// validate() checks the values.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <csgrt/error.hpp>
#include <csgrt/vector.hpp>

namespace csgrt {

/// The half-space normal . p <= distance. The normal points outward. It stands for the unit vector of its direction.
struct Plane {
    Vec3 normal = {};
    double distance = 0;  ///< Millimetres from the origin, for any length of the normal.
};

// ---- Solids. Names and parameters are those of BRL-CAD (rtgeom.h in librt). ----

/// Ellipsoid: centre v and three linearly independent semi-axes.
struct Ell {
    Vec3 v = {}, a = {}, b = {}, c = {};
};
/// Truncated general cone: base ellipse (v; a, b), top ellipse (v + h; c, d); c parallel to a, d parallel to b.
/// Cylinders and cones, circular or elliptical, right or oblique, are special cases.
struct Tgc {
    Vec3 v = {}, h = {}, a = {}, b = {}, c = {}, d = {};
};
/// arb4 to arb8: polyhedron of up to six faces between eight vertices, in BRL-CAD's order: faces 0123, 4567, 0347,
/// 1265, 0154 and 3267. Arb4 to arb7 repeat vertices. It need not be convex if its faces are flat.
struct Arb {
    std::array<Vec3, 8> vertices = {};
};
/// Convex polyhedron: the intersection of half-spaces, which must be bounded.
struct Arbn {
    std::vector<Plane> planes = {};
};
/// Half-space.
struct Half {
    Plane plane = {};
};
/// Torus: centre v, axis h (of any length but 0), radius r_a of the circle in the tube's middle, radius r_h of the
/// tube, 0 < r_h <= r_a.
struct Tor {
    Vec3 v = {}, h = {};
    double r_a = 0, r_h = 0;
};
/// Elliptical hyperboloid: base centre v, height vector h towards the apex, unit direction a of the semi-axis r_1,
/// semi-axes r_1 and r_2 at the base, and c, the distance from the apex to the vertex of the asymptotic cone.
struct Ehy {
    Vec3 v = {}, h = {}, a = {};
    double r_1 = 0, r_2 = 0, c = 0;
};
/// Particle: a ball of radius r_v at v, a ball of radius r_h at v + h, and the cone that touches both. If one ball
/// contains the other, the solid is the larger ball.
struct Part {
    Vec3 v = {}, h = {};
    double r_v = 0, r_h = 0;
};
/// Elliptical paraboloid: base centre v, apex v + h, unit direction a (perpendicular to h) of the semi-axis r_1,
/// semi-axis r_2 perpendicular to both.
struct Epa {
    Vec3 v = {}, h = {}, a = {};
    double r_1 = 0, r_2 = 0;
};
/// Parabolic cylinder: v is the middle of one end's straight edge, h runs along the cylinder, b (perpendicular to h)
/// from the edge to the parabola's vertex, r is half the width of the base.
struct Rpc {
    Vec3 v = {}, h = {}, b = {};
    double r = 0;
};
/// Hyperbolic cylinder: as Rpc; c is the distance from the hyperbola's vertex to the point where its asymptotes meet.
struct Rhc {
    Vec3 v = {}, h = {}, b = {};
    double r = 0, c = 0;
};
/// Elliptical torus: an ellipse, turned about the axis n through v. The ellipse's centre has the distance r from the
/// axis. Its semi-axis c is a vector in a plane through the axis. Its other semi-axis, in the same plane and
/// perpendicular to c, has the length r_d.
struct Eto {
    Vec3 v = {}, n = {}, c = {};
    double r = 0, r_d = 0;
};
/// Hyperboloid of one sheet between two equal ellipses with centres v and v + h. One of their semi-axes is the vector
/// a; the other one, perpendicular to a, has the length b. The ellipse in the middle is smaller by the factor `neck`,
/// which is between 0 and 1.
struct Hyp {
    Vec3 v = {}, h = {}, a = {};
    double b = 0, neck = 0;
};
/// Superellipsoid: centre v and three semi-axes; the exponent n shapes the profile towards c, e the outline in the
/// plane of a and b. With n = e = 1 it is an ellipsoid. In the coordinates of the semi-axes:
///     (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) <= 1
struct Superell {
    Vec3 v = {}, a = {}, b = {}, c = {};
    double n = 1, e = 1;
};
/// Heart: centre v, three semi-axes, and the distance d of its cusps, which is kept for conversion and does not change
/// the shape. In the coordinates of the semi-axes:
///     (x^2 + 9/4 y^2 + z^2 - 1)^3 - x^2 z^3 - 9/80 y^2 z^3 <= 0
struct Hrt {
    Vec3 v = {}, x = {}, y = {}, z = {};
    double d = 0;
};
/// Metaball: the points where the sum of the fields of all points is the threshold or more. Method gives the field at
/// the distance r from a point of strength s and softness w (BRL-CAD's sweat).
struct Metaball {
    enum class Method : std::uint8_t {
        metaball,      ///< (1 - (r/s)^2)^2 for r < s; BRL-CAD has the name of this method, but not the field
        isopotential,  ///< s^2 / r^2
        blob           ///< exp(w - w (r/s)^2)
    };
    struct Point {
        Vec3 position = {};
        double strength = 0, softness = 0;
    };
    Method method = Method::isopotential;
    double threshold = 1;
    std::vector<Point> points = {};
};
/// Pipe: a tube along a line through its points. The line has an arc at each inner point; along its
/// straight parts the diameters change linearly.
struct Pipe {
    struct Point {
        Vec3 position = {};
        double outer = 0, inner = 0;  ///< diameters; inner 0: no hole
        double bend = 0;              ///< radius of the line's arc at this point
    };
    std::vector<Point> points = {};
};
/// FASTGEN's cylinder from v to v + h. With a thickness greater than 0 it is a tube with walls of this thickness, open
/// at both ends; with 0 it is solid.
struct Cline {
    Vec3 v = {}, h = {};
    double radius = 0, thickness = 0;
};
/// Triangle mesh.
struct Bot {
    enum class Mode : std::uint8_t {
        surface,     ///< encloses nothing: each triangle is a skin, along a ray twice the scene's tolerance thick
                     ///< (0.001 mm if the tolerance is 0)
        volume,      ///< closed: a ray enters and leaves in turn; `orientation` matters only where the mesh has gaps
        plate,       ///< each triangle is a plate of its own thickness, or a skin if its thickness is 0
        plate_nocos  ///< as plate, but the thickness is measured along the ray
    };
    enum class Orientation : std::uint8_t { unoriented, counterclockwise, clockwise };
    Mode mode = Mode::volume;
    Orientation orientation = Orientation::unoriented;
    std::vector<Vec3> vertices = {};
    std::vector<std::array<std::uint32_t, 3>> faces = {};  ///< three indices into `vertices` each
    std::vector<double> thickness = {};                    ///< plates: millimetres, one for each face
    std::vector<std::uint8_t> append = {};  ///< plates: for each face 1: it is behind the face, 0: half on each side
    std::vector<Vec3> normals = {};         ///< kept for conversion
    std::vector<std::array<std::uint32_t, 3>> face_normals = {};  ///< kept for conversion: indices into `normals`
};
/// Closed surface of triangles between neighbouring curves (BRL-CAD's "waterlines"), all with the same number of
/// points.
struct Ars {
    std::vector<std::vector<Vec3>> curves = {};  ///< each curve is closed: its last point is joined to its first
};
/// Polyhedron with flat faces, each of one or more loops of vertices: the solid part of BRL-CAD's nmg.
struct Nmg {
    using Loop = std::vector<std::uint32_t>;  ///< indices into `vertices`
    std::vector<Vec3> vertices = {};
    std::vector<std::vector<Loop>> faces = {};  ///< the first loop of each face is the outline, the others are holes
};
/// The cells of a picture, extruded. In the solid's own coordinates a cell is 1 x 1 in x and y, and goes from 0 to
/// `height` millimetres in z. `matrix` maps these coordinates to the model's.
struct Ebm {
    std::string file = {};               ///< the source of the cells, for conversion
    std::uint32_t width = 0, depth = 0;  ///< cells in x and in y
    double height = 0;
    Matrix matrix = identity;
    std::vector<std::uint8_t> cells = {};  ///< width x depth, row by row from y = 0; a cell other than 0 is solid
};
/// The cells of a volume; cells with low <= value <= high are solid. Each cell is a box of the size `cell`. `matrix`
/// maps the cells to the model's coordinates.
struct Vol {
    std::string file = {};                           ///< the source of the cells, for conversion
    std::uint32_t width = 0, depth = 0, height = 0;  ///< cells in x, y and z
    std::uint8_t low = 0, high = 255;
    Vec3 cell{1, 1, 1};  ///< millimetres in x, y and z
    Matrix matrix = identity;
    std::vector<std::uint8_t> cells = {};  ///< width x depth x height, x fastest, z slowest
};
/// Terrain: heights at the points of a grid, solid down to z = 0. `matrix` maps grid steps and heights to the model's
/// coordinates.
struct Dsp {
    enum class Cut : std::uint8_t { adaptive, lower_left, upper_left };  ///< the rule for a cell's diagonal
    std::string file = {};                                               ///< the source of the heights, for conversion
    std::uint32_t width = 0, depth = 0;                                  ///< points in x and in y
    bool smooth = false;                                                 ///< kept for conversion
    Cut cut = Cut::adaptive;
    Matrix matrix = identity;
    std::vector<std::uint16_t> heights = {};  ///< width x depth, row by row from y = 0
};

/// A plane outline: curves between common vertices. Members of type uint32_t in the curves are indices into `vertices`.
struct Sketch {
    struct Point {
        double u = 0, v = 0;  ///< Extrude: in units of its a and b; Revolve: millimetres
    };
    struct Line {
        std::uint32_t start = 0, end = 0;
    };
    /// An arc the direction from `start` to `end`. If the radius is negative, the full circle around `end` through
    /// `start`.
    struct Arc {
        std::uint32_t start = 0, end = 0;
        double radius = 0;
        bool center_left = false;  ///< whether the centre is to the left of the line from `start` to `end`
        bool clockwise = false;    ///< from `start` to `end`
    };
    struct Bezier {
        std::vector<std::uint32_t> points = {};
    };
    struct Nurb {
        std::uint32_t order = 0;
        std::vector<double> knots = {};
        std::vector<std::uint32_t> points = {};
        std::vector<double> weights = {};  ///< one for each point; empty: not rational
    };
    using Curve = std::variant<Line, Arc, Bezier, Nurb>;
    std::string name = {};  ///< name of the sketch's object in the file; may be empty
    std::vector<Point> vertices = {};
    std::vector<Curve> curves = {};
    std::vector<std::uint8_t> reversed = {};  ///< for each curve, 1 if it goes from its end to its start
};
/// The area that a sketch encloses (by the even-odd rule), moved along h. The sketch's point (s, t) is v + s a + t b.
struct Extrude {
    Vec3 v = {}, h = {}, a = {}, b = {};
    Sketch sketch = {};
};
/// The area that a sketch encloses, turned about the axis through v. The sketch's u is along r, which is perpendicular
/// to the axis, and its v is along the axis. Both begin at the point v.
struct Revolve {
    Vec3 v = {}, axis = {}, r = {};
    double angle = 0;  ///< radians; 2 pi: a full turn
    Sketch sketch = {};
};
/// A solid of a type that csgrt does not support, or with missing parts. If a rendered object uses it, this is an
/// error, or in a lenient scene the solid is the empty set.
struct Unsupported {
    std::string type = {};    ///< BRL-CAD's name of the type
    std::string reason = {};  ///< if csgrt supports the type: the missing part, for example a file of cells or a sketch
};

/// Any one of the solids: a variant (std::visit, std::get, std::holds_alternative). The functions that copy and destroy
/// it are compiled in the library, because they took a third of the time to compile a file that uses scenes.
struct CSGRT_API Shape
    : std::variant<Ell, Tgc, Arb, Arbn, Half, Tor, Ehy, Part, Epa, Rpc, Rhc, Eto, Hyp, Superell, Hrt, Metaball, Pipe,
                   Cline, Bot, Ars, Nmg, Ebm, Vol, Dsp, Extrude, Revolve, Unsupported> {
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
