// The model: solids, combined by Boolean trees, some of them regions. Lengths are millimetres throughout;
// a reader converts a file's own units when it loads.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <csgrt/error.hpp>
#include <csgrt/solids.hpp>

namespace csgrt {

/// BRL-CAD's name of a shape's type: "ell", "tgc", "arb8", ...
CSGRT_API const char* type_name(const Shape& shape);

struct Solid {
    std::string name;
    Shape shape;
    Place place;
};

// ---- Combinations ----

enum class Operator : std::uint8_t { leaf, union_, intersection, difference, xor_, not_ };

/// One node of a tree in postfix order: an operator follows its `arity` operands.
/// union, intersection and xor take one or more, difference two or more (the first less all others), not exactly one.
struct TreeNode {
    Operator op = Operator::leaf;
    std::uint32_t arity = 0;
    std::string object;       ///< leaf: the name of a solid or a combination
    Matrix matrix = identity; ///< leaf: places the object
    Place place;
};
/// A Boolean tree, flat and in postfix order, so that depth costs no stack. Empty: the empty set.
struct Tree {
    std::vector<TreeNode> nodes;
};

/// What a region of BRL-CAD's shader `light` sends out, from the centre of its box. Where a rendered region has one, the light
/// by the eye is off. Lights cast no shadows, and are as bright near as far.
struct Emission {
    double intensity = 1;  ///< of the brightest without a fraction: 1 / (1 + half the scene's ambient light); others in proportion
    double fraction = 0;   ///< of full brightness, in place of the intensity; 0: not given
    double angle = 180;    ///< between the beam's axis and its edge, degrees
    std::optional<Vec3> target = {};     ///< a point on the beam's axis
    std::optional<Vec3> direction = {};  ///< along that axis; default: down, -z of the region's first solid
    bool infinite = false;  ///< as far away as the sun, in the direction from the model's origin to the region
    bool visible = true;    ///< false: the region is not drawn, and yields to whatever stands in it
    int shadows = 1;        ///< kept for conversion
};

/// BRL-CAD's plastic: colour = material colour x (ambient x cos(eye) + diffuse x cos(light)) + specular x cos^shine.
struct Finish {
    std::string shader = "plastic";
    double specular = 0.7, diffuse = 0.3, ambient = 1.0;  ///< ambient scales the scene's ambient light
    int shine = 10;
    double transmit = 0, reflect = 0;  ///< kept for conversion; first-hit shading does not use them
    std::optional<Emission> light = {};  ///< of the shader "light": it shines, and does not look like plastic
};

/// FASTGEN's kinds of regions. Where regions overlap, one with a kind yields to one without, and a volume to a plate.
enum class Fastgen : std::uint8_t { none, plate, volume };

struct Combination {
    std::string name;
    Tree tree;
    bool region = false;
    Fastgen fastgen = Fastgen::none;
    int region_id = 0, air = 0, material_id = 1, los = 100;
    std::optional<Vec3> color;  ///< 0..1
    std::optional<Finish> finish;
    bool color_inherits = false, finish_inherits = false;  ///< true: overrides what stands below
    Place place;
};

using Object = std::variant<Solid, Combination>;

// ---- The scene ----

/// It casts no shadows, and is as bright near as far.
struct Light {
    Vec3 position;
    Vec3 color{1, 1, 1};
    double intensity = 1;
    bool infinite = false;  ///< as far away as the sun, in the direction from the origin to `position`
    double angle = 180;     ///< between the beam's axis and its edge, degrees
    Vec3 direction{0, 0, -1};  ///< along that axis; of any length but 0
};

/// The view is BRL-CAD's: a square (or rectangle; then `view_size` is its height) centred on the model's box;
/// azimuth from +x about z, elevation upward, both in degrees.
///
/// An orthographic view has no eye. Its rays start on a plane before the whole model, so that all of it is seen, however
/// small the view is; a half-space without end is cut there.
struct Camera {
    double azimuth = 35, elevation = 25;
    double perspective = 0;           ///< angle of view in degrees, across the height; 0 is orthographic
    std::optional<Vec3> center;       ///< default: the centre of the model's box
    std::optional<double> view_size;  ///< default: the diagonal of the model's box

