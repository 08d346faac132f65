// csgrt shoot: computes the partitions along given rays, in chunks, so that any number of rays fits into memory.
#include <algorithm>
#include <limits>
#include <optional>

#include <unistd.h>

#include "commands.hpp"
#include "base/along.hpp"
#include "cli/held_renderer.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/text/partitions.hpp"
#include "cli/progress.hpp"
#include "cli/text/rays.hpp"
#include "cli/text/scene.hpp"
#include "cli/text/tables.hpp"
#include "scene/range.hpp"

namespace csgrt::cli {

namespace {

constexpr std::size_t most_rays = 65'536;        ///< in a chunk; enough to keep a device busy
constexpr std::size_t most_text = 64'000'000;    ///< bytes of a chunk's answers, approximately
constexpr std::size_t most_written = 1'000'000;  ///< bytes of a table at once, approximately
constexpr std::uint64_t most_of_grid = 262'144;  ///< rays of a grid at once
constexpr double endless = std::numeric_limits<double>::infinity();

/// The rays of a file, or of a grid.
class RaySource {
public:
    /// Reads and checks a file.
    explicit RaySource(const ShootArguments& arguments) {
        if (!arguments.grid) reader_.emplace(arguments.rays);
    }
    /// Makes the grid over the box, if the arguments ask for a grid.
    void cover(const Box& box, const ShootArguments& arguments) {
        if (!arguments.grid) return;
        if (!(box.low.x <= box.high.x))
            refuse("--rays", "the model has no bounded region for a grid to cover", "list the rays in a file");
        const auto [axis, side] = *arguments.grid;
        grid_ = rays_parallel(box, axis, side, side);
    }
    /// The grid; null for a file.
    const RayGrid* grid() const { return grid_ ? &*grid_ : nullptr; }
    Ray ray_of_grid(std::uint64_t number) const {
        const auto columns = static_cast<std::uint64_t>(grid_->columns);
        return grid_->ray(static_cast<int>(number % columns), static_cast<int>(number / columns));
    }
    std::uint64_t count() const { return grid_ ? grid_->size() : reader_->count(); }
    bool next(std::vector<Ray>& rays, std::size_t limit) {
        if (!grid_) return reader_->next(rays, limit);
        rays.clear();
        for (; rays.size() < limit && next_ < grid_->size(); ++next_) rays.push_back(ray_of_grid(next_));
        return !rays.empty();
    }
    /// Goes back to the first ray.
    void rewind() {
        if (reader_) reader_->rewind();
        next_ = 0;
    }

private:
    std::optional<RayReader> reader_;
    std::optional<RayGrid> grid_;
    std::uint64_t next_ = 0;
};

/// The state of one `csgrt shoot`, which its functions share.
struct Shooting {
    const ShootArguments& arguments;
    RaySource& source;
    Renderer& renderer;
    Progress& progress;
    OutputFile& out;
    RayRange range = {arguments.near.value_or(0), arguments.far.value_or(endless)};
};

void check(const ShootArguments& arguments) {
    const double near = arguments.near.value_or(0), far = arguments.far.value_or(endless);
    if (near > far)
        refuse(arguments.near ? "--near" : "--far",
               "the range is from " + number_text(near) + " to " + number_text(far),
               "--near must not be above --far; without them the range is from 0 to inf");
    const bool is_text = arguments.format == RowFormat::text || arguments.format == RowFormat::csv;
    if (!is_text && arguments.output == "-" && isatty(STDOUT_FILENO) == 1)
        refuse("--output", "a terminal cannot show this format", "redirect standard output, or name a file with -o");
    std::vector<NamedFile> inputs = {{"SCENE", arguments.scene}};
    if (!arguments.grid) inputs.push_back({"--rays", arguments.rays});
    check_outputs({{"--output", arguments.output}}, inputs);
}

std::string header(const ShootArguments& arguments, const Renderer& renderer, std::uint64_t rays) {
    const Model model = renderer.model();
    std::string text = std::string("# csgrt ") + version() + " model " + model_text(arguments) + "\n# rays " +
                       std::to_string(rays) + " solids " + std::to_string(model.solids().size()) + " regions " +
                       std::to_string(model.regions().size()) + " useair " + (arguments.settings.air ? "1" : "0") +
                       " tol.dist ";
    append_shortest(text, renderer.statistics().tolerance);
    const auto number = [](double value) {
        std::string digits;
        append_shortest(digits, value);
        return digits;
    };
    return text + "\n# box " + bounds_text(model, false, number) + "\n";
}

/// Calls shoot(rays, first) for chunks of rays; `first` is the index of the chunk's first ray. shoot() returns the
/// answer's size in bytes, from which the next chunk's size follows.
template <class Shoot>
void for_chunks_of_rays(Shooting& work, const Shoot& shoot) {
    std::vector<Ray> rays;
    std::uint64_t done = 0;
    const auto total = static_cast<double>(work.source.count());
    std::size_t chunk = 1;  // where thousands of regions overlap, one ray's answer has megabytes
    while (work.source.next(rays, chunk)) {
        work.progress.range(static_cast<double>(done) / total, static_cast<double>(done + rays.size()) / total);
        const std::size_t bytes = shoot(rays, done);
        done += rays.size();
        chunk = std::clamp(rays.size() * most_text / (bytes + 1), std::size_t{1}, std::min(8 * chunk, most_rays));
        check_interrupt();
    }
}

void write_text(Shooting& work) {
    work.out.write(header(work.arguments, work.renderer, work.source.count()));
    const PartitionWriter writer(work.renderer.model());
    const bool has_range = work.arguments.near || work.arguments.far;
    Partitions rows;
    std::string text;
    for_chunks_of_rays(work, [&](const std::vector<Ray>& rays, std::uint64_t first) {
        text.clear();
        if (has_range) {
            work.renderer.partitions(rays, rows, {.solids = true, .normals = true, .overlaps = true},
                                     {.all = work.range, .each = {}});
            for (std::size_t i = 0; i < rays.size(); ++i) writer.append(text, first + i, along_ray(rows, i));
        } else {
            for (const RayPartitions& along : work.renderer.shoot(rays)) writer.append(text, first++, along);
        }
        work.out.write(text);
        return text.size();
    });
}

/// Calls take(rows, first, ray_of) with the answers for one chunk of rays after another. ray_of(i) returns the chunk's
/// i-th ray.
template <class Take>
void for_rows(Shooting& work, Fields fields, const Take& take) {
    const RayRanges ranges{.all = work.range, .each = {}};
    if (const RayGrid* const grid = work.source.grid()) {
        const auto take_part = [&](const Partitions& rows, std::uint64_t first) {
            take(rows, first, [&](std::size_t i) { return work.source.ray_of_grid(first + i); });
            return true;
        };
        work.renderer.partitions(*grid, take_part, fields, ranges, most_of_grid);
        return check_interrupt();
    }
    Partitions rows;
    for_chunks_of_rays(work, [&](const std::vector<Ray>& rays, std::uint64_t first) {
        work.renderer.partitions(rays, rows, fields, ranges);
        take(rows, first, [&](std::size_t i) { return rays[i]; });
        constexpr std::size_t bytes_of_row = 100;  // approximately
        return rows.region_ids.size() * bytes_of_row;
    });
}

void write_table(Shooting& work) {
    const RowTable table(work.renderer.model(), work.arguments.format);
    std::uint64_t count = 0, written = 0;
    if (work.arguments.format == RowFormat::npy) {  // the header holds the number of rows, and a pipe cannot be rewound
        work.progress.stage("counting");
        for_rows(work, {},
                 [&](const Partitions& rows, std::uint64_t, const auto&) { count += rows.region_ids.size(); });
        work.source.rewind();
    }
    work.progress.stage("shooting");
    work.out.write(table.header(count));
    std::string bytes;
    for_rows(work, {.solids = true, .normals = true},
             [&](const Partitions& rows, std::uint64_t first, const auto& ray_of) {
                 for (std::size_t i = 0; i + 1 < rows.ray_splits.size(); ++i) {
                     if (rows.ray_splits[i] == rows.ray_splits[i + 1]) continue;
                     table.append(bytes, first + i, ray_of(i), rows, i);
                     if (bytes.size() < most_written) continue;
                     work.out.write(bytes);
                     bytes.clear();
                 }
                 written += rows.region_ids.size();
             });
    work.out.write(bytes);
    if (work.arguments.format == RowFormat::npy && written != count)
        throw Error(Status::device_fault,
                    "the device counted " + std::to_string(count) + " partitions and gave " + std::to_string(written));
}

}  // namespace

Status run(const ShootArguments& arguments) {
    check(arguments);
    Progress progress(arguments.output != "-" || isatty(STDOUT_FILENO) != 1);
    progress.stage("loading");
    prepare_devices(arguments.settings);
    Scene scene = load(arguments.scene, arguments.load);
    progress.stage("reading rays");
    RaySource source(arguments);
    progress.stage("compiling");
    HeldRenderer held(Renderer(scene, arguments.objects, with_progress(arguments.settings, progress)));
    Renderer& renderer = *held;
    report(held.new_warnings(), false);
    source.cover(renderer.model().bounds(), arguments);
    check_interrupt();

    OutputFile out(arguments.output);
    Shooting work{arguments, source, renderer, progress, out};
    progress.stage("shooting");
    if (arguments.format == RowFormat::text)
        write_text(work);
    else
        write_table(work);
    out.commit();
    report(held.new_warnings(), false);
    return Status::ok;
}

}  // namespace csgrt::cli
