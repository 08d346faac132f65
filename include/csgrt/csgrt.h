// csgrt in C99: exact ray tracing of Constructive Solid Geometry. Functions and members have the names of the C++
// headers in this folder, which describe them in more detail. examples/partitions.c is a whole program.
//
// Rules that hold unless a comment says otherwise:
// - A call returns CSGRT_OK, or the kind of its failure. After a failure csgrt_last_error() has the text, a handle that
//   the call would have made is NULL, and other results must not be used. No C++ exception leaves a call.
// - The caller frees a handle that a call puts into a `csgrt_x**`, with csgrt_x_free(), which also takes NULL. A handle
//   may be freed before handles that were made from it. Calls copy their arguments.
// - A pointer that a call returns is valid as long as its handle, and until the next call that changes the handle.
// - Structs that may grow begin with their size. Initialize them with their defaults, as in `csgrt_view view =
//   CSGRT_VIEW;`, also structs that calls fill. All defaults are at the end of this header. If a struct is shorter,
//   because it is from the header of an earlier version, the missing members have their defaults.
// - A pointer to several values has a count beside it; both may be 0. Text is UTF-8 and ends with 0; no text is "".
// - Lengths are millimetres, angles degrees, z is up, matrices are 4 x 4, row by row, for column vectors. Distances
//   along a ray are in lengths of its direction. Colours are red, green and blue, from 0 to 1.
// - Threads. Any number of threads may use a csgrt_model at a time. Any number may read a csgrt_scene (as const), or
//   one thread may change it. One thread at a time, not always the same, may use a csgrt_renderer, csgrt_edit,
//   csgrt_partitions, csgrt_image, csgrt_verifier, csgrt_measurer or csgrt_checker; other threads may call
//   csgrt_renderer_model() and csgrt_renderer_set_model() meanwhile.
#ifndef CSGRT_CSGRT_H
#define CSGRT_CSGRT_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include <csgrt/version.hpp>  // in C only macros

#ifndef CSGRT_API  // in C
#define CSGRT_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// The version of the library that the program has loaded. CSGRT_VERSION_STRING is this header's version.
CSGRT_API const char* csgrt_version(void);

// ---- Failures ----

/// The kind of a failure: csgrt::Status, and `unexpected`, which is a fault of csgrt itself.
typedef enum csgrt_status {
    CSGRT_OK = 0,
    CSGRT_ERROR_UNEXPECTED = 1,
    CSGRT_ERROR_USAGE = 2,  ///< an argument is invalid: NULL, a struct's size, an index, a value; the text names it
    CSGRT_ERROR_SCENE = 3,
    CSGRT_ERROR_NO_DEVICE = 4,
    CSGRT_ERROR_OUT_OF_MEMORY = 5,
    CSGRT_ERROR_FILE = 6,
    CSGRT_ERROR_DEVICE_FAULT = 7,
    CSGRT_ERROR_DIFFERS = 8,  ///< csgrt_verifier_result(): an answer is wrong
    CSGRT_ERROR_INTERRUPTED = 130
} csgrt_status;

/// An error, or a fault that was tolerated.
typedef struct csgrt_diagnostic {
    size_t size;
    const char *message, *suggestion;  ///< the fault and what was expected; what to do
    const char *file, *pointer;        ///< the place: the file, and a JSON pointer or an object's name in it
    const char* excerpt;               ///< the line of the file, with a caret under the place
    int line, column;                  ///< from 1; 0: unknown
    int64_t offset;                    ///< bytes; -1: unknown
    uint64_t count;                    ///< number of occurrences
    int appearance;                    ///< 1: the fault changes only colours
} csgrt_diagnostic;

/// The errors of the last call of this thread that failed: all diagnostics as text, and each of them. The pointers are
/// valid until the next call of this thread fails.
CSGRT_API const char* csgrt_last_error(void);
CSGRT_API size_t csgrt_last_diagnostic_count(void);
CSGRT_API csgrt_status csgrt_last_diagnostic(size_t index, csgrt_diagnostic* diagnostic);

// ---- Arguments of calls ----

typedef struct csgrt_vec3 {
    double x, y, z;
} csgrt_vec3;
typedef struct csgrt_box {
    csgrt_vec3 low, high;
} csgrt_box;
typedef struct csgrt_plane {
    csgrt_vec3 normal;
    double distance;  ///< millimetres from the origin, for any length of the normal
} csgrt_plane;

/// A function that is called with `user` and the done fraction, on the calling thread. If it returns 0, the call ends
/// (CSGRT_ERROR_INTERRUPTED).
typedef int (*csgrt_progress)(void* user, double done);

// Values of the members precision and tolerance_rule, as csgrt/method.hpp has them.
enum {
    CSGRT_PRECISION_DOUBLE = 0,
    CSGRT_PRECISION_SINGLE = 1,
    CSGRT_PRECISION_QUAD = 2,
};
enum {
    CSGRT_TOLERANCE_LENGTH = 0,
    CSGRT_TOLERANCE_SURFACES = 1,
    CSGRT_TOLERANCE_RELATIVE = 2,
    CSGRT_TOLERANCE_NONE = 3,
};

/// csgrt::Settings. A NULL pointer stands for the defaults.
typedef struct csgrt_settings {
    size_t size;
    /// Which device: its number in the list of devices, its type ("cpu", "gpu"), or part of its name or platform;
    /// several with commas between them, or all "gpus", share the work.
    const char* device;
    /// The CPU reference computes, not a device.
    int reference;
    /// Calls wait until a GPU's kernels are compiled; else this processor computes until then, with the same bits.
    int wait_for_device;
    /// Seconds that a device may take for an answer before it is given up; 0: no limit. -1: 60 for a GPU and no limit
    /// for a processor.
    double device_timeout;
    /// Bytes of memory to use on each device; a frame that needs more is drawn in batches. 0: what the device has.
    uint64_t max_memory;
    /// The largest number of instances: a solid that the trees use n times counts n times. They are counted before any
    /// is made. 1 to 20000000; 0: what docs/limits.md says.
    uint64_t max_instances;
    /// Number type of the geometry; single precision is relative to the eye.
    int precision;
    /// The rule by which boundaries of segments along a ray count as one point.
    int tolerance_rule;
    /// Millimetres along a ray, if tolerance_rule is a length; negative: the scene's.
    double tolerance;
    /// Regions of air are part of the model.
    int air;
    /// Solids of types that csgrt does not know are left out, with a warning, as they always are in a BRL-CAD database
    /// that is not read strictly.
    int skip_unsupported;
    /// The model's colours are shaded as they are, as BRL-CAD does; else they are decoded from sRGB to linear light
    /// first.
    int display_shading;
    /// The CPU reference traces the first batch of rays and every N-th after it as well, and a call whose bits differ
    /// fails. 0: none.
    unsigned check;
    /// Threads that work on processors at a time, for all calls together. 1 to 4096; 0: one for each processor.
    unsigned threads;
    /// A function that is called with the done fraction, and ends the call if it returns false.
    csgrt_progress progress;  ///< NULL: none
    void* user;
} csgrt_settings;

/// csgrt::DeviceInfo
typedef struct csgrt_device_info {
    size_t size;
    const char* name;
    const char* platform;
    const char* version;
    const char* driver;
    /// "cpu", "gpu" or "accelerator".
    const char* type;
    /// Bytes of the device's memory.
    uint64_t memory;
    /// Largest number of bytes of one buffer.
    uint64_t max_allocation;
    unsigned compute_units;
    /// Whether it computes in double precision.
    int fp64;
} csgrt_device_info;

