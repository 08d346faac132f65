// Checks in steps: pairs of regions whose boxes overlap; rays through the whole model; cells in the common boxes of the
// pairs that these rays have not found; then depth and volume of what was found.
#include <csgrt/check.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <functional>
#include <iterator>
#include <numeric>
#include <span>
#include <unordered_map>

#include <fnmatch.h>

#include "analysis/estimates.hpp"
#include "analysis/frame.hpp"
#include "analysis/inscribed_ball.hpp"
#include "base/floating_point.hpp"
#include "base/parallel.hpp"

namespace csgrt {

using namespace analysis;

namespace {

constexpr std::size_t rays_at_once = 1u << 18;
constexpr std::size_t part = 1024;        ///< rays that one thread reads in a row
constexpr double rays_of_model = 20'000;  ///< of a grid through the whole model
constexpr std::uint64_t views = 3;        ///< turned frames of rays through the whole model

// Cells have side x side rays along each axis, and are larger than their share of the box. After the levels at which
// all cells are divided, a level has few cells of each pair; of those in which the two touch, fewer.
constexpr std::uint32_t side = 5, cell_rays = 3 * side * side;
constexpr double enlarged = 1.4;
constexpr std::uint32_t levels = 7, levels_of_all = 1;
constexpr double cells_a_level = 192, touching_cells_a_level = 8;

constexpr double rays_of_overlap = 24, more_rays_of_overlap = 192;  ///< of a grid through a pair's common box

// Climbs to the deepest point of an overlap: starting points that are compared, those that are climbed from, rounds,
// and last rounds that only look around at the deepest point.
constexpr std::size_t starts = 8, climbs_of_pair = 2, most_normals = 6;
constexpr std::uint64_t rounds = 6, last_rounds = 2;

constexpr double nowhere = std::numeric_limits<double>::infinity();
constexpr auto between_looks = std::chrono::milliseconds(200);

using Clock = std::chrono::steady_clock;

/// Part of a ray that both regions of a pair claim.
struct SharedPart {
    std::size_t pair = 0;
    double in = 0, out = 0;
};

/// A part, and its ray, whose direction is a unit vector.
struct RayPart {
    Ray ray = {};
    double in = 0, out = 0;

