// Measures in rounds. The first round's rays go through the whole model. Then regions whose error is too large get rays
// of their own boxes, or all get more rays through the whole model, whichever is fewer rays.
#include <csgrt/measure.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

#include "analysis/boxes.hpp"
#include "analysis/cells.hpp"
#include "analysis/estimates.hpp"
#include "analysis/frame.hpp"
#include "analysis/walls.hpp"
#include "base/floating_point.hpp"
#include "base/parallel.hpp"

namespace csgrt {

using namespace analysis;

namespace {

constexpr double first_rays = 1024;     ///< of a grid through the whole model, in the first round
constexpr double first_own_rays = 200;  ///< of a grid through a region's box, in its first round
constexpr double most_own_rays = 0x1p24;
constexpr std::uint32_t most_replicates = 4096;
constexpr std::uint32_t grids = 3;         ///< of a replicate
constexpr double enough_rows = 64;         ///< fewer intervals may look more alike than they are
constexpr std::size_t piece = 2048;        ///< rays that one thread sums in a row
constexpr std::size_t at_once = 1u << 18;  ///< rays that are traced at once
constexpr std::int32_t everything = -1;

using Clock = std::chrono::steady_clock;

/// Replicates through the box of a region, or of everything.
struct Job {
    std::int32_t region = everything;
    double rays = 0;                                           ///< of a grid
    std::uint32_t level = 0, first = 0, last = least_batches;  ///< numbers of the replicates
    std::vector<Sums> sums = {};       ///< of each replicate; of everything, of each region and replicate
    std::vector<CellSums> cells = {};  ///< of the region; of everything, of each region
    std::size_t cell_volumes = 0;      ///< the elements of all `cells`

    double cost() const { return rays * grids * (last - first); }
};

/// Rays of one grid, which are summed in a row.
struct Piece {
    Job* job = nullptr;
    std::uint32_t replicate = 0;
    std::size_t grid = 0;
    std::uint64_t first = 0, count = 0;
    bool ends_job = false;
    std::vector<std::uint32_t> kept = {};  ///< of these rays, those that meet the box, counted from the first one
};

/// The findings of a piece's rays about a region.
struct Found {
    std::int32_t region = 0;
    Sums sums = {};
    Chords chords = {};
    std::vector<std::pair<std::uint32_t, double>> lengths = {};  ///< in cells

