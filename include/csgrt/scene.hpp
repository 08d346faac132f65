// Scene: solids, Boolean combinations of them, of which some are regions, lights and a camera. All lengths are
// millimetres; readers convert a file's own units. Colours are display values (sRGB): red, green, blue; 0 to 1.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <csgrt/camera.hpp>
#include <csgrt/error.hpp>
#include <csgrt/solids.hpp>

namespace csgrt {

/// BRL-CAD's name of a shape's type: "ell", "tgc", "arb8", ... An Unsupported has the name of its own type, which is
/// valid as long as the shape.
CSGRT_API const char* type_name(const Shape& shape);

/// A solid and its name.
struct Solid {
    std::string name = {};
    Shape shape = {};
    Place place = {};  ///< in the file that it was read from
};

// ---- Combinations ----

enum class Operator : std::uint8_t { leaf, union_, intersection, difference, xor_, not_ };

/// One node of a tree in postfix order: an operator follows its `arity` operands. Union, intersection and xor take one
/// operand or more, difference two or more (the first one without all others), and not exactly one.
struct TreeNode {
    Operator op = Operator::leaf;
    std::uint32_t arity = 0;   ///< operator: the number of operands
    std::string object = {};   ///< leaf: the name of a solid or a combination
    Matrix matrix = identity;  ///< leaf: from the object's coordinates to the tree's
    Place place = {};          ///< in the file that it was read from
    /// Leaf: its name in paths (RegionInfo::path); no other leaf of the tree may have it. Empty: the object's name, and
    /// for the second and later leaves of the object a number, as in "wheel@2".
    std::string name = {};
};
/// A Boolean tree, as a list in postfix order, so that no recursion is needed. An empty list is the empty set.
struct Tree {
    std::vector<TreeNode> nodes = {};
};

// Operators for trees in code: tree("body") - (tree("bore") | tree("slot", moved)). An empty operand is the empty set.

/// A tree of one leaf.
CSGRT_API Tree tree(std::string object, const Matrix& matrix = identity);
CSGRT_API Tree operator|(Tree a, Tree b);  ///< union
CSGRT_API Tree operator&(Tree a, Tree b);  ///< intersection
CSGRT_API Tree operator-(Tree a, Tree b);  ///< difference: a without b
CSGRT_API Tree operator^(Tree a, Tree b);  ///< exclusive or

/// The light of a region whose shader is BRL-CAD's `light`. The light comes from the centre of the region's box. If a
/// rendered region has such a light, the scene has no light at the eye. Lights cast no shadows and do not fade with
/// distance.
struct Emission {
    /// Brightness relative to the other lights that have no `fraction`. The brightest of these has 1 / (1 + half the
    /// scene's ambient light) of full brightness.
    double intensity = 1;
    double fraction = 0;                 ///< fraction of full brightness, in place of `intensity`; 0: not given
    double angle = 180;                  ///< degrees between the beam's axis and its edge
    std::optional<Vec3> target = {};     ///< a point on the beam's axis
    std::optional<Vec3> direction = {};  ///< direction of the beam's axis; default: -z of the region's first solid
    bool infinite = false;               ///< true: infinitely far away, in the direction from the origin to the region
    bool visible = true;                 ///< false: the region is not drawn, and yields to every other region
    int shadows = 1;                     ///< kept for conversion
};

/// BRL-CAD's plastic, in linear light: colour = material colour x (ambient x cos(eye) + diffuse x cos(light)) +
/// specular x cos^shine.
struct Finish {
    std::string shader = "plastic";
    double specular = 0.7, diffuse = 0.3;
    double ambient = 1.0;  ///< times Scene::ambient
    int shine = 10;
    double transmit = 0, reflect = 0;    ///< kept for conversion: pictures show first hits only
    std::optional<Emission> light = {};  ///< for the shader "light": the region emits light, and is not shaded as
                                         ///< plastic
};

/// FASTGEN's kinds of regions. Where regions overlap, a region of no kind gets the part before a plate, and a plate
/// before a volume.
enum class Fastgen : std::uint8_t { none, plate, volume };

/// A Boolean tree and its name. A combination that is a region is one part, made of one material.
struct Combination {
    std::string name = {};
    Tree tree = {};
    bool region = false;
    Fastgen fastgen = Fastgen::none;
    int region_id = 0;               ///< BRL-CAD's identifier, for RegionColor
    int air = 0;                     ///< other than 0: a region of air
    int material_id = 1;             ///< BRL-CAD's number; kept for conversion
    int los = 100;                   ///< BRL-CAD's percentage of the line of sight; kept for conversion
    std::optional<Vec3> color = {};  ///< red, green, blue; 0 to 1
    std::optional<Finish> finish = {};
    bool color_inherits = false, finish_inherits = false;  ///< true: overrides the attributes of the combinations below
    Place place = {};                                      ///< in the file that it was read from
};

using Object = std::variant<Solid, Combination>;

// ---- Instances ----

/// The visibility of a region in pictures. Lists of partitions contain regions of every state, unless the call leaves
/// out those that are not shown. A region's state does not change the shapes of other regions.
enum class State : std::uint8_t {
    shown,
    ghost,  ///< as hidden, but channel::ghosts shows where the region would be seen
    hidden  ///< pictures, picks and first hits pass through it
};

/// The appearance of the regions at a path, in place of their combinations' attributes.
struct Look {
    /// A RegionInfo::path, or its beginning up to a '/' for all regions below; "/": all regions.
    std::string path = {};
    std::optional<Vec3> color = {};  ///< red, green, blue; 0 to 1
    std::optional<Finish> finish = {};
    std::optional<State> state = {};
};

// ---- The scene ----

/// A light that is not a region. It casts no shadows and does not fade with distance.
struct Light {
    Vec3 position = {};
    Vec3 color{1, 1, 1};  ///< red, green, blue; 0 to 1
    double intensity = 1;
    bool infinite = false;     ///< true: infinitely far away, in the direction from the origin to `position`
    double angle = 180;        ///< degrees between the beam's axis and its edge
    Vec3 direction{0, 0, -1};  ///< direction of the beam's axis; of any length but 0
};

/// A row of BRL-CAD's colour table: regions with low <= region_id <= high get the colour.
struct RegionColor {
    int low = 0, high = 0;
    Vec3 color = {};  ///< red, green, blue; 0 to 1
};

/// A row of a table of densities: regions of one material, or at one path, have the density. If two rows concern one
/// region, the later one counts.
struct Density {
    int material_id = 0;  ///< BRL-CAD's number of the material, if there is no path
    /// A RegionInfo::path, or its beginning up to a '/' for all regions below; "/": all. Measurer throws Error (usage)
    /// if it fits no region.
    std::string path = {};
    double density = 0;     ///< g/cm^3
    std::string name = {};  ///< of the material
};

/// A model, its lights and a camera.
struct Scene {
    std::string title = {};
    std::string units = "mm";  ///< the file's unit, for conversion: all values here are millimetres
    double unit_length = 1;    ///< millimetres in one `units`
    Camera camera = {};
    std::vector<Light> lights = {};  ///< if empty, and no region emits light: one light at the eye
    double ambient = 0.4;            ///< intensity of the ambient light, which comes from the eye
    Vec3 background{0, 0, 0};        ///< red, green, blue; 0 to 1
    /// Boundaries of segments that are closer to each other along a ray than this number of millimetres count as one
    /// point. 0: boundaries on one surface do (Tolerance::surfaces). Readers of BRL-CAD's files set BRL-CAD's 0.0005.
    double tolerance = 0;
    std::vector<Object> objects = {};   ///< in the order of the file
    std::vector<std::string> top = {};  ///< the objects to render by default; empty: every object that no other object
                                        ///< uses
    /// The places of the objects of `top`, one each, from their coordinates to the world's. Empty: all stand where they
    /// are.
    std::vector<Matrix> top_matrices = {};
    std::vector<RegionColor> region_colors = {};
    std::vector<Look> looks = {};  ///< if two concern one region, the later one counts; looks of no region have no
                                   ///< effect
    std::vector<Density> densities = {};  ///< BRL-CAD's object _DENSITIES, for Measurer
    /// True: an object that is missing, broken or of an unknown type is the empty set, with a warning. False: such a
    /// scene is refused. BRL-CAD's databases are lenient, as BRL-CAD's ray tracer is.
    bool lenient = false;
    std::vector<Warning> warnings = {};  ///< faults that the file's reader tolerated