/// Finds all devices. Any thread. Then csgrt_device() on the same thread returns each device, whose texts are valid
/// until the thread calls csgrt_devices() again.
CSGRT_API csgrt_status csgrt_devices(size_t* count);
CSGRT_API csgrt_status csgrt_device(size_t index, csgrt_device_info* info);
/// Starts the search for devices on another thread, and returns at once. Call it before a scene is loaded: then no
/// later call waits for the search.
CSGRT_API csgrt_status csgrt_prepare_devices(const csgrt_settings* settings);

// ---- Scenes ----

typedef struct csgrt_scene csgrt_scene;

typedef struct csgrt_load_options {
    size_t size;
    /// A BRL-CAD database in which anything is missing or broken is refused, as a .json always is.
    int strict;
    /// Folders below which the scene may name files (the cells of an ebm, vol or dsp), besides its own.
    const char* const* file_folders;
    size_t file_folder_count;
} csgrt_load_options;

/// Reads .json, .g or .asc. CSGRT_ERROR_FILE, or CSGRT_ERROR_SCENE with every error of the file. `options`: NULL for
/// the defaults.
CSGRT_API csgrt_status csgrt_load_scene(const char* path, const csgrt_load_options* options, csgrt_scene** scene);
/// Reads the bytes of such a file. Errors use `name` for the file.
CSGRT_API csgrt_status csgrt_parse_scene(const void* bytes, size_t count, const char* name,
                                         const csgrt_load_options* options, csgrt_scene** scene);
/// An empty scene.
CSGRT_API csgrt_status csgrt_scene_create(csgrt_scene** scene);
CSGRT_API void csgrt_scene_free(csgrt_scene* scene);
/// Writes .json.
CSGRT_API csgrt_status csgrt_save_scene(const csgrt_scene* scene, const char* path);
/// Returns CSGRT_OK, or CSGRT_ERROR_SCENE: then csgrt_last_diagnostic() has every error in the objects and in
/// everything that they use. `objects` are names or paths; none: the scene's top objects. Of the settings, only
/// skip_unsupported and max_instances have an effect.
CSGRT_API csgrt_status csgrt_validate(const csgrt_scene* scene, const char* const* objects, size_t object_count,
                                      const csgrt_settings* settings);

/// One member of a solid: its name as in scenes/csgrt.schema.json and scenes/README.md, its value in millimetres
/// and degrees.
typedef struct csgrt_member {
    const char* name;
    const double* values;   ///< a number, a vector, or a list of vectors: `columns` numbers each, one after the other
    size_t count, columns;  ///< of all numbers; of each vector in a list, or 0 if the value is not a list of vectors
    const char* json;       ///< in place of numbers, any value in JSON, such as "\"plate\""; NULL: `values` counts
} csgrt_member;
#ifndef __cplusplus
/// In C, in a function: {CSGRT_MEMBER("center", 0, 0, 0), CSGRT_MEMBER("radius", 10)}
#define CSGRT_MEMBER(name, ...) \
    { name, (const double[]){__VA_ARGS__}, sizeof((const double[]){__VA_ARGS__}) / sizeof(double), 0, NULL }
#endif
/// Adds a solid, with a type of the scene format: "sphere", "box", "cylinder", "ell", "tgc", ... If the
/// type or a member is wrong, fails with CSGRT_ERROR_SCENE and names the fault.
CSGRT_API csgrt_status csgrt_scene_add_solid(csgrt_scene* scene, const char* name, const char* type,
                                             const csgrt_member* members, size_t member_count);
/// Adds a closed triangle mesh (a bot of mode `volume`). A face is three indices into the vertices.
CSGRT_API csgrt_status csgrt_scene_add_mesh(csgrt_scene* scene, const char* name, const csgrt_vec3* vertices,
                                            size_t vertex_count, const uint32_t* faces, size_t face_count);

typedef enum csgrt_operator {
    CSGRT_LEAF = 0,
    CSGRT_UNION = 1,
    CSGRT_INTERSECTION = 2,
    CSGRT_DIFFERENCE = 3,
    CSGRT_XOR = 4,
    CSGRT_NOT = 5,
} csgrt_operator;
/// A node of a Boolean tree in postfix order: an operator follows its `arity` operands. "ball" without "hole" is
/// {CSGRT_OBJECT("ball"), CSGRT_OBJECT("hole"), CSGRT_JOIN(CSGRT_DIFFERENCE, 2)}.
typedef struct csgrt_tree_node {
    csgrt_operator op;
    uint32_t arity;        ///< of an operator
    const char* object;    ///< of a leaf: the name of a solid or a combination
    const double* matrix;  ///< of a leaf: 16 numbers, from the object's coordinates to the tree's; NULL: the identity
    const char* name;      ///< of a leaf: the leaf's name in paths; NULL: the object's name
} csgrt_tree_node;

/// csgrt::Finish, with the members of csgrt::Emission.
typedef struct csgrt_finish {
    size_t size;
    const char* shader;
    double specular, diffuse, ambient;
    int shine;
    double transmit, reflect;
    int shines;  ///< 1: the region is a light, and the members below have an effect
    double intensity, fraction, angle;
    const csgrt_vec3 *target, *direction;  ///< NULL: not given
    int infinite, visible, shadows;
} csgrt_finish;

/// csgrt::Combination: a named Boolean tree. With `region` it is one part, made of one material.
typedef struct csgrt_combination {
    size_t size;
    const char* name;
    const csgrt_tree_node* nodes;
    size_t node_count;
    int region, fastgen, region_id, air, material_id, los;
    const csgrt_vec3* color;     ///< NULL: not given
    const csgrt_finish* finish;  ///< NULL: not given
    int color_inherits, finish_inherits;
} csgrt_combination;
CSGRT_API csgrt_status csgrt_scene_add_combination(csgrt_scene* scene, const csgrt_combination* combination);

/// csgrt::Camera. Members that are NULL are not given.
typedef struct csgrt_camera {
    size_t size;
    /// Degrees of the direction from the model to the eye: from +x about z.
    double azimuth;
    /// Degrees of the same direction above the xy plane.
    double elevation;
    /// Degrees of the angle of view across the picture's height, below 180; 0: parallel.
    double perspective;
    /// The middle of the picture; the middle of the model's box if not given.
    const csgrt_vec3* center;  ///< NULL: not given
    /// Height of the view at the middle of the picture; the diagonal of the model's box if not given. A parallel view,
    /// however small, shows everything before its plane.
    double view_size;  ///< 0: not given
    /// The position of the eye, in place of azimuth and elevation, which have no effect then. With a perspective the
    /// eye gives the size of the view, too; a parallel view takes only its direction from the eye.
    const csgrt_vec3* eye;  ///< NULL: not given
    /// Another name of the picture's middle.
    const csgrt_vec3* look_at;  ///< NULL: not given
    /// The direction that points up in the picture; +z if not given, or in a view straight down or up the direction
    /// that azimuth 0 has.
    const csgrt_vec3* up;  ///< NULL: not given
} csgrt_camera;
CSGRT_API csgrt_status csgrt_scene_camera(const csgrt_scene* scene, csgrt_camera* camera);
CSGRT_API csgrt_status csgrt_scene_set_camera(csgrt_scene* scene, const csgrt_camera* camera);
/// Sets the scene's camera from a script that MGED's `saveview` wrote.
CSGRT_API csgrt_status csgrt_scene_load_view(csgrt_scene* scene, const char* path);