    /// Sorts the lengths, and adds up those of each cell.
    void join_lengths() {
        std::stable_sort(lengths.begin(), lengths.end(), [](auto& a, auto& b) { return a.first < b.first; });
        std::size_t last = 0;
        for (std::size_t i = 1; i < lengths.size(); ++i) {
            if (lengths[i].first == lengths[last].first)
                lengths[last].second += lengths[i].second;
            else
                lengths[++last] = lengths[i];
        }
        if (!lengths.empty()) lengths.resize(last + 1);
    }
};

struct Region {
    Box box = {};
    Vec3 middle = {};
    double surface = 0;  ///< mm²: of the box; its shadows have a quarter of it, on average
    bool is_empty = false;
    double own_rays = 0;
    std::uint32_t replicates = 0, levels = 0;  ///< of rays of its own
    std::vector<Sums> own = {};                ///< batches
    CellSums cells = {};                       ///< of the same rays
    double weight = 1;
    bool has_density = false;
};

constexpr double kg_per_mm3 = 1e-6;  ///< of 1 g/cm³

void check(const MeasureRequest& request) {
    const auto refuse = [](const std::string& text) { throw Error(Status::usage, text); };
    if (!(request.rel_error > 0)) refuse("the relative error of a measure must be greater than 0");
    if (!(request.abs_error >= 0)) refuse("the absolute error of a measure must be 0 or more");
    if (!(request.time >= 0)) refuse("the time of a measure must be 0 or more");
    if (!(request.wall_limit >= 0)) refuse("the limit of walls must be 0 mm or more");
    const auto [columns, rows, layers] = request.grid;
    std::uint64_t cells = std::uint64_t(columns) * rows;
    if (cells <= MeasureRequest::most_cells) cells *= layers;
    if (cells == 0 && (columns | rows | layers) != 0) refuse("a grid of cells needs 1 or more along x, y and z");
    if (cells > MeasureRequest::most_cells)
        refuse("a grid of cells has 16,777,216 of them at most, as 256,256,256 has");
    if (request.rays > MeasureRequest::most_rays) refuse("a measure traces 1,000,000,000,000 rays at most");
    for (const Density& row : request.densities)
        if (!(row.density >= 0 && std::isfinite(row.density)))
            refuse("the density of " + (row.path.empty() ? "material " + std::to_string(row.material_id) : row.path) +
                   " must be 0 or more, in g/cm^3");
}

double surface_of(const Box& box) {
    const Vec3 side = box.high - box.low;
    return 2 * (side.x * side.y + side.y * side.z + side.z * side.x);
}
/// Whether a box is empty or has no shadow, so that nothing in it has a volume.
bool is_empty(const Box& box) {
    return !(surface_of(box) > 0 && box.low.x <= box.high.x && box.low.y <= box.high.y && box.low.z <= box.high.z);
}

}  // namespace

struct Measurer::Impl {
    Impl(std::unique_ptr<Renderer> kept, Renderer& used, unsigned count)
        : opened(std::move(kept)), renderer(used), model(used.model()), threads(count) {
        for (const RegionInfo& info : model.regions()) {
            Region region{.box = info.bounds, .is_empty = is_empty(info.bounds)};
            if (!region.is_empty) {
                region.middle = center_of(region.box);
                region.surface = surface_of(region.box);
                if (!std::isfinite(region.surface))
                    throw Error(Status::usage, {Diagnostic{{},
                                                           info.path + " has no end, so it has no volume",
                                                           "name the objects to measure, without it",
                                                           {}}});
                include(box, region.box);
            }
            regions.push_back(std::move(region));
        }
    }

    std::unique_ptr<Renderer> opened;
    Renderer& renderer;  ///< `opened`, or the caller's
    Model model;
    unsigned threads;
    Box box = no_box;
    std::vector<Region> regions;

    MeasureRequest request;
    double global_rays = 0;              ///< of a grid
    std::vector<Sums> global;            ///< of each region and replicate
    std::optional<CellGrid> cells;       ///< if the request asks for a grid
    std::vector<CellSums> global_cells;  ///< of each region
    std::vector<Chords> all_chords;      ///< of each region, if walls are searched
    std::vector<Wall> walls;             ///< of each region, at the end
    std::uint32_t global_levels = 0;
    std::uint64_t traced = 0;
    Clock::time_point start, looked;
    bool is_cut = false;
    std::vector<Ray> shots;  ///< rays that are traced at once
    std::vector<RayRange> ranges;
    Partitions rows;

    double seconds() const { return std::chrono::duration<double>(Clock::now() - start).count(); }

    Source source_of(std::size_t r) const {
        const Region& region = regions[r];
        Source source{.rays = global_rays,
                      .replicates = least_batches,
                      .batches = {global.data() + r * least_batches, global.empty() ? 0 : least_batches},
                      .middle = region.middle,
                      .weight = region.weight};
        if (region.replicates > 0) {
            source.rays = region.own_rays;
            source.replicates = region.replicates;
            source.batches = region.own;
        }
        return source;
    }