    double length() const { return out - in; }
    Vec3 middle() const { return ray.origin + 0.5 * (in + out) * ray.direction; }
};

struct Pair {
    std::uint32_t first = 0, second = 0;
    Box box = {};  ///< of both regions' boxes
    bool is_found = false;
    Box seen = {{1, 1, 1}, {-1, -1, -1}};
    RayPart chord = {};        ///< the longest one; after a climb, the longest one through the ball's centre
    double at_most = nowhere;  ///< mm: the diameter of a ball in the overlap
    std::array<double, least_batches> volumes = {};
    Ball ball = {};
    std::vector<RayPart> chords = {};  ///< the longest one of each grid
};

/// A climb from one point of an overlap to a point that is as far as possible from the boundary.
struct Climb {
    std::size_t pair = 0;
    std::uint64_t number = 0;  ///< among the pair's climbs
    Vec3 point = {};
    Ball ball = {};                  ///< the largest one so far
    RayPart chord = {};              ///< the longest one through its centre
    std::vector<Vec3> normals = {};  ///< of the planes that are nearest to the point
};

/// A line through a point of an overlap: the part around the point that the pair shares.
struct Line {
    RayPart chord = {};
    std::vector<Vec3> ends[2] = {};  ///< of this part, and of the lines beside it, if they are in the overlap, too
};

struct Cell {
    std::size_t pair = 0;
    std::uint32_t number = 0;  ///< among the pair's cells
    Box box = {};
    double gap = nowhere;  ///< mm along a ray between the two regions; infinite: no ray met both
    bool is_met_by_first = false, is_met_by_second = false;
};

bool has_inside(const Box& box) { return box.low.x < box.high.x && box.low.y < box.high.y && box.low.z < box.high.z; }
double least_side(const Box& box) {
    const Vec3 size = box.high - box.low;
    return std::min({size.x, size.y, size.z});
}
bool is_finite(const Box& box) { return std::isfinite(length(box.high - box.low)); }
Box common(const Box& a, const Box& b) {
    Box c;
    for (double Vec3::*const axis : axes) {
        c.low.*axis = std::max(a.low.*axis, b.low.*axis);
        c.high.*axis = std::min(a.high.*axis, b.high.*axis);
    }
    return c;
}
void include(Box& box, const Vec3& point) {
    const bool is_empty = box.low.x > box.high.x;
    for (double Vec3::*const axis : axes) {
        box.low.*axis = is_empty ? point.*axis : std::min(box.low.*axis, point.*axis);
        box.high.*axis = is_empty ? point.*axis : std::max(box.high.*axis, point.*axis);
    }
}

void include(Box& box, const Box& other) {
    include(box, other.low);
    include(box, other.high);
}

/// The range of a ray within a box that holds its origin, and a little more.
RayRange within(const Box& box, const Vec3& origin, const Vec3& d) {
    RayRange range = {-nowhere, nowhere};
    const Vec3 size = box.high - box.low;
    const double margin = 1e-3 * length(size);
    for (double Vec3::*const axis : axes) {
        if (d.*axis == 0) continue;
        const double a = (box.low.*axis - origin.*axis) / d.*axis, b = (box.high.*axis - origin.*axis) / d.*axis;
        range.t_near = std::max(range.t_near, std::min(a, b));
        range.t_far = std::min(range.t_far, std::max(a, b));
    }
    return {std::min(range.t_near, 0.0) - margin, std::max(range.t_far, 0.0) + margin};
}

/// Cuts a cell at the middle of each axis along which it is more than half as long as along its longest axis.
void divide(const Cell& cell, std::vector<Cell>& children) {
    const Vec3 size = cell.box.high - cell.box.low, middle = center_of(cell.box);
    const double longest = std::max({size.x, size.y, size.z});
    std::vector<Box> boxes = {cell.box};
    for (double Vec3::*const axis : axes) {
        if (size.*axis <= 0.5 * longest) continue;
        const std::size_t count = boxes.size();
        for (std::size_t i = 0; i < count; ++i) {
            Box upper = boxes[i];
            boxes[i].high.*axis = upper.low.*axis = middle.*axis;
            boxes.push_back(upper);
        }
    }
    for (const Box& box : boxes) children.push_back({.pair = cell.pair, .box = box, .gap = cell.gap});
}

/// The planes that touch the boundary where lines meet it, each through the ends of three lines that are side by side.
std::vector<TangentPlane> planes_of(const std::vector<Line>& lines, const Vec3& point) {
    std::vector<TangentPlane> planes;
    for (const Line& line : lines) {
        for (const std::vector<Vec3>& end : line.ends) {
            if (end.size() < 3) continue;
            const Vec3 n = cross(end[1] - end[0], end[2] - end[0]);
            if (length(n) > 0) planes.push_back({end[0], (dot(n, end[0] - point) < 0 ? -1 : 1) / length(n) * n});
        }
    }
    std::ranges::stable_sort(planes, {}, [&](const TangentPlane& p) { return p.distance(point); });
    return planes;
}

/// The planes that the point is in front of: the nearest point of the plane is near the point where it touches. Others
/// tell nothing of the boundary near by, if this is concave.
std::vector<TangentPlane> faced(std::vector<TangentPlane> planes, const Vec3& point) {
    std::erase_if(planes, [&](const TangentPlane& p) { return p.distance(point) < 0.5 * length(p.point - point); });
    return planes;
}

/// The radius of a ball around the point that meets none of the planes, nor the ends of the lines.
double radius_of(const std::vector<TangentPlane>& planes, const std::vector<Line>& lines, const Vec3& point) {
    double radius = nearest(planes, point);
    for (const Line& line : lines) radius = std::min({radius, -line.chord.in, line.chord.out});
    return radius;
}

/// Keeps the normals of the nearest planes as directions of the climb's next lines.
void keep_normals(Climb& climb, const std::vector<TangentPlane>& planes) {
    climb.normals.clear();
    for (std::size_t k = 0; k < std::min(most_normals, planes.size()); ++k) climb.normals.push_back(planes[k].normal);
}

}  // namespace

struct Checker::Impl {
    Impl(Model m, const Settings& settings) : renderer(m, settings), model(std::move(m)), threads(settings.threads) {}

