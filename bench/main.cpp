// csgrt_bench: warm frames of every workload; tables on standard output, JSON on demand.
//
//   csgrt_bench [--device CHOICE|all]... [--size N] [--frames N] [--first-hit | --both | --lists] [--color]
//               [--cuts] [--orbit N] [--only NAME,...] [--models FOLDER] [--scenes FOLDER] [--json FILE] [--floors]
//   csgrt_bench --compare A.json B.json
//
// --floors: also what a frame of every partition must do at least, counted, beside what was measured of it (nothing is
// measured with --frames 0).
// --lists: in place of pictures what is asked of their rays: partitions (regions and distances) of a list and of a
// grid, the same with all fields, first hits, `shoot`, and of as many points and pixels of a slice through the model's
// middle which regions hold them.
// --color: pictures of colours alone, as a viewer shows them, in place of all channels.
// --cuts: also the same pictures cut by three planes through the model's middle (View::clip), and of the model less a
// half-space in its tree; and the geometric means of their frames in uncut ones.
// --orbit N: a frame at each of N azimuths around the model, as a viewer draws them, in place of --frames from one
// side. Afterwards the orbit is drawn again, and its pictures must be those that are drawn into new memory, bit by bit;
// if not, the exit status is 8.
// --only: workloads whose names begin so. `first` is the time from a loaded scene to the first picture.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <tuple>

#include <csgrt/csgrt.hpp>

#include "base/clock.hpp"
#include "figures.hpp"
#include "floors.hpp"
#include "program.hpp"
#include "stress/parts.hpp"
#include "workloads.hpp"