    double aim(double volume, double floor) const { return std::max(request.rel_error * volume, floor); }
    double floor_of_aims() const {
        if (request.abs_error > 0) return request.abs_error;
        double whole = 0;
        for (std::size_t r = 0; r < regions.size(); ++r) whole += volume_of(source_of(r)).volume.value;
        return 1e-9 * request.rel_error * whole;
    }
    bool has_reached(std::size_t r, const VolumeSoFar& so_far, double floor) const {
        if (regions[r].is_empty) return true;
        if (so_far.rows == 0) return false;
        return so_far.rows >= enough_rows && so_far.volume.half_width <= aim(so_far.volume.value, floor);
    }
    /// The volume that a region that no ray has met may have. If a ray is as likely to meet it as its shadow is large,
    /// three rays would have met it if its shadow were three times what a ray stands for, and none meets it with a
    /// probability of 5 %. No ray is longer inside it than the diagonal of its box.
    double unmet_bound(std::size_t r) const {
        const Region& region = regions[r];
        if (region.is_empty) return 0;
        const Source source = source_of(r);
        const Vec3 side = region.box.high - region.box.low;
        const double all = side.x * side.y * side.z;
        if (source.batches.empty()) return all;
        const double cell = (region.replicates > 0 ? region.surface : surface_of(box)) / 4 / source.rays;
        return std::min(all, 3 * cell / (grids * source.replicates) * length(side));
    }

    /// Finds the densities of regions. Of a region that is not all material, BRL-CAD's attribute los tells how much is.
    void weigh() {
        const std::vector<Density>& densities = request.densities;
        std::vector<const Density*> found(regions.size());  // the last row about each region
        for (const Density& row : densities) {
            if (row.path.empty()) {
                for (std::size_t r = 0; r < regions.size(); ++r)
                    if (row.material_id == model.regions()[r].material_id) found[r] = &row;
                continue;
            }
            const std::vector<std::uint32_t> concerned = model.regions(row.path);
            if (concerned.empty())
                throw Error(Status::usage,
                            "a density has the path '" + row.path + "', which no region has or lies below");
            for (const std::uint32_t r : concerned) found[r] = &row;
        }
        for (std::size_t r = 0; r < regions.size(); ++r) {
            const int los = model.regions()[r].los;
            regions[r].has_density = found[r] && los > 0;
            const double weight = regions[r].has_density ? found[r]->density * kg_per_mm3 * los / 100 : 0;
            regions[r].weight = densities.empty() ? 1 : weight;
        }
    }
    std::string material_name(int id) const {
        std::string name = "material " + std::to_string(id);
        for (const Density& row : request.densities)
            if (row.path.empty() && row.material_id == id && !row.name.empty()) name = row.name;
        return name;
    }

    /// Rounding must not make a wall of the limit's own thickness a thin one.
    bool is_thin(const Wall& wall) const {
        return wall.thickness > 0 && wall.thickness < request.wall_limit * (1 - 1e-9);
    }

    // ---- Rays ----