    Renderer renderer;
    Model model;
    unsigned threads;

    CheckRequest request;
    std::vector<Pair> pairs;                                 ///< candidates
    std::unordered_map<std::uint64_t, std::size_t> numbers;  ///< of the candidates, by their regions
    std::vector<std::uint32_t> unbounded;                    ///< regions
    std::function<bool(const CheckResult&)> look;
    std::uint64_t traced = 0;
    Clock::time_point began, looked;

    // Rays that are traced at once, and their answer.
    std::vector<Ray> rays;
    std::vector<RayRange> ranges;
    Partitions rows;

    void find_candidates();
    void add_ray(const Vec3& origin, const Vec3& direction, const RayRange& range) {
        rays.push_back({origin, direction});
        ranges.push_back(range);
    }
    void add_rays(const Grid& grid) {
        for (std::uint64_t i = 0; i < grid.size(); ++i)
            if (const Ray ray = grid.ray(i); grid.meets(ray)) add_ray(ray.origin, ray.direction, {0, grid.length});
    }
    void drop_rays() {
        rays.clear();
        ranges.clear();
    }
    void trace();
    void shared_parts(std::size_t ray, std::vector<SharedPart>& parts) const;
    void take_sights();
    void shoot_model();
    void look_at(Cell& cell, std::size_t first_ray) const;
    /// Whether a part was found that is as long as a ball of the least depth would show.
    bool is_done(const Pair& pair) const { return pair.is_found && pair.chord.length() >= request.min_depth; }
    void search_cells();
    void measure(std::span<const std::size_t> which, double rays_of_grid);
    std::vector<Climb> starts_of(std::size_t number) const;
    void shoot_lines(std::vector<Climb>& climbs, std::uint64_t round, bool beside,
                     const std::function<void(Climb&, std::vector<Line>&)>& take);
    void climb(std::span<const std::size_t> which);
    bool allows(const AllowedOverlap& row, const Pair& pair) const;
    CheckResult result(bool is_complete) const;
};

/// Sweeps over the boxes in the order in which they begin along x.
void Checker::Impl::find_candidates() {
    pairs.clear();
    numbers.clear();
    unbounded.clear();
    std::vector<Box> boxes;
    Box all = {{1, 1, 1}, {-1, -1, -1}};
    for (const RegionInfo& region : model.regions()) {
        boxes.push_back(region.bounds);
        if (!has_inside(region.bounds) || !is_finite(region.bounds)) continue;
        include(all, region.bounds);
    }
    std::vector<std::uint32_t> order(boxes.size()), open;
    std::iota(order.begin(), order.end(), 0);
    for (const std::uint32_t r : order) {
        if (is_finite(boxes[r])) continue;
        unbounded.push_back(r);
        boxes[r] = common(boxes[r], all);
    }
    std::ranges::stable_sort(order, {}, [&](std::uint32_t r) { return boxes[r].low.x; });
    for (const std::uint32_t r : order) {
        const Box& box = boxes[r];
        if (!has_inside(box)) continue;
        std::erase_if(open, [&](std::uint32_t other) { return boxes[other].high.x <= box.low.x; });
        for (const std::uint32_t other : open)
            if (const Box both = common(box, boxes[other]);
                least_side(both) >= 0.5 * request.min_depth && has_inside(both))
                pairs.push_back({.first = std::min(r, other), .second = std::max(r, other), .box = both});
        open.push_back(r);
    }
    std::ranges::sort(pairs, {}, [](const Pair& p) { return std::pair(p.first, p.second); });
    for (std::size_t i = 0; i < pairs.size(); ++i) numbers[std::uint64_t{pairs[i].first} << 32 | pairs[i].second] = i;
}

void Checker::Impl::trace() {
    renderer.partitions(rays, rows, {.overlaps = true}, {.each = ranges});
    traced += rays.size();
    if (!look || Clock::now() - looked < between_looks) return;
    looked = Clock::now();
    if (!look(result(false))) throw Error(Status::interrupted, "interrupted");
}

/// The parts of a ray that two regions share. A part may be several overlaps, if a third region begins or ends in it.
void Checker::Impl::shared_parts(std::size_t ray, std::vector<SharedPart>& parts) const {
    parts.clear();
    for (auto k = static_cast<std::size_t>(rows.overlap_splits[ray]);
         k < static_cast<std::size_t>(rows.overlap_splits[ray + 1]); ++k) {
        const double in = rows.overlap_t_in[k], out = rows.overlap_t_out[k];
        const auto first = static_cast<std::size_t>(rows.overlap_region_splits[k]),
                   end = static_cast<std::size_t>(rows.overlap_region_splits[k + 1]);
        for (std::size_t a = first; a < end; ++a) {
            for (std::size_t b = a + 1; b < end; ++b) {
                const auto at = numbers.find(static_cast<std::uint64_t>(rows.overlap_region_ids[a]) << 32 |
                                             static_cast<std::uint64_t>(rows.overlap_region_ids[b]));
                if (at == numbers.end()) continue;
                const auto before = std::ranges::find_if(
                    parts, [&](const SharedPart& p) { return p.pair == at->second && p.out == in; });
                if (before == parts.end())
                    parts.push_back({at->second, in, out});
                else
                    before->out = out;
            }
        }
    }
}

/// Takes from the traced rays what they show of any pair.
void Checker::Impl::take_sights() {
    struct Sight {
        std::size_t ray;
        SharedPart part;
    };
    std::vector<std::vector<Sight>> all((rays.size() + part - 1) / part);
    for_chunks(rays.size(), part, threads, [&](std::size_t first, std::size_t end, std::size_t chunk) {
        std::vector<SharedPart> parts;
        for (std::size_t ray = first; ray < end; ++ray) {
            shared_parts(ray, parts);
            for (const SharedPart& shared : parts) all[chunk].push_back({ray, shared});
        }
    });
    for (const auto& sights : all) {
        for (const auto& [ray, shared] : sights) {
            Pair& pair = pairs[shared.pair];
            const auto& [origin, d] = rays[ray];
            include(pair.seen, origin + shared.in * d);
            include(pair.seen, origin + shared.out * d);
            if (pair.is_found && shared.out - shared.in <= pair.chord.length()) continue;
            pair.is_found = true;
            pair.chord = {rays[ray], shared.in, shared.out};
        }
    }
}

void Checker::Impl::shoot_model() {
    Box box = {{1, 1, 1}, {-1, -1, -1}};
    for (const Pair& pair : pairs) {
        include(box, pair.box);
    }
    if (pairs.empty()) return;
    for (std::uint64_t view = 0; view < views; ++view) {
        Random random{request.seed, 0, view};
        drop_rays();
        for (const Grid& grid : grids_of(box, rays_of_model, random)) add_rays(grid);
        trace();
        take_sights();
    }
}

/// Looks at the rays of a cell: which regions they meet, and how near to each other.
void Checker::Impl::look_at(Cell& cell, std::size_t first_ray) const {
    const Pair& pair = pairs[cell.pair];
    const auto first = static_cast<std::int32_t>(pair.first), second = static_cast<std::int32_t>(pair.second);
    struct Interval {
        double in, out;
    };
    std::vector<Interval> of_first, of_second;
    cell.gap = nowhere;
    for (std::size_t ray = first_ray; ray < first_ray + cell_rays; ++ray) {
        of_first.clear();
        of_second.clear();
        const auto add = [&](std::int32_t region, double in, double out) {
            if (region == first) of_first.push_back({in, out});
            if (region == second) of_second.push_back({in, out});
        };
        for (auto row = static_cast<std::size_t>(rows.ray_splits[ray]);
             row < static_cast<std::size_t>(rows.ray_splits[ray + 1]); ++row)
            add(rows.region_ids[row], rows.t_in[row], rows.t_out[row]);
        for (auto k = static_cast<std::size_t>(rows.overlap_splits[ray]);
             k < static_cast<std::size_t>(rows.overlap_splits[ray + 1]); ++k)
            for (auto c = rows.overlap_region_splits[k] + 1; c < rows.overlap_region_splits[k + 1]; ++c)
                add(rows.overlap_region_ids[static_cast<std::size_t>(c)], rows.overlap_t_in[k], rows.overlap_t_out[k]);
        cell.is_met_by_first |= !of_first.empty();
        cell.is_met_by_second |= !of_second.empty();
        for (const Interval& a : of_first)
            for (const Interval& b : of_second) cell.gap = std::min(cell.gap, std::max(b.in - a.out, a.in - b.out));
    }
}

/// Searches the pairs that are not found, level by level. A level's cells are those of all pairs, so whether a pair is
/// found does not hang on the number of cells that are traced at once.
void Checker::Impl::search_cells() {
    std::vector<Cell> cells, children;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (!is_done(pairs[i])) cells.push_back({.pair = i, .box = pairs[i].box});
    const double most = std::max(1.0, cells_a_level * request.effort),
                 most_touching = std::max(1.0, touching_cells_a_level * request.effort);
    const auto touches = [&](const Cell& cell) {
        return std::abs(cell.gap) <= 1e-6 * length(cell.box.high - cell.box.low);
    };
    for (std::uint32_t level = 0; level < levels && !cells.empty(); ++level) {
        constexpr std::size_t cells_at_once = rays_at_once / cell_rays;
        for (std::size_t begin = 0; begin < cells.size(); begin += cells_at_once) {
            const std::size_t end = std::min(cells.size(), begin + cells_at_once);
            rays.resize((end - begin) * cell_rays);
            ranges.resize(rays.size());
            for_chunks(end - begin, 16, threads, [&](std::size_t i, std::size_t last, std::size_t) {
                for (; i < last; ++i) {
                    const Cell& cell = cells[begin + i];
                    Random random{request.seed, 1, pairs[cell.pair].first, pairs[cell.pair].second, level, cell.number};
                    const Vec3 middle = center_of(cell.box), half = enlarged / 2 * (cell.box.high - cell.box.low);
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        double Vec3::*const d = axes[axis], Vec3::*const u = axes[(axis + 1) % 3],
                                            Vec3::*const v = axes[(axis + 2) % 3];
                        const double shift_u = random.next(), shift_v = random.next();
                        for (std::uint32_t k = 0; k < side * side; ++k) {
                            Ray ray{middle - half, {}};
                            ray.direction.*d = 1;
                            ray.origin.*u += 2 * half.*u * (k % side + shift_u) / side;
                            ray.origin.*v += 2 * half.*v * (k / side + shift_v) / side;
                            const std::size_t at = i * cell_rays + axis * side * side + k;
                            rays[at] = ray;
                            ranges[at] = {0, 2 * half.*d};
                        }
                    }
                }
            });
            trace();
            take_sights();
            for_chunks(end - begin, 16, threads, [&](std::size_t i, std::size_t last, std::size_t) {
                for (; i < last; ++i) look_at(cells[begin + i], i * cell_rays);
            });
        }
        children.clear();
        for (std::size_t first = 0, end = 0; first < cells.size(); first = end) {
            const std::size_t pair = cells[first].pair;
            while (end < cells.size() && cells[end].pair == pair) ++end;
            if (is_done(pairs[pair])) continue;
            std::vector<const Cell*> kept;
            for (std::size_t i = first; i < end; ++i)
                if (level < levels_of_all || (cells[i].is_met_by_first && cells[i].is_met_by_second))
                    kept.push_back(&cells[i]);
            // Cells in which the two touch are searched last, and fewer of them: most models are full of contact.
            std::ranges::stable_sort(kept, {}, [&](const Cell* cell) { return std::pair(touches(*cell), cell->gap); });
            const std::size_t begin = children.size();
            for (const Cell* cell : kept) {
                if (level >= levels_of_all &&
                    static_cast<double>(children.size() - begin) >= (touches(*cell) ? most_touching : most))
                    break;
                divide(*cell, children);
            }
            for (std::size_t i = begin; i < children.size(); ++i)
                children[i].number = static_cast<std::uint32_t>(i - begin);
        }
        std::swap(cells, children);
    }
}

