// csgrt_bench: warm frames of every workload; tables on standard output, JSON on demand.
//
//   csgrt_bench [--device CHOICE|all]... [--size N] [--frames N] [--first-hit | --both | --lists] [--color]
//               [--orbit N] [--only NAME,...] [--models FOLDER] [--scenes FOLDER] [--json FILE] [--floors]
//   csgrt_bench --compare A.json B.json
//
// --floors: also what a frame of every partition must do at least, counted, beside what was measured of it (nothing is
// measured with --frames 0).
// --lists: in place of pictures the partitions along their rays, as arrays: regions and distances.
// --color: pictures of colours alone, as a viewer shows them, in place of all channels.
// --orbit N: a frame at each of N azimuths around the model, as a viewer draws them, in place of --frames from one
// side. Afterwards the orbit is drawn again, and its pictures must be those that are drawn into new memory, bit by bit;
// if not, the exit status is 8.
// --only: workloads whose names begin so. `first` is the time from a loaded scene to the first picture.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <tuple>

#include <csgrt/csgrt.hpp>

#include "base/clock.hpp"
#include "cli/cache_folder.hpp"
#include "figures.hpp"
#include "floors.hpp"
#include "options.hpp"
#include "parts.hpp"
#include "workloads.hpp"

namespace {

using namespace csgrt;
using namespace csgrt::bench;

struct Options {
    std::vector<std::string> devices, only, compare;
    std::string models = "../shared/brlcad", scenes = "scenes", json;
    int size = 1024, frames = 20, orbit = 0;
    bool every_partition = true, first_hits = false, lists = false, floors = false, color = false;
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

Figures measure(const Workload& workload, Renderer& renderer, bool every_partition, const Options& options) {
    const double setup = renderer.statistics().ms.build;
    const auto start = Clock::now();
    Framebuffer framebuffer;
    renderer.render(view_of(options, every_partition, 0), framebuffer);  // compiles kernels and takes memory
    Figures f;
    f.ms = {{"compile", renderer.statistics().ms.compile}, {"build", renderer.statistics().ms.build}};
    f.ms.emplace_back("first", renderer.statistics().ms.compile + setup + milliseconds_since(start));
    std::vector<Statistics> frames;
    const int count = options.orbit > 0 ? options.orbit : options.frames;
    const std::vector<Ray> rays =
        options.lists ? renderer.rays_of(view_of(options, every_partition, 0)) : std::vector<Ray>();
    Partitions answer;
    if (options.lists) renderer.partitions(rays, answer);
    for (int i = 0; i < count; ++i) {
        if (options.lists)
            renderer.partitions(rays, answer);
        else
            renderer.render(view_of(options, every_partition, i), framebuffer);
        frames.push_back(renderer.statistics());
    }
    const Statistics& s = frames.front();
    f.workload = workload.name;
    f.device = s.device;
    f.mode = every_partition ? "every partition" : "first hits";
    if (options.lists) f.mode = "lists";
    if (options.color) f.mode += ", colors alone";
    f.size = options.size;
    f.frames = count;
    f.orbit = options.orbit;
    f.solids = renderer.solids().size();
    f.regions = renderer.regions().size();
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
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (name == "--first-hit" || name == "--both") {
            options.first_hits = true;
            options.every_partition = name == "--both";
            continue;
        }
        if (name == "--lists") {
            options.lists = true;
            continue;
        }
        if (name == "--color") {
            options.color = true;
            continue;
        }
        if (name == "--floors") {
            options.floors = true;
            continue;
        }
        if (i + 1 == argc) throw Error(Status::usage, name + ": unknown, or lacks its value");
        const std::string value = argv[++i];
        if (name == "--device") {
            options.devices.push_back(value);
        } else if (name == "--models") {
            options.models = value;
        } else if (name == "--scenes") {
            options.scenes = value;
        } else if (name == "--json") {
            options.json = value;
        } else if (name == "--size") {
            options.size = parse_number(name, value, 1, 1'000'000);
        } else if (name == "--frames") {
            options.frames = parse_number(name, value, 0, 1'000'000);
        } else if (name == "--orbit") {
            options.orbit = parse_number(name, value, 1, 1'000'000);
        } else if (name == "--only") {
            options.only = split_list(value);
        } else if (name == "--compare") {
            if (i + 1 == argc) throw Error(Status::usage, "--compare needs two files");
            options.compare = {value, argv[++i]};
        } else {
            throw Error(Status::usage, name + ": unknown option");
        }
    }
    if (options.devices.empty()) options.devices.push_back("");
    if (std::find(options.devices.begin(), options.devices.end(), "all") != options.devices.end()) {
        options.devices.clear();
        for (std::size_t i = 0; i < devices().size(); ++i) options.devices.push_back(std::to_string(i));
    }
    return options;
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
        const Scene scene = workload.parts > 0 ? scene_of_parts(workload.parts) : load_scene(path);
        const double load = milliseconds_since(start);
        if (options.floors) floors.push_back(count_floor(workload.name, scene, workload.objects));
        if (options.frames == 0 && options.orbit == 0) continue;
        for (const std::string& device : options.devices) {
            for (const bool every_partition : {true, false}) {
                if (!(every_partition ? options.every_partition : options.first_hits)) continue;
                Settings settings;
                settings.device = device;
                settings.wait_for_device = true;
                Renderer renderer(scene, workload.objects, settings);
                all.push_back(measure(workload, renderer, every_partition, options));
                check_orbit(workload.name, renderer, every_partition, options);
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

}  // namespace

int main(int argc, char** argv) {
    cli::ensure_cache_folder();
    try {
        const Options options = parse(argc, argv);
        if (!options.compare.empty()) {
            print_comparison(load(options.compare[0]), load(options.compare[1]));
            return 0;
        }
        std::vector<Floor> floors;
        const std::vector<Figures> all = run(options, floors);
        print(all);
        std::vector<double> measured;
        for (const Floor& floor : floors) {
            measured.push_back(-1);
            for (const Figures& f : all)
                if (f.workload == floor.workload && f.mode == "every partition") measured.back() = f.time("kernels");
        }
        if (options.floors) print_floors(floors, measured, options.size);
        if (!options.json.empty()) save(all, options.json);
    } catch (const Error& error) {
        std::fprintf(stderr, "csgrt_bench: %s\n", error.what());
        return static_cast<int>(error.status());
    }
    return 0;
}