    void sum_piece(const Piece& p, const Grid& grid, std::size_t first_ray, std::vector<Found>& found) const;
    void flush(std::vector<Piece>& pieces, std::vector<Grid>& all_grids);
    void add(Job& job, std::uint32_t replicate, double cell, const std::vector<Found>& found);
    void commit(Job& job);
    bool trace(std::vector<Job>& jobs, const std::function<bool()>& go_on);
    std::vector<Job> plan();
    Measurement result(bool all_parts) const;
    MeasuredGrid take_grid();
};

/// Sums a piece's rays, region by region in the order in which they are met.
void Measurer::Impl::sum_piece(const Piece& p, const Grid& grid, std::size_t first_ray,
                               std::vector<Found>& found) const {
    const std::int32_t wanted = p.job->region;
    std::vector<std::int32_t> place(wanted == everything ? regions.size() : 0, -1);
    if (wanted != everything) found.push_back({wanted});
    const auto found_of = [&](std::int32_t r) -> Found& {
        if (wanted != everything) return found[0];
        std::int32_t& at = place[static_cast<std::size_t>(r)];
        if (at < 0) {
            at = static_cast<std::int32_t>(found.size());
            found.push_back({r});
        }
        return found[static_cast<std::size_t>(at)];
    };
    const Vec3 d = grid.direction;
    for (std::size_t i = 0; i < p.kept.size(); ++i) {
        const std::size_t ray = first_ray + i;
        const auto begin = static_cast<std::size_t>(rows.ray_splits[ray]),
                   end = static_cast<std::size_t>(rows.ray_splits[ray + 1]);
        if (begin == end) continue;
        const Ray line = grid.ray(p.first + p.kept[i]);
        const Vec3 origin = line.origin;
        for (std::size_t row = begin; row < end; ++row) {
            const std::int32_t r = rows.region_ids[row];
            if (wanted != everything && r != wanted) continue;
            const double in = rows.t_in[row], out = rows.t_out[row];
            const Vec3 n = rows.in_normals[row], m = rows.out_normals[row];
            Found& of = found_of(r);
            Sums& sums = of.sums;
            sums.add(out - in, origin - regions[static_cast<std::size_t>(r)].middle + 0.5 * (in + out) * d, d);
            if (cells)
                cells->cut(line, in, out,
                           [&of](std::uint32_t cell, double part) { of.lengths.emplace_back(cell, part); });
            const double slope = std::abs(dot(n, d)), end_slope = std::abs(dot(m, d));
            sums.area += slope + end_slope;
            if (!request.walls || std::min({slope, end_slope, -dot(n, m)}) < cos_of_walls) continue;
            const double size = (out - in) * std::min(slope, end_slope) / -dot(n, m);
            of.chords.add({size, origin + in * d, origin + out * d, n, m,
                           std::minmax(rows.in_solids[row], rows.out_solids[row])});
            of.chords.add_area(size, slope + end_slope);
        }
        for (auto k = static_cast<std::size_t>(rows.overlap_splits[ray]);
             k < static_cast<std::size_t>(rows.overlap_splits[ray + 1]); ++k) {
            const double overlap = rows.overlap_t_out[k] - rows.overlap_t_in[k];
            // The first claimant is the owner.
            for (auto c = static_cast<std::size_t>(rows.overlap_region_splits[k]) + 1;
                 c < static_cast<std::size_t>(rows.overlap_region_splits[k + 1]); ++c) {
                const std::int32_t r = rows.overlap_region_ids[c];
                if (wanted == everything || r == wanted) found_of(r).sums.others += overlap;
            }
        }
    }
    for (Found& of : found) of.join_lengths();
}

/// Traces the rays of pieces and adds their sums to the jobs, in the order of the pieces.
void Measurer::Impl::flush(std::vector<Piece>& pieces, std::vector<Grid>& all_grids) {
    constexpr std::size_t few = 4;  // pieces
    for_chunks(pieces.size(), few, threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            const Grid& grid = all_grids[pieces[i].grid];
            for (std::uint32_t k = 0; k < pieces[i].count; ++k)
                if (grid.meets(grid.ray(pieces[i].first + k))) pieces[i].kept.push_back(k);
        }
    });
    std::vector<std::size_t> firsts;
    std::size_t count = 0;
    for (const Piece& p : pieces) {
        firsts.push_back(count);
        count += p.kept.size();
    }
    shots.resize(count);
    ranges.resize(count);
    for_chunks(pieces.size(), few, threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            const Grid& grid = all_grids[pieces[i].grid];
            for (std::size_t k = 0; k < pieces[i].kept.size(); ++k) {
                shots[firsts[i] + k] = grid.ray(pieces[i].first + pieces[i].kept[k]);
                ranges[firsts[i] + k] = {0, grid.length};
            }
        }
    });
    renderer.partitions(shots, rows, {.solids = request.walls, .normals = true, .overlaps = true}, {.each = ranges});
    traced += count;
    std::vector<std::vector<Found>> found(pieces.size());
    // The lengths in cells of one piece may take 60 MB.
    const std::size_t few_found = cells ? thread_count(threads) : pieces.size();
    for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
        end = std::min(begin + few_found, pieces.size());
        for_chunks(end - begin, cells ? 1 : few, threads, [&](std::size_t first, std::size_t last, std::size_t) {
            for (std::size_t i = begin + first; i < begin + last; ++i)
                sum_piece(pieces[i], all_grids[pieces[i].grid], firsts[i], found[i]);
        });
        for (std::size_t i = begin; i < end; ++i) {
            add(*pieces[i].job, pieces[i].replicate, all_grids[pieces[i].grid].cell, found[i]);
            found[i].clear();
            if (pieces[i].ends_job) commit(*pieces[i].job);
        }
    }
    pieces.clear();
    all_grids.clear();
}