    /// Where the eye stands, in place of azimuth and elevation, which then have no meaning. With a perspective it gives the
    /// size of the view, too, and `view_size` must be absent; an orthographic view takes the direction from it alone.
    std::optional<Vec3> eye = {};
    std::optional<Vec3> look_at = {};  ///< another name of `center`, which must be absent then
    /// What points upward in the picture; not along the line of sight. Default: +z; for a view straight down or up, what
    /// azimuth 0 gives.
    std::optional<Vec3> up = {};
};

/// BRL-CAD's colour table: regions with low <= id <= high get the colour.
struct RegionColor {
    int low = 0, high = 0;
    Vec3 color;
};

struct Scene {
    std::string title;
    std::string units = "mm";     ///< as the file says; values are millimetres already
    double unit_length = 1;       ///< millimetres a unit
    Camera camera;
    std::vector<Light> lights;    ///< without any, and without regions that shine: one light by the eye
    double ambient = 0.4;         ///< intensity of the ambient light from the eye
    Vec3 background{0, 0, 0};
    /// Ends of segments closer than this along a ray are one, millimetres. 0: those of one surface, see Tolerance::surfaces;
    /// BRL-CAD's files have its 0.0005.
    double tolerance = 0;
    std::vector<Object> objects;  ///< in the order of the file
    std::vector<std::string> top; ///< what to render when nothing is named; empty: every object that no other uses
    std::vector<RegionColor> region_colors;
    /// What is missing, broken or of an unknown type is the empty set, with a warning, where a strict scene is refused. So are
    /// BRL-CAD's databases, which its own ray tracer draws without such objects.
    bool lenient = false;
    std::vector<Warning> warnings;  ///< what the reader of the file bore

    /// The object of that name, or nullptr. Names are unique; readers refuse duplicates. Linear; compile keeps an index.
    CSGRT_API const Object* find(const std::string& name) const;
};

/// The object of that name, or the one that a path leads to ("all.g/tor.r"), or nullptr.
CSGRT_API const Object* object_at(const Scene& scene, const std::string& path);

CSGRT_API const std::string& name_of(const Object& object);
CSGRT_API const Place& place_of(const Object& object);

/// The objects that no combination uses, in the order of the file; `scene.top` if that is given.
CSGRT_API std::vector<std::string> top_objects(const Scene& scene);

/// Limits that validation enforces, each far beyond real models and far below what would exhaust a machine.
struct Limits {
    static constexpr std::uint32_t nesting = 1'000;         ///< combinations inside combinations
    static constexpr std::uint32_t file_nesting = 512;      ///< brackets inside brackets in a scene file
    static constexpr std::uint64_t instances = 20'000'000;  ///< solids after flattening, repeats counted
    static constexpr std::uint32_t faces = 65'535;          ///< of one arbn
    static constexpr std::uint32_t triangles = 20'000'000;  ///< of one bot, ars or nmg
    static constexpr std::uint32_t cells = 200'000'000;     ///< of one ebm or vol; heights of one dsp
    static constexpr std::uint32_t curves = 100'000;        ///< of one sketch
    static constexpr std::uint32_t curve_degree = 12;       ///< of a Bezier or NURB curve
    static constexpr std::uint32_t pipe_points = 100'000;   ///< of one pipe
    static constexpr std::uint32_t metaball_points = 10'000;  ///< of one metaball
    static constexpr double least_exponent = 0.01;          ///< of a superell; what is less is a box
    static constexpr double greatest_exponent = 20;         ///< of a superell; what is more is but its axes
    static constexpr double length = 1e15;          ///< millimetres: of a coordinate or a size, as given and in its place
    static constexpr double least_length = 1e-15;   ///< millimetres: of the diagonal of a solid's box, in its place
    static constexpr double ray_origin = 1e18;      ///< millimetres: of a coordinate of a ray's origin
    static constexpr double least_direction = 1e-250, greatest_direction = 1e250;  ///< of a direction's greatest component
    static constexpr int shine = 10'000;                    ///< beyond it a highlight is a point
};

/// Checks everything that can be checked object by object: unknown members, cycles, degenerate solids, singular
/// matrices, non-finite numbers, trees. Only objects reachable from `objects` (names or paths; empty: from the top objects).
/// Returns all findings; empty means the scene is sound. `skip_unsupported`: solids of types that csgrt does not know are
/// none (see Settings). What is left out instead, as in a lenient scene, is appended to `warnings`.
CSGRT_API std::vector<Diagnostic> validate(const Scene& scene, const std::vector<std::string>& objects = {},
                                           bool skip_unsupported = false, std::vector<Warning>* warnings = nullptr);

}  // namespace csgrt