typedef struct csgrt_light {
    csgrt_vec3 position, color;
    double intensity;
    int infinite;
    double angle;
    csgrt_vec3 direction;
} csgrt_light;
CSGRT_API csgrt_status csgrt_scene_set_lights(csgrt_scene* scene, const csgrt_light* lights, size_t count);
/// Sets the objects that are drawn by default: names or paths; none: the objects that no other object uses.
CSGRT_API csgrt_status csgrt_scene_set_top(csgrt_scene* scene, const char* const* objects, size_t count);
/// Sets the places of these objects, of each 16 numbers, row by row; of none: all stand where they are.
CSGRT_API csgrt_status csgrt_scene_set_top_matrices(csgrt_scene* scene, const double* matrices, size_t count);

/// The plain members of csgrt::Scene.
typedef struct csgrt_scene_info {
    size_t size;
    const char *title, *units;
    double unit_length, ambient;
    csgrt_vec3 background;
    double tolerance;  ///< millimetres; 0: as CSGRT_TOLERANCE_SURFACES
    int lenient;
    size_t object_count, top_count, warning_count;  ///< csgrt_scene_set_info() ignores them
} csgrt_scene_info;
CSGRT_API csgrt_status csgrt_scene_get_info(const csgrt_scene* scene, csgrt_scene_info* info);
CSGRT_API csgrt_status csgrt_scene_set_info(csgrt_scene* scene, const csgrt_scene_info* info);
/// The name and the type of an object. The type is a solid's type ("ell"), "region" or "combination". Either pointer
/// may be NULL.
CSGRT_API csgrt_status csgrt_scene_object(const csgrt_scene* scene, size_t index, const char** name, const char** type);
CSGRT_API csgrt_status csgrt_scene_top(const csgrt_scene* scene, size_t index, const char** object);
CSGRT_API csgrt_status csgrt_scene_top_matrix(const csgrt_scene* scene, size_t index, double matrix[16]);
/// A fault that the file's reader tolerated; `pointer` names the object.
CSGRT_API csgrt_status csgrt_scene_warning(const csgrt_scene* scene, size_t index, csgrt_diagnostic* warning);

// ---- Models ----

/// A compiled scene, which never changes.
typedef struct csgrt_model csgrt_model;

enum {  // state
    CSGRT_STATE_SHOWN = 0,
    CSGRT_STATE_GHOST = 1,
    CSGRT_STATE_HIDDEN = 2,
};
enum {  // fastgen
    CSGRT_FASTGEN_NONE = 0,
    CSGRT_FASTGEN_PLATE = 1,
    CSGRT_FASTGEN_VOLUME = 2,
};

/// Validates and compiles a scene. `objects`: as in csgrt_validate(). CSGRT_ERROR_SCENE, CSGRT_ERROR_USAGE.
CSGRT_API csgrt_status csgrt_model_create(const csgrt_scene* scene, const char* const* objects, size_t object_count,
                                          const csgrt_settings* settings, csgrt_model** model);
CSGRT_API void csgrt_model_free(csgrt_model* model);
/// Returns the scene with all edits.
CSGRT_API csgrt_status csgrt_model_scene(const csgrt_model* model, csgrt_scene** scene);

typedef struct csgrt_model_info {
    size_t size;
    csgrt_box bounds;  ///< millimetres; low > high: no region is bounded
    double tolerance;  ///< millimetres
    size_t region_count, solid_count, warning_count;
} csgrt_model_info;
CSGRT_API csgrt_status csgrt_model_get_info(const csgrt_model* model, csgrt_model_info* info);

/// csgrt::RegionInfo
typedef struct csgrt_region_info {
    size_t size;
    /// "/top/.../region": the members on the way down, by their names. No other region has the same path, and edits of
    /// other regions do not change it: it is the key of the region in a later Model.
    const char* path;
    /// None, plate or volume, as in FASTGEN.
    int fastgen;
    /// BRL-CAD's number of the region, which is not its index.
    int region_id;
    /// BRL-CAD's number of the air; other than 0: a region of air.
    int air;
    /// BRL-CAD's number of the material.
    int material_id;
    /// BRL-CAD's attribute los, percent; kept for conversion.
    int los;
    /// Display values: red, green, blue; 0 to 1.
    csgrt_vec3 color;
    /// Whether pictures show it.
    int state;
    /// Millimetres; as BRL-CAD computes it, so not always tight.
    csgrt_box bounds;
} csgrt_region_info;
/// Fills `info` with the region that has the id `index` in region_ids.
CSGRT_API csgrt_status csgrt_model_region(const csgrt_model* model, size_t index, csgrt_region_info* info);
/// `index`: that of the region that has a path; -1: none has.
CSGRT_API csgrt_status csgrt_model_find_region(const csgrt_model* model, const char* path, int32_t* index);
CSGRT_API csgrt_status csgrt_model_finish(const csgrt_model* model, size_t region, csgrt_finish* finish);

/// csgrt::SolidInfo
typedef struct csgrt_solid_info {
    size_t size;
    /// Name of the object.
    const char* name;
    /// BRL-CAD's name of the type: ell, tgc, arb8, and so on.
    const char* type;
    /// Index, from 0, among the solids into which csgrt cuts a pipe.
    unsigned piece;
} csgrt_solid_info;
/// Fills `info` with the solid that has the id `index`.
CSGRT_API csgrt_status csgrt_model_solid(const csgrt_model* model, size_t index, csgrt_solid_info* info);
/// `json`: the solid's type and parameters in the world as an object of JSON (csgrt::Model::solid(),
/// csgrt::json_text()), valid until the thread's next call of this function; NULL: it has none.
CSGRT_API csgrt_status csgrt_model_solid_json(const csgrt_model* model, size_t index, const char** json);
CSGRT_API csgrt_status csgrt_model_warning(const csgrt_model* model, size_t index, csgrt_diagnostic* warning);

/// csgrt::ChildInfo
typedef struct csgrt_child_info {
    size_t size;
    /// The way down to it, "/top/.../name": what Edit and placement_of() take.
    const char* path;
    /// The last part of the path.
    const char* name;
    /// The object's name, which several members may have.
    const char* object;
    /// "combination", "region", or BRL-CAD's name of the solid's type: ell, tgc, and so on.
    const char* type;
    /// What joins it to the children before it, as BRL-CAD lists a tree; a union for the first.
    int op;
} csgrt_child_info;
/// Called with `user` and a child, whose texts are valid until it returns. 0 ends the call, without a failure.
typedef int (*csgrt_take_child)(void* user, const csgrt_child_info* child);
/// The members of the combination at the end of a path; "/": the objects that are rendered.
CSGRT_API csgrt_status csgrt_model_children(const csgrt_model* model, const char* path, csgrt_take_child take,
                                            void* user);
/// The matrix of a path's last member, row by row.
CSGRT_API csgrt_status csgrt_model_matrix_of(const csgrt_model* model, const char* path, double matrix[16]);
/// All matrices on the way down a path, the last one too: from the object's coordinates to the world's.
CSGRT_API csgrt_status csgrt_model_placement_of(const csgrt_model* model, const char* path, double matrix[16]);

// ---- Rays ----

typedef struct csgrt_ray {
    /// Millimetres.
    csgrt_vec3 origin;
    /// Of any length but 0.
    csgrt_vec3 direction;
} csgrt_ray;
typedef struct csgrt_range {
    /// In lengths of the ray's direction.
    double t_near;
    /// In lengths of the ray's direction.
    double t_far;
} csgrt_range;