/// Adds the findings of a piece to its job.
void Measurer::Impl::add(Job& job, std::uint32_t replicate, double cell, const std::vector<Found>& found) {
    for (const auto& [r, sums, chords, lengths] : found) {
        const std::size_t list = job.region == everything ? static_cast<std::size_t>(r) : 0;
        job.sums[list * least_batches + replicate - job.first].add(sums, cell / grids, cell);
        if (request.walls) all_chords[static_cast<std::size_t>(r)].add(chords, cell * job.rays);
        for (const auto& [number, part] : lengths) {
            const auto [of, is_new] = job.cells[list].try_emplace(number);
            of->second[replicate % least_batches] += cell / grids * part;
            job.cell_volumes += is_new;
        }
    }
    if (job.cell_volumes > MeasureRequest::most_cell_volumes)
        throw Error(Status::out_of_memory,
                    "the grid has more than 33,554,432 volumes of regions in its cells: take "
                    "fewer cells, or name objects to measure");
}

/// Takes the sums of a job whose rays all are traced.
void Measurer::Impl::commit(Job& job) {
    const std::vector<Sums> sums = std::move(job.sums);
    if (job.region == everything) {
        global = sums;
        global_cells = std::move(job.cells);
        global_rays = job.rays;
        return;
    }
    Region& region = regions[static_cast<std::size_t>(job.region)];
    double by = 1;
    if (job.first == 0) {
        // The last grids still count, by the variance that errors of rays^-0.75 have.
        const bool goes_in = region.replicates == least_batches;
        const double before = goes_in ? std::pow(region.own_rays, 1.5) : 0;
        by = std::pow(job.rays, 1.5) / (before + std::pow(job.rays, 1.5));
        if (!goes_in) region.own.clear();
        for (Sums& earlier : region.own) earlier = earlier.scaled(1 - by);
        if (!goes_in) region.cells.clear();
        for (auto& [number, earlier] : region.cells)
            for (double& batch : earlier) batch *= 1 - by;
    }
    for (const CellSums& list : job.cells)
        for (const auto& [number, batches] : list)
            for (std::size_t i = 0; i < least_batches; ++i) region.cells[number][i] += by * batches[i];
    job.cells.clear();
    region.own_rays = job.rays;
    region.replicates = job.last;
    region.own.resize(std::min<std::size_t>(most_batches, job.last));
    for (std::uint32_t i = job.first; i < job.last; ++i)
        region.own[i % region.own.size()].add(sums[i - job.first], by, by);
}

/// Traces jobs one after the other. Returns false if it ends before all are done.
bool Measurer::Impl::trace(std::vector<Job>& jobs, const std::function<bool()>& go_on) {
    std::vector<Piece> pieces;
    std::vector<Grid> all_grids;
    std::size_t count = 0;
    for (Job& job : jobs) {
        job.sums.resize(job.region == everything ? regions.size() * least_batches : job.last - job.first);
        if (cells) job.cells.resize(job.region == everything ? regions.size() : 1);
        const Box& of = job.region == everything ? box : regions[static_cast<std::size_t>(job.region)].box;
        for (std::uint32_t replicate = job.first; replicate < job.last; ++replicate) {
            Random random{request.seed, static_cast<std::uint64_t>(job.region + 1), job.level, replicate};
            const std::array<Grid, grids> made = grids_of(of, job.rays, random);
            for (std::size_t g = 0; g < grids; ++g) {
                for (std::uint64_t first = 0; first < made[g].size(); first += piece) {
                    const std::uint64_t rays = std::min<std::uint64_t>(piece, made[g].size() - first);
                    if (pieces.empty() || first == 0) all_grids.push_back(made[g]);
                    const bool is_last = replicate + 1 == job.last && g + 1 == grids && first + rays == made[g].size();
                    pieces.push_back({&job, replicate, all_grids.size() - 1, first, rays, is_last});
                    count += rays;
                    if (count < at_once) continue;
                    flush(pieces, all_grids);
                    count = 0;
                    if (!go_on()) return false;
                }
            }
        }
    }
    if (!pieces.empty()) flush(pieces, all_grids);
    return go_on();
}