namespace {

using namespace csgrt;
using namespace csgrt::bench;

struct Options {
    std::vector<std::string> devices, only;
    std::string models = "../shared/brlcad", scenes = "scenes", json, compare, compare_with;
    int size = 1024, frames = 20, orbit = 0;
    bool every_partition = true, first_hits = false, lists = false, floors = false, color = false, cuts = false;
};

/// Of frame `i`: always from one side, or from the orbit's next azimuth.
View view_of(const Options& options, bool every_partition, int i) {
    View view;
    view.width = view.height = options.size;
    view.every_partition = every_partition;
    if (options.color) view.channels = channel::color;
    if (options.orbit > 0) view.camera.azimuth = 35 + 360.0 * i / options.orbit;
    return view;
}

/// Frames that share a picture's memory change only a part of it. Throws Error (differs) if one of the orbit's pictures
/// differs in any bit from the picture that is drawn into new memory.
void check_orbit(const std::string& workload, Renderer& renderer, bool every_partition, const Options& options) {
    Framebuffer framebuffer;
    for (int i = 0; i < options.orbit; ++i) {
        const View view = view_of(options, every_partition, i);
        renderer.render(view, framebuffer);
        const Image &reused = framebuffer.image(), fresh = renderer.render(view);
        for (std::size_t c = 0; c < fresh.channels.size(); ++c) {
            if (std::memcmp(reused.channels[c].data(), fresh.channels[c].data(), fresh.channels[c].size_bytes()) == 0)
                continue;
            throw Error(Status::differs, workload + ": frame " + std::to_string(i) + " of the orbit: channel " +
                                             fresh.names[c] + " is not that of a picture drawn into new memory");
        }
    }
}

/// What is measured: once per frame.
struct Task {
    std::string mode;
    std::function<void(Renderer&, int frame)> work;
    bool every_partition = true;
    std::optional<Model> model = {};  ///< in place of the workload's
};

const char* const cuts[] = {", three planes", ", less a half-space"};

/// Three planes through the middle of the model, which leave what is seen best from the usual side.
std::vector<Plane> middle_planes(const Box& box) {
    return {{{1, 0, 0}, 0.5 * (box.low.x + box.high.x)},
            {{0, 0, 1}, 0.5 * (box.low.z + box.high.z)},
            {{0.6, 0.8, 0}, 0.3 * (box.low.x + box.high.x) + 0.4 * (box.low.y + box.high.y)}};
}

/// All objects less what is beyond the first of these planes.
Model less_half_space(Scene scene, const std::vector<std::string>& objects, const Box& box) {
    const Plane plane = middle_planes(box).front();
    scene.objects.push_back(
        Solid{"a half-space", Half{{{-plane.normal.x, -plane.normal.y, -plane.normal.z}, -plane.distance}}, {}});
    std::vector<std::string> cut;
    for (const std::string& object : objects) {
        cut.push_back(object + " less a half-space");
        scene.objects.push_back(Combination{.name = cut.back(), .tree = tree(object) - tree("a half-space")});
    }
    return Model(std::move(scene), cut);
}

/// Rays, points and answers that tasks share.
struct ListData {
    std::vector<Ray> rays;
    std::vector<Vec3> points;
    RayGrid grid;
    Slice slice;
    Partitions partitions;
    Hits hits;
    Array<std::int32_t> ids;
};

std::vector<Task> picture_tasks(const Model& model, const Scene& scene, const std::vector<std::string>& objects,
                                const Options& options) {
    std::vector<Task> tasks;
    for (const bool every_partition : {true, false}) {
        if (!(every_partition ? options.every_partition : options.first_hits)) continue;
        const auto framebuffer = std::make_shared<Framebuffer>();
        tasks.push_back({every_partition ? "every partition" : "first hits",
                         [&options, every_partition, framebuffer](Renderer& renderer, int frame) {
                             renderer.render(view_of(options, every_partition, frame), *framebuffer);
                         },
                         every_partition});
        if (!options.cuts) continue;
        const Task uncut = tasks.back();
        View view = view_of(options, every_partition, 0);
        view.clip = middle_planes(model.bounds());
        tasks.push_back({uncut.mode + cuts[0],
                         [view, framebuffer](Renderer& renderer, int) { renderer.render(view, *framebuffer); },
                         every_partition});
        tasks.push_back(
            {uncut.mode + cuts[1], uncut.work, every_partition, less_half_space(scene, objects, model.bounds())});
    }
    return tasks;
}

std::vector<Task> list_tasks(const Model& model, const Options& options) {
    const View view = view_of(options, true, 0);
    const Box& box = model.bounds();
    const auto d = std::make_shared<ListData>();
    d->grid = model.grid_of(view);
    for (int row = 0; row < options.size; ++row)
        for (int column = 0; column < options.size; ++column) d->rays.push_back(d->grid.ray(column, row));
    d->slice = slice_of(box, {0, 0, 1}, 0.5 * (box.low.z + box.high.z), options.size, options.size);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto between = [&](double low, double high) { return low + unit(random) * (high - low); };
    for (std::size_t i = 0; i < d->rays.size(); ++i)
        d->points.push_back(
            {between(box.low.x, box.high.x), between(box.low.y, box.high.y), between(box.low.z, box.high.z)});
    return {{"lists", [d](Renderer& renderer, int) { renderer.partitions(d->rays, d->partitions); }},
            {"lists, all fields",
             [d](Renderer& renderer, int) {
                 renderer.partitions(d->rays, d->partitions, {.solids = true, .normals = true, .overlaps = true});
             }},
            {"lists, grids", [d](Renderer& renderer, int) { renderer.partitions(d->grid, d->partitions); }},
            {"lists, first hits", [d](Renderer& renderer, int) { renderer.cast_rays(d->rays, d->hits); }},
            {"lists, shoot", [d](Renderer& renderer, int) { renderer.shoot(d->rays); }},
            {"points", [d](Renderer& renderer, int) { renderer.region_at(d->points, d->ids); }},
            {"slice", [d](Renderer& renderer, int) { renderer.slice(d->slice, d->ids); }}};
}

Figures measure(const Workload& workload, Renderer& renderer, const Task& task, const Options& options) {
    const double setup = renderer.statistics().ms.build;
    const auto start = Clock::now();
    task.work(renderer, 0);  // compiles kernels and takes memory
    Figures f;
    f.ms = {{"compile", renderer.statistics().ms.compile}, {"build", renderer.statistics().ms.build}};
    f.ms.emplace_back("first", renderer.statistics().ms.compile + setup + milliseconds_since(start));
    std::vector<Statistics> frames;
    const int count = options.orbit > 0 ? options.orbit : options.frames;
    for (int i = 0; i < count; ++i) {
        const auto begin = Clock::now();
        task.work(renderer, i);
        frames.push_back(renderer.statistics());
        if (options.lists) frames.back().ms.frame = milliseconds_since(begin);  // all that the caller waits for
    }
    const Statistics& s = frames.front();
    f.workload = workload.name;
    f.device = s.device;
    f.mode = task.mode;
    if (options.color) f.mode += ", colors alone";
    f.size = options.size;
    f.frames = count;
    f.orbit = options.orbit;
    f.solids = renderer.model().solids().size();
    f.regions = renderer.model().regions().size();
    f.segments = s.segments;
    f.partitions_used = s.partitions_used;
    f.partitions_allocated = s.partitions_allocated;
    f.segment_and_partition_bytes = s.segment_bytes + s.partition_bytes;
    f.device_bytes = s.device_bytes;
    const auto times = [&](const auto& of) {
        std::vector<double> values;
        for (const Statistics& frame : frames) values.push_back(of(frame.ms));
        return values;
    };
    for (const Stage& stage : stages)
        f.ms.emplace_back(stage.name, median(times([&](const Times& ms) { return ms.*stage.time; })));
    f.ms.emplace_back("kernels", median(times([](const Times& ms) { return ms.kernels; })));
    const std::vector<double> whole = times([](const Times& ms) { return ms.frame; });
    f.ms.emplace_back("frame", median(whole));
    if (options.orbit > 0) f.ms.emplace_back("worst", *std::max_element(whole.begin(), whole.end()));
    return f;
}

Options parse(int argc, char** argv) {
    Options o;
    bool first_hit = false, both = false;
    OptionReader options;
    options.flag("--first-hit", first_hit);
    options.flag("--both", both);
    options.flag("--lists", o.lists);
    options.flag("--color", o.color);
    options.flag("--cuts", o.cuts);
    options.flag("--floors", o.floors);
    options.value("--device", [&](const std::string& device) { o.devices.push_back(device); });
    options.text("--models", o.models);
    options.text("--scenes", o.scenes);
    options.text("--json", o.json);
    options.number("--size", o.size, 1, 1'000'000);
    options.number("--frames", o.frames, 0, 1'000'000);
    options.number("--orbit", o.orbit, 1, 1'000'000);
    options.list("--only", o.only);
    options.text("--compare", o.compare);
    const std::vector<std::string> words = options.read(argc, argv, 1, 1);
    if (words.empty() != o.compare.empty()) throw Error(Status::usage, "--compare takes two files, all else none");
    if (!words.empty()) o.compare_with = words[0];
    o.first_hits = first_hit || both;
    o.every_partition = both || !first_hit;
    if (o.devices.empty()) o.devices.push_back("");
    if (std::find(o.devices.begin(), o.devices.end(), "all") != o.devices.end()) {
        o.devices.clear();
        for (std::size_t i = 0; i < devices().size(); ++i) o.devices.push_back(std::to_string(i));
    }
    return o;
}

bool wanted(const Workload& workload, const Options& options) {
    return options.only.empty() || std::any_of(options.only.begin(), options.only.end(), [&](const std::string& name) {
               return workload.name.starts_with(name);
           });
}

/// By workload, so that a scene is generated or read but once.
std::vector<Figures> run(const Options& options, std::vector<Floor>& floors) {
    std::vector<Figures> all;
    for (const std::string& device : options.devices) {  // as the command does, and viewers should
        Settings settings;
        settings.device = device;
        prepare_devices(settings);
    }
    for (const Workload& workload : workloads()) {
        if (!wanted(workload, options)) continue;
        const bool ours = workload.file.ends_with(".json");
        const std::string path = (ours ? options.scenes : options.models) + "/" + workload.file;
        if (workload.parts == 0 && !std::filesystem::exists(path)) {
            std::fprintf(stderr, "%s: left out, there is no %s\n", workload.name.c_str(), path.c_str());
            continue;
        }
        const auto start = Clock::now();
        const Scene scene = workload.parts > 0 ? stress::scene_of_parts(workload.parts) : load_scene(path);
        const double load = milliseconds_since(start);
        if (options.floors) floors.push_back(count_floor(workload.name, scene, workload.objects));
        if (options.frames == 0 && options.orbit == 0) continue;
        for (const std::string& device : options.devices) {
            Settings settings;
            settings.device = device;
            settings.wait_for_device = true;
            const Model model(scene, workload.objects);
            for (const Task& task :
                 options.lists ? list_tasks(model, options) : picture_tasks(model, scene, workload.objects, options)) {
                Renderer renderer(task.model.value_or(model), settings);
                all.push_back(measure(workload, renderer, task, options));
                check_orbit(workload.name, renderer, task.every_partition, options);
                all.back().ms.emplace(all.back().ms.begin(), "load", load);
                std::fprintf(stderr, "%s, %s: frame %.2f ms\n", workload.name.c_str(), all.back().mode.c_str(),
                             all.back().time("frame"));
            }
        }
    }
    // A table a device and mode.
    std::stable_sort(all.begin(), all.end(), [](const Figures& a, const Figures& b) {
        return std::tie(a.device, a.mode) < std::tie(b.device, b.mode);
    });
    return all;
}

/// Of each cut, the geometric mean over all workloads of its frame in the uncut one.
void print_cuts(const std::vector<Figures>& all) {
    for (const char* const cut : cuts)
        for (const std::string mode : {"every partition", "first hits"}) {
            double sum = 0;
            int count = 0;
            for (const Figures& f : all)
                for (const Figures& whole : all) {
                    if (f.mode != mode + cut || whole.mode != mode || whole.workload != f.workload) continue;
                    sum += std::log(f.time("frame") / whole.time("frame"));
                    ++count;
                }
            if (count > 0) std::printf("%s%s: %.2f of the uncut frame\n", mode.c_str(), cut, std::exp(sum / count));
        }
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("csgrt_bench", [&] {
        const Options options = parse(argc, argv);
        if (!options.compare.empty()) {
            print_comparison(load(options.compare), load(options.compare_with));
            return 0;
        }
        std::vector<Floor> floors;
        const std::vector<Figures> all = run(options, floors);
        print(all);
        print_cuts(all);
        std::vector<double> measured;
        for (const Floor& floor : floors) {
            measured.push_back(-1);
            for (const Figures& f : all)
                if (f.workload == floor.workload && f.mode == "every partition") measured.back() = f.time("kernels");
        }
        if (options.floors) print_floors(floors, measured, options.size);
        if (!options.json.empty()) save(all, options.json);
        return 0;
    });
}