/// csgrt::RayGrid: rays in rows and columns, which a device makes itself.
typedef struct csgrt_ray_grid {
    /// Millimetres.
    csgrt_vec3 origin;
    csgrt_vec3 direction;
    /// From a ray to the next one in its row.
    csgrt_vec3 right;
    /// From a ray to the next one in its column.
    csgrt_vec3 up;
    int columns;
    int rows;
    int is_pinhole;
} csgrt_ray_grid;
/// Parallel rays along an axis, 0 to 2, through a box.
CSGRT_API csgrt_status csgrt_rays_parallel(const csgrt_box* box, int axis, int columns, int rows, csgrt_ray_grid* grid);
/// Makes rays from an eye through a picture's pixels. `vertical_fov`: degrees.
CSGRT_API csgrt_status csgrt_rays_pinhole(double vertical_fov, const csgrt_vec3* center, const csgrt_vec3* eye,
                                          const csgrt_vec3* up, int width, int height, csgrt_ray_grid* grid);
/// Returns the ray with the index row x columns + column.
CSGRT_API csgrt_status csgrt_ray_grid_ray(const csgrt_ray_grid* grid, int column, int row, csgrt_ray* ray);

/// Rays, their ranges, and the arrays that the call shall fill.
typedef struct csgrt_rays {
    size_t size;
    const csgrt_ray* list;
    size_t count;
    const csgrt_ray_grid* grid;  ///< in place of the list
    csgrt_range range;           ///< of all rays, in lengths of their directions
    const csgrt_range* ranges;   ///< in place of `range`, one for each ray
    size_t range_count;
    unsigned fields;  ///< of csgrt_partitions, besides regions and distances: CSGRT_FIELD_SOLIDS | ...
} csgrt_rays;
enum {  // fields
    CSGRT_FIELD_SOLIDS = 1,
    CSGRT_FIELD_NORMALS = 2,
    CSGRT_FIELD_OVERLAPS = 4,
    CSGRT_FIELD_WITHOUT_HIDDEN = 8,
};

/// Memory for the partitions along a list of rays, which the next call reuses.
typedef struct csgrt_partitions csgrt_partitions;
CSGRT_API csgrt_status csgrt_partitions_create(csgrt_partitions** partitions);
CSGRT_API void csgrt_partitions_free(csgrt_partitions* partitions);

/// csgrt::Partitions: ray i has the rows [ray_splits[i], ray_splits[i + 1]), in order of distance. Arrays whose field
/// was not chosen are NULL.
typedef struct csgrt_partition_arrays {
    size_t size;
    size_t ray_count, row_count, overlap_count, claimant_count;
    const int64_t* ray_splits;                   ///< (ray_count + 1)
    const int32_t* region_ids;                   ///< (row_count), for csgrt_model_region()
    const double *t_in, *t_out;                  ///< (row_count)
    const int32_t *in_solids, *out_solids;       ///< (row_count), for csgrt_model_solid(); -1: the range's bound
    const csgrt_vec3 *in_normals, *out_normals;  ///< (row_count), unit vectors, outward from the region
    const int64_t* overlap_splits;               ///< (ray_count + 1)
    const double *overlap_t_in, *overlap_t_out;  ///< (overlap_count)
    const int64_t* overlap_region_splits;        ///< (overlap_count + 1)
    const int32_t* overlap_region_ids;           ///< (claimant_count)
} csgrt_partition_arrays;
/// Returns the arrays, without a copy. They are valid until the next call that fills the handle.
CSGRT_API csgrt_status csgrt_partitions_get(const csgrt_partitions* partitions, csgrt_partition_arrays* arrays);

/// The first hits of rays, in the caller's memory: `count` elements in each array, one for each ray. An array that is
/// NULL is not filled.
typedef struct csgrt_hits {
    size_t size;
    size_t count;
    double* t_hit;                    ///< infinity: no hit
    int32_t *region_ids, *solid_ids;  ///< -1: no hit; solid_ids also where the range begins inside the region
    csgrt_vec3* normals;              ///< zeros where the solid is -1
} csgrt_hits;

/// csgrt::Slice: pixels in a plane.
typedef struct csgrt_slice {
    /// Millimetres.
    csgrt_vec3 center;
    /// From a pixel to the next one in its row, millimetres.
    csgrt_vec3 right;
    /// From a pixel to the next one in its column, millimetres.
    csgrt_vec3 up;
    /// Pixels.
    int width;
    /// Pixels.
    int height;
    /// False: regions that pictures do not show (State) are left out.
    int hidden;
} csgrt_slice;
/// The slice of a box by the plane n . p = offset, where n is the unit vector of `normal`.
CSGRT_API csgrt_status csgrt_slice_of(const csgrt_box* box, const csgrt_vec3* normal, double offset, int width,
                                      int height, csgrt_slice* slice);

// The calls below work only on the calling thread, for single rays and short lists. Their answers have the bits of a
// renderer in double precision. CSGRT_ERROR_USAGE names the index of an invalid ray.

CSGRT_API csgrt_status csgrt_model_partitions(const csgrt_model* model, const csgrt_rays* rays,
                                              csgrt_partitions* partitions);
CSGRT_API csgrt_status csgrt_model_cast_rays(const csgrt_model* model, const csgrt_rays* rays, const csgrt_hits* hits);
/// Writes 1 for each of the `count` rays that meets a region within its range, else 0.
CSGRT_API csgrt_status csgrt_model_occluded(const csgrt_model* model, const csgrt_rays* rays, uint8_t* answers,
                                            size_t count);
/// Finds the region that holds each of `count` points; -1: no region.
CSGRT_API csgrt_status csgrt_model_region_at(const csgrt_model* model, const csgrt_vec3* points, int32_t* ids,
                                             size_t count);
/// Finds the region at each pixel, row by row from the top left; count = width x height. -1: no region; -2: several
/// regions overlap.
CSGRT_API csgrt_status csgrt_model_slice(const csgrt_model* model, const csgrt_slice* slice, int32_t* ids,
                                         size_t count);

// ---- Renderers ----

/// Draws models and traces rays, on a device.
typedef struct csgrt_renderer csgrt_renderer;
/// Failures: CSGRT_ERROR_USAGE, CSGRT_ERROR_NO_DEVICE, CSGRT_ERROR_OUT_OF_MEMORY, CSGRT_ERROR_DEVICE_FAULT.
CSGRT_API csgrt_status csgrt_renderer_create(const csgrt_model* model, const csgrt_settings* settings,
                                             csgrt_renderer** renderer);
/// May wait for a driver that is compiling, for half a minute at most.
CSGRT_API void csgrt_renderer_free(csgrt_renderer* renderer);
CSGRT_API csgrt_status csgrt_renderer_model(const csgrt_renderer* renderer, csgrt_model** model);
CSGRT_API csgrt_status csgrt_renderer_set_model(csgrt_renderer* renderer, const csgrt_model* model);

// The calls below do the same as the calls on a model, on the renderer's device. They may also fail with
// CSGRT_ERROR_OUT_OF_MEMORY, CSGRT_ERROR_DEVICE_FAULT and CSGRT_ERROR_INTERRUPTED.

CSGRT_API csgrt_status csgrt_renderer_partitions(csgrt_renderer* renderer, const csgrt_rays* rays,
                                                 csgrt_partitions* partitions);
CSGRT_API csgrt_status csgrt_renderer_cast_rays(csgrt_renderer* renderer, const csgrt_rays* rays,
                                                const csgrt_hits* hits);
CSGRT_API csgrt_status csgrt_renderer_occluded(csgrt_renderer* renderer, const csgrt_rays* rays, uint8_t* answers,
                                               size_t count);
CSGRT_API csgrt_status csgrt_renderer_region_at(csgrt_renderer* renderer, const csgrt_vec3* points, int32_t* ids,
                                                size_t count);
CSGRT_API csgrt_status csgrt_renderer_slice(csgrt_renderer* renderer, const csgrt_slice* slice, int32_t* ids,
                                            size_t count);