/// The jobs of the next round: for each region that has not reached its aim more rays of its own, or more rays through
/// the whole model in place of those of several regions, if these are fewer.
std::vector<Job> Measurer::Impl::plan() {
    struct Need {
        std::size_t region;
        double own, whole;  ///< rays of a grid
        bool goes_on;       ///< more replicates of the same grids are enough
    };
    const double floor = floor_of_aims(), all_surface = surface_of(box);
    std::vector<Need> needs;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        const Region& region = regions[r];
        const VolumeSoFar so_far = volume_of(source_of(r));
        if (region.is_empty || has_reached(r, so_far, floor)) continue;
        const bool has_own = region.replicates > 0;
        if (has_own && so_far.rows == 0) continue;  // none is met: it is listed with a bound
        const double share = region.surface / all_surface;
        const double rays = has_own ? region.own_rays : global_rays * share;
        // Errors shrink as rays^-1 (smooth parts) to rays^-0.5 (thin ones). The first guess is the better one: if it is
        // wrong, little is lost. Twice the replicates have errors of 1 / 1.41.
        const double far = so_far.rows == 0 ? 1 : 1.1 * so_far.volume.half_width / aim(so_far.volume.value, floor);
        const double more = std::clamp(std::pow(far, region.levels < 2 ? 1.0 : 1.25), 1.4, 64.0);
        const bool goes_on = has_own && (far < 1.4 || rays * more > most_own_rays);
        if (goes_on && region.replicates >= most_replicates) continue;
        const double own = goes_on ? rays * region.replicates / least_batches : std::max(first_own_rays, rays * more);
        const bool is_own_alone = goes_on || so_far.rows == 0;
        needs.push_back({r, own, is_own_alone ? HUGE_VAL : std::max(own / share, 2 * global_rays), goes_on});
    }
    std::stable_sort(needs.begin(), needs.end(), [](const Need& a, const Need& b) { return a.whole < b.whole; });
    double own = 0;
    for (const Need& need : needs) own += need.own;
    double least = own, whole = 0;
    std::size_t served = 0;
    for (std::size_t i = 0; i < needs.size(); ++i) {
        own -= needs[i].own;
        if (needs[i].whole + own >= least) continue;
        least = needs[i].whole + own;
        whole = needs[i].whole;
        served = i + 1;
    }
    std::vector<Job> jobs;
    if (served > 0) jobs.push_back({.rays = whole, .level = ++global_levels});
    for (std::size_t i = 0; i < served; ++i) regions[needs[i].region].replicates = 0;
    for (std::size_t i = served; i < needs.size(); ++i) {
        Region& region = regions[needs[i].region];
        Job job{.region = static_cast<std::int32_t>(needs[i].region), .rays = needs[i].own, .level = region.levels};
        if (needs[i].goes_on) {
            job.rays = region.own_rays;
            job.first = region.replicates;
            job.last = 2 * region.replicates;
        } else {
            job.level = ++region.levels;
        }
        jobs.push_back(std::move(job));
    }
    if (!(request.time > 0)) return jobs;

    // The cheapest jobs first, and no more than the time allows.
    std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.cost() < b.cost(); });
    double left = 0.9 * (request.time - seconds()) / seconds() * static_cast<double>(traced);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        left -= jobs[i].cost();
        if (left >= 0) continue;
        const double fits = jobs[i].rays * (left + jobs[i].cost()) / jobs[i].cost();
        const bool helps = jobs[i].first == 0 && i == 0 && fits > global_rays;
        if (helps) jobs[i].rays = fits;
        jobs.resize(helps ? i + 1 : i);
        break;
    }
    return jobs;
}