/// Measures the pairs that are found: volumes, the longest parts, and the largest ball that may be there. A ball of
/// diameter D that lies in an overlap is met by a ray of a complete grid in a part of at least sqrt(D^2 - g^2), where g
/// is the diagonal of the grid's cells, since a ray passes within g / 2 of its centre.
void Checker::Impl::measure(std::span<const std::size_t> which, double rays_of_grid) {
    struct Job {
        std::size_t pair;
        std::uint32_t replicate;
        double by;               ///< mm²: of a ray
        double diagonal;         ///< mm², squared
        std::size_t first, end;  ///< rays
    };
    std::vector<Job> jobs;
    const auto flush = [&] {
        if (rays.empty()) return;
        trace();
        std::vector<double> sums(jobs.size());
        std::vector<RayPart> longest(jobs.size());
        for_chunks(jobs.size(), 8, threads, [&](std::size_t i, std::size_t last, std::size_t) {
            std::vector<SharedPart> parts;
            for (; i < last; ++i)
                for (std::size_t ray = jobs[i].first; ray < jobs[i].end; ++ray) {
                    shared_parts(ray, parts);
                    for (const SharedPart& shared : parts) {
                        if (shared.pair != jobs[i].pair) continue;
                        sums[i] += shared.out - shared.in;
                        if (shared.out - shared.in > longest[i].length())
                            longest[i] = {rays[ray], shared.in, shared.out};
                    }
                }
        });
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            Pair& pair = pairs[jobs[i].pair];
            pair.volumes[jobs[i].replicate] += jobs[i].by * sums[i];
            const double length = longest[i].length();
            if (length > 0) pair.chords.push_back(longest[i]);
            pair.at_most = std::min(pair.at_most, std::sqrt(length * length + jobs[i].diagonal));
        }
        take_sights();
        drop_rays();
        jobs.clear();
    };
    drop_rays();
    for (const std::size_t i : which) {
        pairs[i].at_most = std::min(pairs[i].at_most, least_side(pairs[i].box));
        pairs[i].volumes = {};
        pairs[i].chords.clear();
        for (std::uint32_t replicate = 0; replicate < least_batches; ++replicate) {
            Random random{request.seed,    2,         pairs[i].first,
                          pairs[i].second, replicate, static_cast<std::uint64_t>(rays_of_grid)};
            for (const Grid& grid : grids_of(pairs[i].box, rays_of_grid, random)) {
                const std::size_t first = rays.size();
                add_rays(grid);
                const double diagonal = dot(grid.right, grid.right) + dot(grid.up, grid.up);
                jobs.push_back({i, replicate, grid.cell / 3, diagonal, first, rays.size()});
            }
        }
        if (rays.size() >= rays_at_once) flush();
    }
    flush();
}

