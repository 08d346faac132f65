// Measure: volumes, masses, areas, centroids and moments of a model's parts, each with a 95 % interval.
//
//     csgrt::Measurer measurer(csgrt::Model(scene));
//     csgrt::Measurement result = measurer.measure({.rel_error = 1e-3});
//     for (const csgrt::Measured& m : result.parts)
//         std::printf("%s %g +- %g mm^3\n", m.name.c_str(), m.volume.value, m.volume.half_width);
//
// Rays are traced in replicates. A replicate has a frame of three perpendicular directions, turned at random, and along
// each direction a square grid of rays, shifted at random. The lengths of a ray inside a region sum to its volume, and
// |n . d| at its boundaries, summed over the three directions d, to its area. Each replicate alone is an estimate
// without bias, so the spread of the replicates tells the error of their mean. Random numbers are functions of the seed
// and sums have a fixed order: all devices and numbers of threads give the same bits.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <csgrt/model.hpp>
#include <csgrt/renderer.hpp>
#include <csgrt/settings.hpp>

namespace csgrt {

/// Reads a table of densities as gqa and rtweight of BRL-CAD do: on each line the number of a material, a density in
/// g/cm^3 and a name; # begins a comment. In place of the number may stand the path of a region, or its beginning. Of a
/// scene file it returns Scene::densities. Wrong lines are left out and appended to `warnings`, or, if this is null,
/// throw Error (scene). Throws Error (file). Any thread.
CSGRT_API std::vector<Density> load_densities(const std::string& path, std::vector<Warning>* warnings = nullptr);

/// The errors that a measure shall reach, and its limits.
struct MeasureRequest {
    /// Half of the interval of a volume, relative to the volume, that each region shall reach.
    double rel_error = 0.01;
    /// Half of the interval of a volume, in mm^3, that is enough for each region in any case. 0: a billionth of the
    /// relative error of the model's volume.
    double abs_error = 0;
    /// Seconds after which no more rays are traced; the first rays, some 50,000, always are. 0: no limit.
    double time = 0;
    /// Rays through the whole model to trace, in place of errors to reach. 0: the errors count.
    std::uint64_t rays = 0;
    /// Seed of the random numbers.
    std::uint64_t seed = 1;
    std::vector<Density> densities = {};  ///< Densities of the regions; if empty, there are no masses.
    bool walls = false;                   ///< The smallest wall of each region is searched.
    double wall_limit = 0;                ///< Millimetres: regions with a thinner wall are counted. 0: none is.
    /// Cells along x, y and z of a grid over the box of what is measured, in each of which volumes are measured, too.
    /// 0: no grid.
    std::array<std::uint32_t, 3> grid = {};