    /// The object with this name, or nullptr. Valid until `objects` changes. Names are unique: readers refuse
    /// duplicates. The search is linear.
    CSGRT_API const Object* find(const std::string& name) const;
    CSGRT_API Object* find(const std::string& name);
};

/// The object with a name, or at the end of a path ("all.g/tor.r"), or nullptr. Valid until `scene.objects` changes.
CSGRT_API const Object* object_at(const Scene& scene, const std::string& path);

/// BRL-CAD's name of a solid's type, "region" or "combination".
CSGRT_API const char* type_name(const Object& object);

/// The name and the place of a solid or a combination; valid as long as the object.
CSGRT_API const std::string& name_of(const Object& object);
CSGRT_API const Place& place_of(const Object& object);

/// The names of the objects that a Renderer renders by default: `scene.top` or, if this is empty, the objects that no
/// combination uses, in the order of the file.
CSGRT_API std::vector<std::string> top_objects(const Scene& scene);

/// Limits that validate() and Renderer enforce. They are far beyond real models, and far below sizes that exhaust a
/// machine or the range of its numbers. docs/limits.md has a table of them.
struct Limits {
    static constexpr std::uint32_t nesting = 1'000;              ///< combinations inside combinations
    static constexpr std::uint32_t file_nesting = 512;           ///< brackets inside brackets in a scene file
    static constexpr std::uint64_t instances = 300'000;          ///< unless Settings::max_instances is given
    static constexpr std::uint64_t most_instances = 20'000'000;  ///< of Settings::max_instances
    static constexpr std::uint64_t path_bytes = 256'000'000;     ///< of the paths of all regions together
    static constexpr std::uint32_t faces = 16'384;               ///< of one arbn
    static constexpr std::uint32_t triangles = 20'000'000;       ///< of one bot, ars or nmg
    static constexpr std::uint32_t cells = 200'000'000;          ///< of one ebm or vol; heights of one dsp
    static constexpr std::uint32_t curves = 100'000;             ///< of one sketch
    static constexpr std::uint32_t curve_degree = 12;            ///< of a Bezier or NURB curve
    static constexpr std::uint32_t pipe_points = 100'000;        ///< of one pipe
    static constexpr std::uint32_t metaball_points = 10'000;     ///< of one metaball
    static constexpr double least_exponent = 0.01;               ///< of a superell: below it, the shape is nearly a box
    static constexpr double greatest_exponent = 20;      ///< of a superell: above it, the shape is nearly its axes
    static constexpr double length = 1e15;               ///< millimetres: coordinates and sizes, transformed or
                                                         ///< not
    static constexpr double least_length = 1e-15;        ///< millimetres: diagonal of a transformed solid's box
    static constexpr double ray_origin = 1e18;           ///< millimetres: coordinates of a ray's origin
    static constexpr double least_direction = 1e-250;    ///< largest component of a ray's direction, at least
    static constexpr double greatest_direction = 1e250;  ///< and at most
    static constexpr int shine = 10'000;                 ///< of a finish: above it, a highlight is a point
    /// Points of an isopotential metaball: its fields have no end, so the time grows with the square of the number.
    static constexpr std::uint32_t isopotential_points = 1'000;
    /// The fraction by which an arc's chord may exceed its diameter. Such an arc counts as a half circle whose radius
    /// was given with few digits.
    static constexpr double half_circle = 1e-5;
};

/// Checks the objects of `objects` (names or paths; none: the top objects) and everything that they use: members that
/// do not exist, cycles, degenerate solids, singular matrices, numbers that are not finite, trees. Returns every error;
/// none: the model is valid. If `skip_unsupported`, solids of unknown types are the empty set (see Settings). If
/// `warnings` is not null, faults that only leave objects out are appended to it. `max_instances`: see Settings.
CSGRT_API std::vector<Diagnostic> validate(const Scene& scene, const std::vector<std::string>& objects = {},
                                           bool skip_unsupported = false, std::vector<Warning>* warnings = nullptr,
                                           std::uint64_t max_instances = 0);

}  // namespace csgrt
