// Model: a compiled scene, which Renderers draw and single rays meet.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <csgrt/partitions.hpp>
#include <csgrt/scene.hpp>
#include <csgrt/settings.hpp>
#include <csgrt/view.hpp>

namespace csgrt {

/// One region of the compiled model.
struct RegionInfo {
    /// "/top/.../region": the members on the way down, by their names. No other region has the same path, and edits
    /// of other regions do not change it: it is the key of the region in a later Model.
    std::string path = {};
    Fastgen fastgen = Fastgen::none;  ///< None, plate or volume, as in FASTGEN.
    int region_id = 0;                ///< BRL-CAD's number of the region, which is not its index.
    int air = 0;                      ///< BRL-CAD's number of the air; other than 0: a region of air.
    int material_id = 0;              ///< BRL-CAD's number of the material.
    int los = 0;                      ///< BRL-CAD's attribute los, percent; kept for conversion.
    Vec3 color{1, 1, 1};              ///< Display values: red, green, blue; 0 to 1.
    Finish finish = {};
    State state = State::shown;  ///< Whether pictures show it.
    Box bounds = {};             ///< Millimetres; as BRL-CAD computes it, so not always tight.
};

/// One solid of the compiled model.
struct SolidInfo {
    std::string name = {};    ///< The object's.
    std::string type = {};    ///< BRL-CAD's name of the type: ell, tgc, arb8, and so on.
    std::uint32_t piece = 0;  ///< From 0: which of the solids into which csgrt cuts a pipe.
};

/// A compiled scene. It never changes: any number of threads may use it, and any number of Renderers draw it. A copy is
/// the same model. A child of fork() may use its parent's.
class CSGRT_API Model {
public:
    /// Validates and compiles `scene`, and keeps it for edits (see Edit). `objects` are names, or paths such as
    /// "all.g/tor.r", which give an object the transform and the attributes that it has there; none: the scene's top
    /// objects. Of the settings, the scene's own count (air, skip_unsupported, display_shading, max_instances), the
    /// tolerance and `threads`. Throws Error: scene, usage.
    explicit Model(Scene scene, const std::vector<std::string>& objects = {}, const Settings& settings = {});

    // The references are valid as long as any copy of the Model.

    /// The box around all regions' boxes, millimetres; low > high if no region is bounded.
    const Box& bounds() const;
    /// The regions; their index is that of Partitions::region_ids.
    const std::vector<RegionInfo>& regions() const;
    /// The solids; their index is that of Partitions::in_solids.
    const std::vector<SolidInfo>& solids() const;
    /// Faults that the scene's reader tolerated, objects that were left out, and other notes, each once per object and
    /// reason. Pictures have the first of them in their attribute csgrt:warnings.
    const std::vector<Warning>& warnings() const;
    /// Millimetres: boundaries along a ray that are closer than this count as one. See Settings::tolerance_rule.
    double tolerance() const;
    /// The scene with all edits: a Model compiled from it is the same.
    Scene scene() const;

    /// The rays of a whole view in double precision, one a pixel. Throws Error (usage).
    RayGrid grid_of(const View& view) const;
    /// The ray of a pixel of the picture, counted from its top left. Throws Error (usage).
    Ray ray_of(const View& view, int column, int row) const {
        const PixelRectangle part = view.part.value_or(PixelRectangle{});
        return grid_of(view).ray(part.left + column, part.top + row);
    }

    /// The hit at a pixel, counted from the top left: to the last bit that of a picture in double precision. On the
    /// calling thread, as the next five functions. Throws Error: usage, out_of_memory.
    Pick pick(const View& view, int column, int row) const;

    // The next five functions do what a Renderer's do, on the calling thread alone: for single rays and short lists.
    // The bits are those of a Renderer in double precision, with the settings of the Model. The native device's kernels
    // trace, or the reference if there are none. They throw Error: usage, out_of_memory.

    void partitions(const Rays& rays, Partitions& answer, Fields fields = {}, const RayRanges& ranges = {}) const;
    void cast_rays(const Rays& rays, Hits& answer, Fields fields = {}, const RayRanges& ranges = {}) const;
    void occluded(const Rays& rays, Array<std::uint8_t>& answer, const RayRanges& ranges = {}) const;
    void region_at(std::span<const Vec3> points, Array<std::int32_t>& answer) const;
    void slice(const Slice& slice, Array<std::int32_t>& answer) const;

private:
    friend class Renderer;
    friend class Edit;
    struct Impl;
    explicit Model(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
    std::shared_ptr<const Impl> impl_;
};

}  // namespace csgrt