    static constexpr std::uint64_t most_rays = 1'000'000'000'000;
    static constexpr std::uint64_t most_cells = 1u << 24;         ///< of a grid
    static constexpr std::uint64_t most_cell_volumes = 1u << 25;  ///< of all regions in a grid's cells
};

/// A number, and half the width of its 95 % interval.
struct Estimate {
    double value = 0, half_width = 0;
};

/// The smallest wall that was found: from a face, along its inward normal, to a face that looks away within 30 degrees.
struct Wall {
    double thickness = 0;     ///< millimetres; 0: there is no wall
    Vec3 from = {}, to = {};  ///< its ends
    /// Whether its faces are not parallel there. Then the thickness depends on the angle of 30 degrees.
    bool is_tapered = false;
    static constexpr int first_exponent = -16;
    /// The shares of the boundary whose walls are of 2^(first_exponent + i) mm to twice as much, as rays near the
    /// normals saw them.
    std::array<double, 32> shares = {};
};

enum class MeasuredKind : std::uint8_t { all, assembly, material, region };

/// The figures of one region, or of several together. Regions own what they overlap with others as in Partitions; a
/// face between two regions counts for each. If the request has densities, centroid and moments are those of mass, and
/// a region without a density counts as weightless; else they are those of volume.
struct Measured {
    MeasuredKind kind = MeasuredKind::region;
    std::string name = {};  ///< the path of a region or an assembly; the name of a material
    std::int32_t id = -1;   ///< of a region its index in Model::regions(), of a material BRL-CAD's number; else -1
    Estimate volume = {};   ///< mm³, of what the regions own
    Estimate claimed = {};  ///< mm³, of what the regions claim: an overlap counts for each claimant
    Estimate area = {};     ///< mm²
    Estimate mass = {};     ///< kg; 0 without densities
    std::array<Estimate, 3> centroid = {};  ///< x, y, z, mm
    std::array<Estimate, 6> origin = {};    ///< moments xx, yy, zz and products xy, yz, zx of inertia about the
                                            ///< world's origin: the integrals of y² + z², ..., and of x y, ...;
                                            ///< kg mm², without densities mm⁵
    std::array<Estimate, 6> central = {};   ///< the same about the centroid
    Box box = {};                           ///< Millimetres; holds the regions, and need not be tight.
    std::uint64_t regions = 0;              ///< number of regions
    std::uint64_t reached = 0;              ///< number of regions that have reached the request's error
    std::uint64_t unmet = 0;                ///< number of regions that no ray has met
    std::uint64_t weightless = 0;           ///< number of regions without a density
    std::uint64_t thin = 0;                 ///< number of regions with a wall below the request's limit
    Wall wall = {};                         ///< the smallest wall, if the request asks for walls
    double unmet_bound = 0;                 ///< mm³: what the unmet regions may have at most (95 %)
};

/// The volumes of several regions, or materials, in the cells of a grid: those that are not 0. The lists have the order
/// of `ids`, then of z, y and x.
struct CellVolumes {
    std::vector<std::array<std::int32_t, 3>> cells = {};  ///< numbers of the cells along x, y and z, from 0
    std::vector<std::int32_t> ids = {};  ///< of a region its index in Model::regions(), of a material BRL-CAD's number
    std::vector<double> volumes = {};    ///< mm³, of what the regions own
    std::vector<double> half_widths = {};  ///< mm³: of their 95 % intervals
};

/// The volumes in the cells of a grid, all of one size. Those of a region sum to its Measured::volume.
struct MeasuredGrid {
    std::array<std::uint32_t, 3> sides = {};  ///< numbers of cells along x, y and z; 0: there is no grid
    Box box = {};                             ///< of the model, millimetres
    CellVolumes regions = {}, materials = {};
};

/// The figures that a measure has found.
struct Measurement {
    std::vector<Measured> parts = {};  ///< all together, assemblies, materials, regions, in the model's order
    MeasuredGrid grid = {};
    bool has_densities = false;
    bool reached = false;    ///< whether each region has reached the request's error, or all rays were traced
    std::uint64_t rays = 0;  ///< traced in all
    double seconds = 0;      ///< time that the call took
};

/// Measures a model. Not copyable. One thread at a time.
class CSGRT_API Measurer {
public:
    /// Throws as Renderer does, and Error (usage) for a model with a region that has no end.
    explicit Measurer(Model model, const Settings& settings = {});
    /// Measures the model of a Renderer, with its rays. The Renderer must outlive the Measurer, and keep its model.
    /// `threads`: see Settings. Throws Error (usage) for a model with a region that has no end.
    explicit Measurer(Renderer& renderer, unsigned threads = 0);
    ~Measurer();
    Measurer(Measurer&&) noexcept;
    Measurer& operator=(Measurer&&) noexcept;

    /// Measures until the request is met. Calls look(measurement so far) after each round of rays, whose `parts` has
    /// only all together; if it returns false, or Settings::progress ends a call, the measure ends with what it has.
    /// Throws Error: usage, out_of_memory, device_fault; interrupted, if it ends before the first rays are traced.
    Measurement measure(const MeasureRequest& request = {}, const std::function<bool(const Measurement&)>& look = {});

    /// The Renderer that traces, for its model, statistics and warnings. Valid as long as the Measurer.
    const Renderer& renderer() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace csgrt