Measurement Measurer::Impl::result(bool all_parts) const {
    Measurement result{.has_densities = !request.densities.empty(), .rays = traced, .seconds = seconds()};
    const double floor = floor_of_aims();
    std::vector<Source> sources;
    std::vector<Measured> single;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        const VolumeSoFar so_far = volume_of(source_of(r));
        const bool is_unmet = so_far.rows == 0 && !regions[r].is_empty;
        sources.push_back(source_of(r));
        single.push_back({.id = static_cast<std::int32_t>(r),
                          .box = regions[r].box,
                          .regions = 1,
                          .reached = has_reached(r, so_far, floor),
                          .unmet = is_unmet,
                          .weightless = result.has_densities && !regions[r].has_density,
                          .thin = !walls.empty() && is_thin(walls[r]),
                          .wall = walls.empty() ? Wall{} : walls[r],
                          .unmet_bound = is_unmet ? unmet_bound(r) : 0});
    }
    const auto add = [&](MeasuredKind kind, std::string name, std::int32_t id,
                         const std::vector<std::size_t>& members) {
        Measured m{.kind = kind, .name = std::move(name), .id = id, .box = no_box};
        std::vector<Source> of;
        for (const std::size_t r : members) {
            of.push_back(sources[r]);
            if (!is_empty(single[r].box)) include(m.box, single[r].box);
            m.regions += 1;
            m.reached += single[r].reached;
            m.unmet += single[r].unmet;
            m.weightless += single[r].weightless;
            m.unmet_bound += single[r].unmet_bound;
            m.thin += single[r].thin;
            const double thickness = single[r].wall.thickness;
            if (thickness > 0 && (m.wall.thickness == 0 || thickness < m.wall.thickness)) m.wall = single[r].wall;
        }
        estimate(of, result.has_densities, m);
        result.parts.push_back(std::move(m));
    };
    std::vector<std::size_t> all;
    for (std::size_t r = 0; r < regions.size(); ++r) all.push_back(r);
    add(MeasuredKind::all, "all", -1, all);
    result.reached = request.rays > 0 ? !is_cut : result.parts[0].reached == regions.size();
    if (!all_parts) return result;

    std::vector<std::string> assemblies;  // in the order in which paths name them
    std::unordered_map<std::string, std::vector<std::size_t>> below;
    std::map<std::int32_t, std::vector<std::size_t>> materials;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        const RegionInfo& info = model.regions()[r];
        for (std::size_t at = info.path.find('/', 1); at != info.path.npos; at = info.path.find('/', at + 1)) {
            const std::string path = info.path.substr(0, at);
            std::vector<std::size_t>& members = below[path];
            if (members.empty()) assemblies.push_back(path);
            members.push_back(r);
        }
        materials[info.material_id].push_back(r);
    }
    for (const std::string& path : assemblies) add(MeasuredKind::assembly, path, -1, below[path]);
    for (const auto& [id, members] : materials) add(MeasuredKind::material, material_name(id), id, members);
    for (std::size_t r = 0; r < regions.size(); ++r)
        add(MeasuredKind::region, model.regions()[r].path, static_cast<std::int32_t>(r), {r});
    return result;
}