/// A function that is called with `user`, the partitions of a batch, and the index of the batch's first ray. If it
/// returns 0, the call ends, without a failure.
typedef int (*csgrt_take)(void* user, const csgrt_partitions* batch, uint64_t first_ray);
/// Computes partitions in batches of at most `most` rays, for any number of rays.
CSGRT_API csgrt_status csgrt_renderer_partitions_in_batches(csgrt_renderer* renderer, const csgrt_rays* rays,
                                                            uint64_t most, csgrt_take take, void* user);

/// csgrt::Statistics of the last call, in milliseconds and bytes.
typedef struct csgrt_statistics {
    size_t size;
    /// The device that computed, or "reference".
    const char* device;
    /// The device that is made ready at the time of this call and will replace `device`: its name, "gpu" while none is
    /// found, empty if none is awaited.
    const char* awaited_device;
    /// "double", "single" or "quad".
    const char* precision;
    /// The numerical method, in a few words.
    const char* method;
    /// The tolerance in millimetres, which Settings::tolerance_rule gave.
    double tolerance;
    /// Width of the picture, pixels; 0 for rays.
    int width;
    /// Height of the picture, pixels; 0 for rays.
    int height;
    uint64_t rays;
    /// Number of boundaries of segments along all rays.
    uint64_t ends;
    /// Intervals of rays inside single solids.
    uint64_t segments;
    /// Intervals between neighbouring boundaries that are inside any solid.
    uint64_t partitions_used;
    /// Number of partitions for which memory was allocated.
    uint64_t partitions_allocated;
    /// Partitions that several regions of the same rank claim.
    uint64_t overlaps;
    /// Memory in use on all devices.
    uint64_t device_bytes;
    /// Memory for segments, all batches.
    uint64_t segment_bytes;
    /// Memory for partitions, all batches.
    uint64_t partition_bytes;
    /// Number of batches of rays.
    unsigned batches;
    /// Reading the scene's file. Only the command line sets this member.
    double ms_load;
    /// Compiling the scene.
    double ms_compile;
    /// Finding devices and compiling all kernels so far. A call that waits for this does not count the wait as `frame`.
    double ms_build;
    double ms_count_segments;
    double ms_scan;
    double ms_store_segments;
    double ms_weave;
    double ms_evaluate;
    double ms_shade;
    double ms_rows;
    double ms_cull_tiles;
    double ms_first_hits;
    /// Time in which kernels ran on a device, one or several at once.
    double ms_kernels;
    /// The whole call, on the host's clock.
    double ms_frame;
    /// Writing the picture's file. Only the command line sets this member.
    double ms_write;
} csgrt_statistics;
CSGRT_API csgrt_status csgrt_renderer_statistics(const csgrt_renderer* renderer, csgrt_statistics* statistics);
/// csgrt::Renderer::device_warnings(), which the model's warnings (csgrt_model_warning) do not have.
CSGRT_API csgrt_status csgrt_renderer_device_warning_count(const csgrt_renderer* renderer, size_t* count);
CSGRT_API csgrt_status csgrt_renderer_device_warning(const csgrt_renderer* renderer, size_t index,
                                                     csgrt_diagnostic* warning);

// ---- Pictures ----

enum {  // channels
    CSGRT_CHANNEL_COLOR = 1,
    CSGRT_CHANNEL_DISTANCE = 2,
    CSGRT_CHANNEL_NORMAL = 4,
    CSGRT_CHANNEL_IDS = 8,
    CSGRT_CHANNEL_COUNTS = 16,
    CSGRT_CHANNEL_ALL = 31,
    CSGRT_CHANNEL_DISPLAY = 32,
    CSGRT_CHANNEL_GHOSTS = 64,
};

enum {  // csgrt_view::light
    CSGRT_LIGHT_MODEL = 0,
    CSGRT_LIGHT_HEADLIGHT = 1,
    CSGRT_LIGHT_STUDIO = 2,
};

typedef struct csgrt_pixel_rectangle {
    int left;
    int top;
    int width;
    int height;
} csgrt_pixel_rectangle;

/// csgrt::View: what to draw.
typedef struct csgrt_view {
    size_t size;
    /// Pixels. 1 to 32768.
    int width;
    /// Pixels. 1 to 32768.
    int height;
    const csgrt_camera* camera;  ///< NULL: CSGRT_CAMERA
    /// Everything along each ray is computed; else first hits alone, several times faster, without the channels depth,
    /// partitions and overlap.
    int every_partition;
    /// The groups of channels that the picture has, a bit each.
    unsigned channels;
    /// Up to six planes, which cut away everything beyond them.
    const csgrt_plane* clip;
    size_t clip_count;
    /// The only pixels that are drawn, each as in the whole picture.
    const csgrt_pixel_rectangle* part;  ///< NULL: all of them
    /// Rays a pixel; the colours are their mean. 1 to 256.
    int samples;
    /// No background: red, green, blue and alpha are 0 where a ray hits nothing.
    int transparent;
    /// Black lines where the region, the surface's direction or its depth changes from pixel to pixel.
    int edges;
    /// Where light comes from.
    int light;
} csgrt_view;

/// A picture's memory, which the next frame reuses.
typedef struct csgrt_image csgrt_image;
CSGRT_API csgrt_status csgrt_image_create(csgrt_image** image);
CSGRT_API void csgrt_image_free(csgrt_image* image);
CSGRT_API csgrt_status csgrt_renderer_render(csgrt_renderer* renderer, const csgrt_view* view, csgrt_image* image);

typedef struct csgrt_image_info {
    size_t size;
    int width, height;
    size_t channel_count;
    int display_values;  ///< 1: R G B are display values; 0: linear light
} csgrt_image_info;
CSGRT_API csgrt_status csgrt_image_get_info(const csgrt_image* image, csgrt_image_info* info);
/// The name of a channel ("R", "Z", "region", ... csgrt::Image has the list), and whether it holds ids.
CSGRT_API csgrt_status csgrt_image_channel_name(const csgrt_image* image, size_t index, const char** name,
                                                int* holds_ids);
/// The values of a channel, without a copy: width x height, row by row from the top left.
CSGRT_API csgrt_status csgrt_image_channel(const csgrt_image* image, const char* name, const float** values,
                                           size_t* count);
/// The ids of a channel of ids, without a copy: index + 1; 0: nothing.
CSGRT_API csgrt_status csgrt_image_ids(const csgrt_image* image, const char* name, const uint32_t** ids, size_t* count);
/// Copies channels of floats: for each pixel the values of all `names`; count = width x height x name_count.
CSGRT_API csgrt_status csgrt_image_copy(const csgrt_image* image, const char* const* names, size_t name_count,
                                        float* values, size_t count);
/// Copies the colours for a display: R G B A of each pixel, a byte each; count = width x height x 4. The picture must
/// have the channels of CSGRT_CHANNEL_COLOR or, faster, of CSGRT_CHANNEL_DISPLAY.
CSGRT_API csgrt_status csgrt_image_display_pixels(const csgrt_image* image, unsigned char* bytes, size_t count);

/// csgrt::Pick: the hit that a picture shows at a pixel.
typedef struct csgrt_pick {
    size_t size;
    int32_t region, solid;  ///< -1: nothing
    double t;
    csgrt_vec3 point, normal;
    csgrt_ray ray;  ///< for csgrt_model_partitions()
} csgrt_pick;
CSGRT_API csgrt_status csgrt_model_pick(const csgrt_model* model, const csgrt_view* view, int column, int row,
                                        csgrt_pick* pick);
/// Makes the rays of a whole view, one for each pixel.
CSGRT_API csgrt_status csgrt_model_grid_of(const csgrt_model* model, const csgrt_view* view, csgrt_ray_grid* grid);

// ---- Edits ----