/// The points from which a pair's climbs begin: middles of long parts that are not near each other.
std::vector<Climb> Checker::Impl::starts_of(std::size_t number) const {
    std::vector<RayPart> chords = pairs[number].chords;
    chords.insert(chords.begin(), pairs[number].chord);
    std::ranges::stable_sort(chords, std::greater{}, &RayPart::length);
    std::vector<Climb> climbs;
    for (const RayPart& chord : chords) {
        const auto is_near = [&](const Climb& c) { return length(c.point - chord.middle()) < 0.25 * chord.length(); };
        if (climbs.size() == starts) break;
        if (std::ranges::none_of(climbs, is_near))
            climbs.push_back({.pair = number, .number = climbs.size(), .point = chord.middle()});
    }
    return climbs;
}

/// Shoots lines through the points of climbs, along their normals and in the directions of a turned frame, and calls
/// take(climb, lines). `beside`: whether each line has two lines beside it.
void Checker::Impl::shoot_lines(std::vector<Climb>& climbs, std::uint64_t round, bool beside,
                                const std::function<void(Climb&, std::vector<Line>&)>& take) {
    const std::size_t group = beside ? 3 : 1;
    std::vector<std::size_t> firsts;
    for (std::size_t begin = 0, end = 0; begin < climbs.size(); begin = end) {
        drop_rays();
        firsts.assign(1, 0);
        for (; end < climbs.size() && rays.size() < rays_at_once; ++end) {
            const Climb& climb = climbs[end];
            const Pair& pair = pairs[climb.pair];
            Random random{request.seed, 3, pair.first, pair.second, climb.number, round};
            const std::array<Vec3, 3> frame = random_frame(random);
            std::vector<Vec3> directions = climb.normals;
            for (int x = -1; x <= 1; ++x)
                for (int y = -1; y <= 1; ++y)
                    for (int z = -1; z <= 1; ++z)
                        if (9 * x + 3 * y + z > 0)
                            directions.push_back(unit(x * frame[0] + y * frame[1] + z * frame[2]));
            const double step = 1e-4 * std::max(climb.ball.radius, 1e-3 * pair.chord.length());
            for (const Vec3& d : directions) {
                const RayRange range = within(pair.box, climb.point, d);
                add_ray(climb.point, d, range);
                if (!beside) continue;
                const Vec3 u = unit(cross(d, std::abs(d.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
                add_ray(climb.point + step * u, d, range);
                add_ray(climb.point + step * cross(d, u), d, range);
            }
            firsts.push_back(rays.size());
        }
        trace();
        for_chunks(end - begin, 4, threads, [&](std::size_t i, std::size_t last, std::size_t) {
            std::vector<SharedPart> parts;
            std::vector<Line> lines;
            for (; i < last; ++i) {
                lines.clear();
                for (std::size_t ray = firsts[i]; ray < firsts[i + 1]; ray += group) {
                    Line line{.chord = {rays[ray], 0, 0}};
                    for (std::size_t k = 0; k < group; ++k) {
                        shared_parts(ray + k, parts);
                        const auto here = std::ranges::find_if(parts, [&](const SharedPart& p) {
                            return p.pair == climbs[begin + i].pair && p.in <= 0 && p.out >= 0;
                        });
                        if (here == parts.end()) break;
                        const auto& [origin, d] = rays[ray + k];
                        if (k == 0) line.chord = {rays[ray], here->in, here->out};
                        line.ends[0].push_back(origin + here->in * d);
                        line.ends[1].push_back(origin + here->out * d);
                    }
                    lines.push_back(line);
                }
                take(climbs[begin + i], lines);
            }
        });
    }
}

/// Finds the deepest point of each overlap. Lines give planes that touch the boundary, and the next point of a climb is
/// as far as possible from all of them.
void Checker::Impl::climb(std::span<const std::size_t> which) {
    std::vector<Climb> all, climbs;
    for (const std::size_t i : which) std::ranges::move(starts_of(i), std::back_inserter(all));
    shoot_lines(all, 0, false, [](Climb& climb, std::vector<Line>& lines) {
        climb.ball = {climb.point, radius_of({}, lines, climb.point)};
    });
    for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
        while (end < all.size() && all[end].pair == all[first].pair) ++end;
        const auto of_pair = std::span(all).subspan(first, end - first);
        std::ranges::stable_sort(of_pair, std::greater{}, [](const Climb& c) { return c.ball.radius; });
        for (const Climb& climb : of_pair.first(std::min(climbs_of_pair, of_pair.size()))) {
            climbs.push_back(climb);
            climbs.back().ball.radius = 0;
        }
    }
    for (std::uint64_t round = 1; round <= rounds; ++round) {
        shoot_lines(climbs, round, true, [round](Climb& climb, std::vector<Line>& lines) {
            double reach = nowhere;
            for (const Line& line : lines)
                reach = std::min(reach, line.ends[0].empty() ? 0 : std::max(-line.chord.in, line.chord.out));
            if (reach == 0) {  // outside: back towards the last point that was inside
                climb.point = 0.5 * (climb.point + climb.ball.center);
                return;
            }
            const std::vector<TangentPlane> planes = planes_of(lines, climb.point);
            if (planes.empty()) return;
            const std::vector<TangentPlane> near = faced(planes, climb.point);
            if (const double radius = radius_of(near, lines, climb.point); radius > climb.ball.radius) {
                climb.ball = {climb.point, radius};
                climb.chord =
                    std::ranges::max_element(lines, {}, [](const Line& l) { return l.chord.length(); })->chord;
            }
            keep_normals(climb, planes);
            // All planes lead to the middle of a convex overlap, those near by along a curved one.
            climb.point = between(round % 2 == 1 || near.size() < 4 ? planes : near, climb.point, 10 * reach);
        });
    }
    for (Climb& climb : climbs) climb.point = climb.ball.center;
    for (std::uint64_t round = rounds + 1; round <= rounds + last_rounds; ++round) {
        shoot_lines(climbs, round, true, [](Climb& climb, std::vector<Line>& lines) {
            const std::vector<TangentPlane> planes = planes_of(lines, climb.point);
            climb.ball.radius = std::min(climb.ball.radius, radius_of(faced(planes, climb.point), lines, climb.point));
            keep_normals(climb, planes);
        });
    }
    for (const Climb& climb : climbs) {
        Pair& pair = pairs[climb.pair];
        if (!(climb.ball.radius > pair.ball.radius)) continue;
        pair.ball = climb.ball;
        pair.chord = climb.chord;
    }
}

CheckResult Checker::Impl::result(bool is_complete) const {
    CheckResult result{.unbounded = unbounded, .candidates = pairs.size(), .rays = traced, .is_complete = is_complete};
    result.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    std::vector<bool> is_used(request.allowed.size());
    for (const Pair& pair : pairs) {
        if (!pair.is_found) continue;
        const double depth = std::min(2 * pair.ball.radius, pair.at_most);
        const bool is_deep = depth >= 0.5 * request.min_depth;
        if (!is_deep) ++result.shallow;
        if (!is_deep && is_complete) continue;  // else the depth may be unknown yet
        FoundOverlap found{.regions = {pair.first, pair.second},
                           .place = pair.ball.center,
                           .depth = depth,
                           .depth_at_most = pair.at_most,
                           .volume = estimate_of(pair.volumes),
                           .box = pair.seen,
                           .ray = pair.chord.ray,
                           .t_in = pair.chord.in,
                           .t_out = pair.chord.out,
                           .is_near_limit = depth < 2 * request.min_depth};
        if (!is_deep) found.place = pair.chord.middle();
        for (std::size_t i = 0; i < request.allowed.size(); ++i) {
            if (!allows(request.allowed[i], pair)) continue;
            found.is_allowed = true;
            is_used[i] = true;
        }
        result.overlaps.push_back(found);
    }
    for (std::size_t i = 0; i < is_used.size(); ++i)
        if (!is_used[i]) result.unused.push_back(request.allowed[i]);
    std::ranges::stable_sort(result.overlaps, std::greater{}, &FoundOverlap::depth);
    return result;
}

/// Whether a row allows a pair, in either order. A pattern fits a path, or the beginning of a path before a '/'.
bool Checker::Impl::allows(const AllowedOverlap& row, const Pair& pair) const {
    const auto fits = [this](const std::string& pattern, std::uint32_t region) {
        const std::string& path = model.regions()[region].path;
        return fnmatch(pattern.c_str(), path.c_str(), 0) == 0 ||
               fnmatch((pattern + "/*").c_str(), path.c_str(), 0) == 0;
    };
    return (fits(row.first, pair.first) && fits(row.second, pair.second)) ||
           (fits(row.first, pair.second) && fits(row.second, pair.first));
}

Checker::Checker(Model model, const Settings& settings) : impl_(std::make_unique<Impl>(std::move(model), settings)) {}
Checker::~Checker() = default;
Checker::Checker(Checker&&) noexcept = default;
Checker& Checker::operator=(Checker&&) noexcept = default;

const Renderer& Checker::renderer() const { return impl_->renderer; }

CheckResult Checker::check(const CheckRequest& request, const std::function<bool(const CheckResult&)>& look) {
    const FloatingPoint state;
    Impl& m = *impl_;
    const auto refuse = [](const std::string& text) { throw Error(Status::usage, text); };
    if (!(request.min_depth > 0 && std::isfinite(request.min_depth)))
        refuse("the least depth of overlaps must be greater than 0 mm");
    if (!(request.effort > 0 && request.effort <= CheckRequest::most_effort))
        refuse("the effort of a check must be greater than 0 and at most 1000");
    m.request = request;
    m.look = state.of_host(look);
    m.traced = 0;
    m.began = m.looked = Clock::now();
    m.find_candidates();
    try {
        m.shoot_model();
        m.search_cells();
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < m.pairs.size(); ++i)
            if (m.pairs[i].is_found) found.push_back(i);
        m.measure(found, rays_of_overlap);
        m.climb(found);
        std::erase_if(found, [&](std::size_t i) { return m.pairs[i].ball.radius >= request.min_depth; });
        m.measure(found, more_rays_of_overlap);
        m.climb(found);
    } catch (const Error& error) {
        if (error.status() != Status::interrupted) throw;
        return m.result(false);
    }
    return m.result(true);
}

}  // namespace csgrt