/// Tells the volumes in cells, and frees what they are sums of.
MeasuredGrid Measurer::Impl::take_grid() {
    if (!cells) return {};
    MeasuredGrid result{.sides = request.grid, .box = box};
    const auto tell = [&](CellVolumes& volumes, std::int32_t id, const CellSums& sums) {
        std::vector<std::uint32_t> numbers;
        for (const auto& [number, batches] : sums) numbers.push_back(number);
        std::sort(numbers.begin(), numbers.end());
        for (const std::uint32_t number : numbers) {
            const Estimate volume = estimate_of(sums.at(number));
            const auto& sides = request.grid;
            volumes.cells.push_back({static_cast<std::int32_t>(number % sides[0]),
                                     static_cast<std::int32_t>(number / sides[0] % sides[1]),
                                     static_cast<std::int32_t>(number / sides[0] / sides[1])});
            volumes.ids.push_back(id);
            volumes.volumes.push_back(volume.value);
            volumes.half_widths.push_back(volume.half_width);
        }
    };
    std::map<std::int32_t, CellSums> materials;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        const bool is_own = regions[r].replicates > 0;
        const double by = is_own ? static_cast<double>(least_batches) / regions[r].replicates : 1;
        CellSums means;
        means.swap(is_own ? regions[r].cells : global_cells[r]);
        for (auto& [number, batches] : means)
            for (double& batch : batches) batch *= by;
        tell(result.regions, static_cast<std::int32_t>(r), means);
        CellSums& material = materials[model.regions()[r].material_id];
        if (material.empty()) {
            material.swap(means);
            continue;
        }
        for (const auto& [number, batches] : means)
            for (std::size_t i = 0; i < least_batches; ++i) material[number][i] += batches[i];
    }
    for (const auto& [id, sums] : materials) tell(result.materials, id, sums);
    return result;
}

Measurer::Measurer(Model model, const Settings& settings) {
    auto own = std::make_unique<Renderer>(std::move(model), settings);
    Renderer& used = *own;
    impl_ = std::make_unique<Impl>(std::move(own), used, settings.threads);
}
Measurer::Measurer(Renderer& renderer, unsigned threads) : impl_(std::make_unique<Impl>(nullptr, renderer, threads)) {}
Measurer::~Measurer() = default;
Measurer::Measurer(Measurer&&) noexcept = default;
Measurer& Measurer::operator=(Measurer&&) noexcept = default;

const Renderer& Measurer::renderer() const { return impl_->renderer; }

Measurement Measurer::measure(const MeasureRequest& request, const std::function<bool(const Measurement&)>& look) {
    const FloatingPoint state;
    Impl& m = *impl_;
    check(request);
    m.request = request;
    m.weigh();
    m.request.walls = request.walls || request.wall_limit > 0;
    m.all_chords.assign(m.request.walls ? m.regions.size() : 0, {});
    m.walls.clear();
    m.global.clear();
    m.global_cells.clear();
    m.cells.reset();
    if (request.grid[0] > 0 && !is_empty(m.box)) m.cells.emplace(m.box, request.grid);
    m.global_levels = 0;
    m.traced = 0;
    m.is_cut = false;
    for (Region& region : m.regions) {
        region.replicates = region.levels = 0;
        region.own.clear();
        region.cells.clear();
    }
    m.start = m.looked = Clock::now();
    const auto go_on = [&] {
        if (m.global.empty()) return true;
        if (request.time > 0 && m.seconds() >= request.time) return false;
        if (!look || Clock::now() - m.looked < between_looks) return true;
        m.looked = Clock::now();
        return look(m.result(false));
    };
    std::vector<Job> jobs(1);
    jobs[0].rays = request.rays > 0 ? static_cast<double>(request.rays) / (grids * least_batches) : first_rays;
    if (is_empty(m.box)) jobs.clear();
    try {
        while (!jobs.empty()) {
            m.is_cut = !m.trace(jobs, go_on);
            if (m.is_cut || request.rays > 0) break;
            jobs = m.plan();
        }
        if (m.request.walls) m.walls = walls_of(m.all_chords, m.renderer);
    } catch (const Error& error) {
        if (error.status() != Status::interrupted || m.global.empty()) throw;
        m.is_cut = true;
    }
    Measurement result = m.result(true);
    result.grid = m.take_grid();
    return result;
}

}  // namespace csgrt