/// csgrt::Edit: changes to a model. csgrt_edit_commit() makes the next model with all of them. If a path leads to no
/// object, the call fails, or csgrt_edit_commit() does.
typedef struct csgrt_edit csgrt_edit;
CSGRT_API csgrt_status csgrt_edit_create(const csgrt_model* model, csgrt_edit** edit);
CSGRT_API void csgrt_edit_free(csgrt_edit* edit);
CSGRT_API csgrt_status csgrt_edit_set_color(csgrt_edit* edit, const char* path, const csgrt_vec3* color);
CSGRT_API csgrt_status csgrt_edit_set_finish(csgrt_edit* edit, const char* path, const csgrt_finish* finish);
CSGRT_API csgrt_status csgrt_edit_set_state(csgrt_edit* edit, const char* path, int state);
CSGRT_API csgrt_status csgrt_edit_set_lights(csgrt_edit* edit, const csgrt_light* lights, size_t count);
CSGRT_API csgrt_status csgrt_edit_set_ambient(csgrt_edit* edit, double intensity);
CSGRT_API csgrt_status csgrt_edit_set_background(csgrt_edit* edit, const csgrt_vec3* color);
/// Sets the matrix of a path's last member; of a path of one part, the matrix of a top object. `share_all`: 1 for all
/// instances that share the member, 0 for only this instance.
CSGRT_API csgrt_status csgrt_edit_set_matrix(csgrt_edit* edit, const char* path, const double matrix[16],
                                             int share_all);
/// Multiplies the placement of a path (csgrt_model_placement_of()) by `matrix`, on the left: it moves in the world.
CSGRT_API csgrt_status csgrt_edit_move(csgrt_edit* edit, const char* path, const double matrix[16], int share_all);
/// Gives the model's solid `solid` the shape of the scene's solid `name`. If `name` is a combination of one solid, its
/// matrix counts, too.
CSGRT_API csgrt_status csgrt_edit_replace(csgrt_edit* edit, const char* solid, const csgrt_scene* scene,
                                          const char* name);
/// Adds a scene's object to the model. `top`: 1 makes it one of the top objects.
CSGRT_API csgrt_status csgrt_edit_add(csgrt_edit* edit, const csgrt_scene* scene, const char* name, int top);
/// Renders an object that the scene of the model has. `matrix`: its place, 16 numbers, or NULL.
CSGRT_API csgrt_status csgrt_edit_add_top(csgrt_edit* edit, const char* object, const double* matrix);
/// Adds a member to a combination: its tree becomes tree `op` member. `matrix`: 16 numbers, or NULL.
CSGRT_API csgrt_status csgrt_edit_add_leg(csgrt_edit* edit, const char* combination, csgrt_operator op,
                                          const char* object, const double* matrix);
CSGRT_API csgrt_status csgrt_edit_remove(csgrt_edit* edit, const char* path);
/// Removes the last member of a path, as csgrt_edit_remove() does, and deletes its object and all below it that nothing
/// else uses.
CSGRT_API csgrt_status csgrt_edit_erase(csgrt_edit* edit, const char* path);
/// Makes the next model. The edits stay in `edit`.
CSGRT_API csgrt_status csgrt_edit_commit(const csgrt_edit* edit, csgrt_model** model);

// ---- Verification ----

/// csgrt::Verifier: compares a device with the reference, and both of them with 113-bit arithmetic.
typedef struct csgrt_verifier csgrt_verifier;
CSGRT_API csgrt_status csgrt_verifier_create(const csgrt_scene* scene, const char* const* objects, size_t object_count,
                                             const csgrt_settings* settings, csgrt_verifier** verifier);
CSGRT_API void csgrt_verifier_free(csgrt_verifier* verifier);
/// Makes `count` rays, in the caller's memory. `camera`: NULL for CSGRT_CAMERA.
CSGRT_API csgrt_status csgrt_verifier_sample(const csgrt_verifier* verifier, const csgrt_camera* camera, uint64_t seed,
                                             csgrt_ray* rays, size_t count);
CSGRT_API csgrt_status csgrt_verifier_shoot(csgrt_verifier* verifier, const csgrt_ray* rays, size_t count);

/// The main members of csgrt::Verification, for all rays so far.
typedef struct csgrt_verification {
    size_t size;
    const char* device;  ///< "": only the reference is verified
    uint64_t rays, hits, decided, ties, wrong, bit_differences, ends, leaping_ends;
    double largest_error, largest_ulps;  ///< of a boundary: millimetres along the ray, and units of the last place
    uint64_t first_wrong;                ///< the index of the first wrong ray, if there is a wrong ray
    csgrt_ray wrong_ray;                 ///< the first wrong ray
} csgrt_verification;
/// Fills the result, and returns CSGRT_OK if no ray is wrong and no bit differs, else CSGRT_ERROR_DIFFERS.
CSGRT_API csgrt_status csgrt_verifier_result(const csgrt_verifier* verifier, csgrt_verification* result);

// ---- Measures ----

/// A row of a table of densities, as csgrt::Density.
typedef struct csgrt_density {
    int material_id;   ///< of the regions, if `path` is NULL or empty
    const char* path;  ///< the path of a region, or its beginning up to a '/' for all regions below
    double density;    ///< g/cm^3
    const char* name;  ///< of the material; may be NULL
} csgrt_density;

/// csgrt::MeasureRequest
typedef struct csgrt_measure_request {
    size_t size;
    /// Half of the interval of a volume, relative to the volume, that each region shall reach.
    double rel_error;
    /// Half of the interval of a volume, in mm^3, that is enough for each region in any case. 0: a billionth of the
    /// relative error of the model's volume.
    double abs_error;
    /// Seconds after which no more rays are traced; the first rays, some 50,000, always are. 0: no limit.
    double time;
    /// Rays through the whole model to trace, in place of errors to reach. 0: the errors count.
    uint64_t rays;
    /// Seed of the random numbers.
    uint64_t seed;
    /// Densities of the regions; if empty, there are no masses.
    const csgrt_density* densities;
    size_t density_count;
    /// The smallest wall of each region is searched.
    int walls;
    /// Millimetres: regions with a thinner wall are counted. 0: none is.
    double wall_limit;
    /// Cells along x, y and z of a grid over the box of what is measured, in each of which volumes are measured, too.
    /// 0: no grid.
    uint32_t grid[3];
} csgrt_measure_request;

/// A number, and half the width of its 95 % interval.
typedef struct csgrt_estimate {
    double value, half_width;
} csgrt_estimate;

enum {
    CSGRT_MEASURED_ALL = 0,
    CSGRT_MEASURED_ASSEMBLY = 1,
    CSGRT_MEASURED_MATERIAL = 2,
    CSGRT_MEASURED_REGION = 3,
};

/// csgrt::Measured: the figures of one region, or of several together.
typedef struct csgrt_measured {
    size_t size;
    int kind;                                    ///< CSGRT_MEASURED_...
    const char* name;                            ///< the path of a region or an assembly; the name of a material
    int32_t id;                                  ///< of a region its index, of a material BRL-CAD's number; else -1
    csgrt_estimate volume, claimed, area, mass;  ///< mm^3, mm^3, mm^2, kg
    csgrt_estimate centroid[3];                  ///< mm
    /// Moments xx, yy, zz and products xy, yz, zx about the world's origin and about the centroid: kg mm^2, without
    /// densities mm^5.
    csgrt_estimate origin[6], central[6];
    csgrt_box box;                                 ///< millimetres; holds the regions
    uint64_t regions, reached, unmet, weightless;  ///< numbers of regions
    double unmet_bound;                            ///< mm^3: what unmet regions may have at most
    uint64_t thin;                                 ///< number of regions with a wall below the limit
    double wall;                                   ///< millimetres: the smallest wall; 0: none, or not asked for
    csgrt_vec3 wall_from, wall_to;                 ///< its ends
    int is_tapered;                                ///< whether its faces are not parallel there
    double wall_shares[32];                        ///< of the boundary: walls of 2^(i - 16) to 2^(i - 15) mm
} csgrt_measured;

/// The members of csgrt::Measurement besides its parts.
typedef struct csgrt_measurement {
    size_t size;
    int has_densities, reached;
    uint64_t rays;
    double seconds;
    size_t parts;  ///< number of parts, see csgrt_measurer_part()
} csgrt_measurement;

/// csgrt::Measurer: volumes, masses, areas and moments of a model's parts, each with a 95 % interval.
typedef struct csgrt_measurer csgrt_measurer;
CSGRT_API csgrt_status csgrt_measurer_create(const csgrt_model* model, const csgrt_settings* settings,
                                             csgrt_measurer** measurer);
CSGRT_API void csgrt_measurer_free(csgrt_measurer* measurer);
/// Measures until the request is met. `request`: NULL for CSGRT_MEASURE_REQUEST.
CSGRT_API csgrt_status csgrt_measurer_measure(csgrt_measurer* measurer, const csgrt_measure_request* request,
                                              csgrt_measurement* result);
/// A part of the last result: all together, then assemblies, materials, regions. Its name is valid until the next call
/// of csgrt_measurer_measure().
CSGRT_API csgrt_status csgrt_measurer_part(const csgrt_measurer* measurer, size_t index, csgrt_measured* part);
/// csgrt::CellVolumes: `count` elements of each array; `cells` has three numbers for each.
typedef struct csgrt_cell_volumes {
    size_t count;
    const int32_t *cells, *ids;
    const double *volumes, *half_widths;  ///< mm^3
} csgrt_cell_volumes;
/// csgrt::MeasuredGrid: the volumes in the cells of csgrt_measure_request::grid.
typedef struct csgrt_measured_grid {
    size_t size;
    uint32_t sides[3];  ///< numbers of cells along x, y and z; 0: there is no grid
    csgrt_box box;      ///< millimetres
    csgrt_cell_volumes regions, materials;
} csgrt_measured_grid;
/// The grid of the last result. Its arrays are valid until the next call of csgrt_measurer_measure().
CSGRT_API csgrt_status csgrt_measurer_grid(const csgrt_measurer* measurer, csgrt_measured_grid* grid);
/// Reads a table of densities (csgrt::load_densities()), which counts for requests without densities.
CSGRT_API csgrt_status csgrt_measurer_load_densities(csgrt_measurer* measurer, const char* path);

// ---- Checks ----

/// csgrt::AllowedOverlap: patterns of the paths of two regions that may overlap.
typedef struct csgrt_allowed_overlap {
    const char *first, *second;
} csgrt_allowed_overlap;

/// csgrt::CheckRequest
typedef struct csgrt_check_request {
    size_t size;
    /// Millimetres: the diameter of the largest ball in an overlap from which on it counts.
    double min_depth;
    /// Millimetres, at least `min_depth`: each pair whose overlap holds a ball of this diameter is listed. 0: no such
    /// promise.
    double certain;
    /// How many times the usual number of cells of a candidate are searched.
    double effort;
    /// Seed of the random numbers.
    uint64_t seed;
    /// Pairs of regions whose overlaps are allowed.
    const csgrt_allowed_overlap* allowed;
    size_t allowed_count;
} csgrt_check_request;

/// csgrt::CheckResult. In place of a list it has the length.
typedef struct csgrt_check_result {
    size_t size;
    /// At least half of the least depth deep, the deepest first. With CheckRequest::certain, less deep ones, too, if
    /// their `depth_at_most` is not below it.
    uint64_t overlaps;
    /// All other candidates, the largest `depth_at_most` first.
    uint64_t unlisted;
    /// Rows of the request's list that no overlap needs.
    uint64_t unused;
    /// Indices of regions without an end. Only their parts within the box of all others were searched.
    uint64_t unbounded;
    /// Number of overlaps that are new.
    uint64_t new_overlaps;
    /// Number of pairs of regions whose boxes overlap.
    uint64_t candidates;
    /// Number of pairs that overlap by less than half of the least depth.
    uint64_t shallow;
    /// Number of rays that were traced in all.
    uint64_t rays;
    /// False: the caller has ended the check. Depths that are not known then are 0.
    int is_complete;
    /// Seconds that the call took.
    double seconds;
} csgrt_check_result;

/// csgrt::FoundOverlap
typedef struct csgrt_found_overlap {
    size_t size;
    /// Indices of the regions, ascending: the first one owns it.
    uint32_t regions[2];
    /// Millimetres: the centre of the largest ball that was found in it.
    csgrt_vec3 place;
    /// Millimetres: the diameter of the largest ball that was found in it.
    double depth;
    /// Whether the ball was only measured along rays, and may be too large. Else it lies in the overlap, by the
    /// distances from the surfaces of the regions' solids.
    int is_estimate;
    /// Millimetres: no ball in it has a larger diameter.
    double depth_at_most;
    /// In mm^3.
    csgrt_estimate volume;
    /// Millimetres: of the parts of rays that both claim.
    csgrt_box box;
    /// The ray, through the place, that shows it.
    csgrt_ray ray;
    /// Where the ray goes in and out: millimetres along it.
    double t_in;
    double t_out;
    /// Whether a row of the request's list allows it.
    int is_allowed;
    /// Whether it is between half of the least depth and twice the least depth: another seed may decide otherwise.
    int is_near_limit;
    /// Whether it is not allowed, and at least the least depth deep.
    int is_new;
} csgrt_found_overlap;

/// csgrt::UnlistedPair
typedef struct csgrt_unlisted_pair {
    size_t size;
    /// Indices of the regions, ascending.
    uint32_t regions[2];
    /// Whether the two were found to overlap.
    int is_seen;
    /// Millimetres: no ball in an overlap of the two has a larger diameter.
    double depth_at_most;
} csgrt_unlisted_pair;

/// csgrt::Checker: the regions of a model that overlap.
typedef struct csgrt_checker csgrt_checker;
CSGRT_API csgrt_status csgrt_checker_create(const csgrt_model* model, const csgrt_settings* settings,
                                            csgrt_checker** checker);
CSGRT_API void csgrt_checker_free(csgrt_checker* checker);
/// Searches. `request`: NULL for CSGRT_CHECK_REQUEST. If csgrt_settings::progress ends the check, the result is what
/// was found until then, and CSGRT_OK is returned.
CSGRT_API csgrt_status csgrt_checker_check(csgrt_checker* checker, const csgrt_check_request* request,
                                           csgrt_check_result* result);
/// Items of the lists of the last result. The texts are valid until the next call of csgrt_checker_check().
CSGRT_API csgrt_status csgrt_checker_overlap(const csgrt_checker* checker, size_t index, csgrt_found_overlap* overlap);
CSGRT_API csgrt_status csgrt_checker_unlisted(const csgrt_checker* checker, size_t index, csgrt_unlisted_pair* pair);
CSGRT_API csgrt_status csgrt_checker_unused(const csgrt_checker* checker, size_t index, csgrt_allowed_overlap* row);
CSGRT_API csgrt_status csgrt_checker_unbounded(const csgrt_checker* checker, size_t index, uint32_t* region);
/// Reads a list of allowed overlaps (csgrt::load_allowed_overlaps()), which counts for requests without a list.
CSGRT_API csgrt_status csgrt_checker_load_allowed(csgrt_checker* checker, const char* path);

// ---- Defaults ----

// The defaults are macros for C and C++, and functions for other languages: each function puts the defaults into a
// struct.
CSGRT_API void csgrt_diagnostic_init(csgrt_diagnostic* diagnostic);
CSGRT_API void csgrt_settings_init(csgrt_settings* settings);
CSGRT_API void csgrt_device_info_init(csgrt_device_info* device_info);
CSGRT_API void csgrt_load_options_init(csgrt_load_options* load_options);
CSGRT_API void csgrt_finish_init(csgrt_finish* finish);
CSGRT_API void csgrt_combination_init(csgrt_combination* combination);
CSGRT_API void csgrt_camera_init(csgrt_camera* camera);
CSGRT_API void csgrt_scene_info_init(csgrt_scene_info* scene_info);
CSGRT_API void csgrt_model_info_init(csgrt_model_info* model_info);
CSGRT_API void csgrt_region_info_init(csgrt_region_info* region_info);
CSGRT_API void csgrt_solid_info_init(csgrt_solid_info* solid_info);
CSGRT_API void csgrt_child_info_init(csgrt_child_info* child_info);
CSGRT_API void csgrt_rays_init(csgrt_rays* rays);
CSGRT_API void csgrt_partition_arrays_init(csgrt_partition_arrays* partition_arrays);
CSGRT_API void csgrt_hits_init(csgrt_hits* hits);
CSGRT_API void csgrt_statistics_init(csgrt_statistics* statistics);
CSGRT_API void csgrt_view_init(csgrt_view* view);
CSGRT_API void csgrt_image_info_init(csgrt_image_info* image_info);
CSGRT_API void csgrt_pick_init(csgrt_pick* pick);
CSGRT_API void csgrt_verification_init(csgrt_verification* verification);
CSGRT_API void csgrt_measure_request_init(csgrt_measure_request* measure_request);
CSGRT_API void csgrt_measured_init(csgrt_measured* measured);
CSGRT_API void csgrt_measurement_init(csgrt_measurement* measurement);
CSGRT_API void csgrt_measured_grid_init(csgrt_measured_grid* measured_grid);
CSGRT_API void csgrt_check_request_init(csgrt_check_request* check_request);
CSGRT_API void csgrt_check_result_init(csgrt_check_result* check_result);
CSGRT_API void csgrt_found_overlap_init(csgrt_found_overlap* found_overlap);
CSGRT_API void csgrt_unlisted_pair_init(csgrt_unlisted_pair* unlisted_pair);

// clang-format off
#define CSGRT_DIAGNOSTIC {sizeof(csgrt_diagnostic), "", "", "", "", "", 0, 0, -1, 1, 0}
#define CSGRT_SETTINGS {sizeof(csgrt_settings), "", 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, NULL, NULL}
#define CSGRT_DEVICE_INFO {sizeof(csgrt_device_info), "", "", "", "", "", 0, 0, 0, 0}
#define CSGRT_LOAD_OPTIONS {sizeof(csgrt_load_options), 0, NULL, 0}
#define CSGRT_OBJECT(object) {CSGRT_LEAF, 0, object, NULL, NULL}
#define CSGRT_PLACED(object, matrix) {CSGRT_LEAF, 0, object, matrix, NULL}
#define CSGRT_JOIN(op, arity) {op, arity, NULL, NULL, NULL}
#define CSGRT_FINISH {sizeof(csgrt_finish), "plastic", 0.7, 0.3, 1, 10, 0, 0, 0, 1, 0, 180, NULL, NULL, 0, 1, 1}
#define CSGRT_COMBINATION {sizeof(csgrt_combination), "", NULL, 0, 0, 0, 0, 0, 1, 100, NULL, NULL, 0, 0}
#define CSGRT_CAMERA {sizeof(csgrt_camera), 35, 25, 0, NULL, 0, NULL, NULL, NULL}
#define CSGRT_LIGHT {{0, 0, 0}, {1, 1, 1}, 1, 0, 180, {0, 0, -1}}
#define CSGRT_SCENE_INFO {sizeof(csgrt_scene_info), "", "mm", 1, 0.4, {0, 0, 0}, 0, 0, 0, 0, 0}
#define CSGRT_MODEL_INFO {sizeof(csgrt_model_info), {{0, 0, 0}, {0, 0, 0}}, 0, 0, 0, 0}
#define CSGRT_REGION_INFO {sizeof(csgrt_region_info), "", 0, 0, 0, 0, 0, {1, 1, 1}, 0, {{0, 0, 0}, {0, 0, 0}}}
#define CSGRT_SOLID_INFO {sizeof(csgrt_solid_info), "", "", 0}
#define CSGRT_CHILD_INFO {sizeof(csgrt_child_info), "", "", "", "", 1}
#define CSGRT_RAYS {sizeof(csgrt_rays), NULL, 0, NULL, {0, HUGE_VAL}, NULL, 0, 0}
#define CSGRT_PARTITION_ARRAYS {sizeof(csgrt_partition_arrays), 0, 0, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, \
    NULL, NULL, NULL, NULL, NULL, NULL, NULL}
#define CSGRT_HITS {sizeof(csgrt_hits), 0, NULL, NULL, NULL, NULL}
#define CSGRT_STATISTICS {sizeof(csgrt_statistics), "", "", "", "", 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, \
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}
#define CSGRT_VIEW {sizeof(csgrt_view), 1024, 1024, NULL, 1, 31, NULL, 0, NULL, 1, 0, 0, 0}
#define CSGRT_IMAGE_INFO {sizeof(csgrt_image_info), 0, 0, 0, 0}
#define CSGRT_PICK {sizeof(csgrt_pick), -1, -1, 0, {0, 0, 0}, {0, 0, 0}, {{0, 0, 0}, {0, 0, 0}}}
#define CSGRT_VERIFICATION {sizeof(csgrt_verification), "", 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, {{0, 0, 0}, {0, 0, 0}}}
#define CSGRT_MEASURE_REQUEST {sizeof(csgrt_measure_request), 0.01, 0, 0, 0, 1, NULL, 0, 0, 0, {0, 0, 0}}
#define CSGRT_MEASURED {sizeof(csgrt_measured), 0, "", -1, {0, 0}, {0, 0}, {0, 0}, {0, 0}, \
    {{0, 0}, {0, 0}, {0, 0}}, {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}, \
    {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}, {{0, 0, 0}, {0, 0, 0}}, 0, 0, 0, 0, 0, \
    0, 0, {0, 0, 0}, {0, 0, 0}, 0, {0}}
#define CSGRT_MEASUREMENT {sizeof(csgrt_measurement), 0, 0, 0, 0, 0}
#define CSGRT_MEASURED_GRID {sizeof(csgrt_measured_grid), {0, 0, 0}, {{0, 0, 0}, {0, 0, 0}}, \
    {0, NULL, NULL, NULL, NULL}, {0, NULL, NULL, NULL, NULL}}
#define CSGRT_CHECK_REQUEST {sizeof(csgrt_check_request), 0.01, 0, 1, 1, NULL, 0}
#define CSGRT_CHECK_RESULT {sizeof(csgrt_check_result), 0, 0, 0, 0, 0, 0, 0, 0, 1, 0}
#define CSGRT_FOUND_OVERLAP {sizeof(csgrt_found_overlap), {0, 0}, {0, 0, 0}, 0, 1, 0, {0, 0}, {{0, 0, 0}, {0, 0, 0}}, \
    {{0, 0, 0}, {0, 0, 0}}, 0, 0, 0, 0, 0}
#define CSGRT_UNLISTED_PAIR {sizeof(csgrt_unlisted_pair), {0, 0}, 0, 0}
// clang-format on

#ifdef __cplusplus
}
#endif

#endif
