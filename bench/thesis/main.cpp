// csgrt_thesis: the figures of docs/thesis.md. Models are counted, drawn and mapped as in the tables 4.1 and 4.2 and
// the figures 4.1 and 4.2 of Domingues 2017; and the laboratory's method "thesis" is run with each of its switches.
//
//   csgrt_thesis --json FILE [--device CHOICE|reference]... [--threads N] [--models FOLDER] [--only NAME,...]
//                [--size N] [--rounds N] [--claims N] [--maps FOLDER] [--commit TEXT]
//
// --device: several take turns, a frame each; the first one counts, too. The reference draws a sixteenth of the rays.
// --threads: of processors, PoCL's as well; 0: all. --size: of frames (1024).
// --claims: the switches are run on pictures of N x N rays (256); 0: they are not run.
// --maps: writes the number of segments of rays as NAME.pgm, which bench/thesis/document makes a picture of.
// --commit: a text for the file.
//
// All times are the least of --rounds (7): other work on the machine makes them larger only.
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include <csgrt/csgrt.hpp>
#include <nlohmann/json.hpp>

#include "base/clock.hpp"
#include "base/laboratory.hpp"
#include "bench/figures.hpp"
#include "bench/methods/list.hpp"
#include "bench/methods/thesis.hpp"
#include "bench/program.hpp"
#include "bench/workloads.hpp"
#include "compile/flatten/flatten.hpp"
#include "device/choice.hpp"
#include "published.hpp"

namespace {

using namespace csgrt;
using namespace csgrt::bench;
using Json = nlohmann::ordered_json;

struct Options {
    std::vector<std::string> devices, only;
    std::string models = "../shared/brlcad", json, maps, commit, command;
    int size = 1024, rounds = 7, claims = 256;
    unsigned threads = 0;
};

struct Subject {
    const Published& published;
    std::vector<std::string> objects;
    Scene scene;
    Model model;
};

View view_of(const Subject& subject, int size, bool every_partition) {
    View view;
    view.width = view.height = size;
    view.every_partition = every_partition;
    if (subject.published.view_size > 0) view.camera.view_size = subject.published.view_size;
    return view;
}

Settings settings_of(const std::string& device, const Options& options) {
    Settings settings;
    settings.reference = device == "reference";
    if (!settings.reference) settings.device = device;
    settings.threads = options.threads;
    settings.wait_for_device = true;
    return settings;
}

/// Milliseconds of all processors, since the process began.
double processor_ms() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const auto ms = [](const timeval& time) { return 1e3 * double(time.tv_sec) + 1e-3 * double(time.tv_usec); };
    return ms(used.ru_utime) + ms(used.ru_stime);
}

/// BRL-CAD looks for an equal solid only while its object has less than 100 uses: later ones count again, as often as
/// they stand in trees. Its threads walk the trees at once, so which ones these are is chance there. Here: of a walk in
/// order. Returns the copies of each instance that trees use.
std::map<std::uint32_t, int> copies_as_brlcad_counts(const FlatScene& flat) {
    std::map<std::uint32_t, int> uses, copies;
    for (const FlatRegion& region : flat.regions)
        for (const FlatTree::Node& node : region.tree.nodes) {
            if (node.op != Operator::leaf || flat.instances[node.solid].piece > 0) continue;
            int& used = uses[flat.instances[node.solid].object];
            if (used < 100 && copies.count(node.solid)) continue;
            ++used;
            ++copies[node.solid];
        }
    return copies;
}

/// Solids as BRL-CAD counts them, and the segments of the picture's rays that come of counting solids again.
void count_as_brlcad(const Subject& subject, const Options& options, Json& json) {
    const FlatScene flat = flatten(subject.scene, subject.objects, false);
    const std::map<std::uint32_t, int> copies = copies_as_brlcad_counts(flat);
    std::uint64_t solids = 0, segments = 0, pipes = 0;
    std::map<int, std::vector<std::uint32_t>> groups;  // by how often more than once
    std::vector<std::uint32_t> of_pipes;
    for (const auto& [instance, often] : copies) {
        solids += std::uint64_t(often);
        if (often > 1) groups[often - 1].push_back(instance);
        const auto& solid = std::get<Solid>(subject.scene.objects[flat.instances[instance].object]);
        if (std::holds_alternative<Pipe>(solid.shape)) of_pipes.push_back(instance);
    }
    const RayGrid grid = subject.model.grid_of(view_of(subject, options.size, true));
    const auto count = [&](Scene scene, const std::vector<std::string>& objects) {
        Renderer renderer(Model(std::move(scene), objects), settings_of(options.devices.front(), options));
        Partitions partitions;
        renderer.partitions(grid, partitions);
        return renderer.statistics();
    };
    const auto segments_of = [&](const std::vector<std::uint32_t>& instances) -> std::uint64_t {
        if (instances.empty()) return 0;
        Scene scene = subject.scene;
        std::vector<std::string> names;
        for (const std::uint32_t i : instances) {
            const Instance& instance = flat.instances[i];
            names.push_back("alone " + std::to_string(i));
            scene.objects.push_back(
                Combination{.name = names.back(),
                            .tree = tree(std::get<Solid>(scene.objects[instance.object]).name, *instance.matrix),
                            .region = true});
        }
        return count(std::move(scene), names).segments;
    };
    for (const auto& [more, instances] : groups) segments += std::uint64_t(more) * segments_of(instances);
    pipes = segments_of(of_pipes);
    Scene without_pipes = subject.scene;
    for (Object& object : without_pipes.objects)
        if (auto* const solid = std::get_if<Solid>(&object); solid && std::holds_alternative<Pipe>(solid->shape))
            solid->shape = Ell{{}, {1e-6, 0, 0}, {0, 1e-6, 0}, {0, 0, 1e-6}};  // no ray of the picture meets it
    json["solids"] = std::count_if(flat.instances.begin(), flat.instances.end(),
                                   [](const Instance& instance) { return instance.piece == 0; });
    json["brlcad"] = {{"solids", solids}, {"segments_counted_again", segments}, {"segments_of_pipes", pipes}};
    if (pipes > 0)
        json["brlcad"]["partitions_without_pipes"] = count(std::move(without_pipes), subject.objects).partitions_used;
}

/// What is kept of one device in one mode.
struct Run {
    Renderer* renderer;
    bool every_partition;
    int size;
    std::shared_ptr<Framebuffer> framebuffer = std::make_shared<Framebuffer>();
    Statistics least = {};  ///< of the frame whose kernels took least, or of a reference's least frame
    double frame_ms = 0, processor_ms = 0;
};

void draw(Run& run, const Subject& subject, bool first) {
    const double processor = processor_ms();
    const auto start = Clock::now();
    run.renderer->render(view_of(subject, run.size, run.every_partition), *run.framebuffer);
    const double frame = milliseconds_since(start), used = processor_ms() - processor;
    const Statistics& now = run.renderer->statistics();
    const auto time = [](const Statistics& s) { return s.ms.kernels > 0 ? s.ms.kernels : s.ms.frame; };
    if (first || time(now) < time(run.least)) run.least = now;
    run.frame_ms = first ? frame : std::min(frame, run.frame_ms);
    run.processor_ms = first ? used : std::min(used, run.processor_ms);
}

Json json_of(const Run& run) {
    const Statistics& s = run.least;
    Json ms = {{"frame", run.frame_ms}, {"processor", run.processor_ms}, {"kernels", s.ms.kernels}};
    for (const Stage& stage : stages) ms[stage.name] = s.ms.*stage.time;
    return {{"device", s.device},
            {"size", run.size},
            {"mode", run.every_partition ? "every partition" : "first hits"},
            {"device_bytes", s.device_bytes},
            {"segment_bytes", s.segment_bytes},
            {"partition_bytes", s.partition_bytes},
            {"ms", ms}};
}

/// The most segments of the rays of each 4 x 4 pixels.
void write_map(std::span<const float> depth, int size, const std::string& path) {
    const int side = size / 4;
    std::ofstream file(path, std::ios::binary);
    file << "P5\n" << side << " " << side << "\n255\n";
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            float most = 0;
            for (int i = 0; i < 16; ++i)
                most = std::max(most, depth[std::size_t(4 * row + i / 4) * size + 4 * column + i % 4]);
            file.put(static_cast<char>(static_cast<unsigned char>(std::min(most, 255.0f))));
        }
    if (!file.flush()) throw Error(Status::file, path + ": cannot be written");
}

/// Frames, in turn, of all devices in both modes.
void measure(const Subject& subject, const Options& options, Json& json) {
    std::vector<std::unique_ptr<Renderer>> renderers;
    std::vector<Run> runs;
    for (const std::string& device : options.devices) {
        renderers.push_back(std::make_unique<Renderer>(subject.model, settings_of(device, options)));
        for (const bool every_partition : {true, false})
            runs.push_back(
                {renderers.back().get(), every_partition, device == "reference" ? options.size / 4 : options.size});
    }
    for (Run& run : runs) draw(run, subject, true);  // compiles and takes memory
    for (int round = 0; round < options.rounds; ++round)
        for (Run& run : runs)
            if (run.frame_ms < 1000 || round < 3) draw(run, subject, round == 0);
    const Image& image = runs.front().framebuffer->image();
    const std::span<const float> depth = image.channel("depth");
    const Statistics& s = runs.front().least;
    json["parts"] = subject.model.solids().size();
    json["regions"] = subject.model.regions().size();
    json["segments"] = s.segments;
    json["partitions"] = s.partitions_used;
    json["allocated"] = s.partitions_allocated;
    json["most_segments"] = *std::max_element(depth.begin(), depth.end());
    json["rays_that_hit"] = std::count_if(depth.begin(), depth.end(), [](float count) { return count > 0; });
    if (!options.maps.empty()) write_map(depth, options.size, options.maps + "/" + subject.published.workload + ".pgm");
    for (const Run& run : runs) json["runs"].push_back(json_of(run));
}

/// Of frames around the model, those in which a batch's queued kernels had too little memory and ran again.
void count_repairs(const Subject& subject, const Options& options, Json& json) {
    std::uint64_t retried = 0;
    Renderer renderer(subject.model,
                      with_methods({.retried = &retried}, settings_of(options.devices.front(), options)));
    Framebuffer framebuffer;
    View view = view_of(subject, options.size, true);
    constexpr int frames = 72;
    int repaired = 0;
    std::uint64_t batches = 0;
    for (int i = -1; i < frames; ++i) {  // the first has no memory yet, and does not count
        view.camera.azimuth = 35 + 360.0 * std::max(i, 0) / frames;
        const std::uint64_t before = retried;
        renderer.render(view, framebuffer);
        if (i < 0) continue;
        repaired += retried > before;
        batches += renderer.statistics().batches;
    }
    json["orbit"] = {{"frames", frames}, {"batches", batches}, {"frames_repaired", repaired}};
}

void run_switches(const Subject& subject, const Options& options, const std::string& device, Json& json) {
    const CompiledScene compiled = compile(subject.scene, subject.objects);
    const std::vector<Ray> rays = subject.model.grid_of(view_of(subject, options.claims, true)).rays();
    const std::vector<RayPartitions> expected = Renderer(subject.model, settings_of("reference", options)).shoot(rays);
    struct Trial {
        std::unique_ptr<Tracer> tracer;
        double kernel_4 = 1e30, others = 1e30, spent = 0;
        std::size_t wrong = 0;
    };
    std::vector<Trial> trials;
    for (std::size_t i = 0; i < std::size(thesis_switches); ++i) {
        Trial& trial = trials.emplace_back();
        trial.tracer = thesis().prepare({subject.scene, subject.objects, compiled},
                                        {.knob = double(i), .first_hits = true, .device = device});
        const std::vector<Answer> answers = trial.tracer->trace(rays);  // compiles and takes memory
        for (std::size_t ray = 0; ray < rays.size(); ++ray) {
            Sequence should = sequence_of(expected[ray]);
            should.resize(std::min<std::size_t>(should.size(), 1));
            trial.wrong += !same_regions(joined(answers[ray].stretches), should);
        }
    }
    for (int round = 0; round < options.rounds; ++round)
        for (Trial& trial : trials) {
            if (trial.spent > 2) continue;
            trial.tracer->trace(rays);
            trial.spent += trial.tracer->seconds();
            const std::map<std::string, double> figures = trial.tracer->figures();
            trial.kernel_4 = std::min(trial.kernel_4, figures.at("kernel 4 ms"));
            trial.others = std::min(trial.others, figures.at("kernels 1 to 3 ms"));
        }
    Json& list = json["switches"][device];
    for (std::size_t i = 0; i < trials.size(); ++i)
        list.push_back({{"name", thesis_switches[i].name},
                        {"rays", rays.size()},
                        {"wrong", trials[i].wrong},
                        {"kernel_4_ms", trials[i].kernel_4},
                        {"kernels_1_to_3_ms", trials[i].others}});
    json["regions_of_unions"] = trials.front().tracer->figures().at("regions of unions alone");
}

Options parse(int argc, char** argv) {
    Options o;
    for (int i = 0; i < argc; ++i)  // without folders, which are this machine's
        o.command += (i ? " " : "") + std::filesystem::path(argv[i]).filename().string();
    OptionReader options;
    options.value("--device", [&](const std::string& device) { o.devices.push_back(device); });
    options.number("--threads", o.threads, 0, 1024);
    options.text("--models", o.models);
    options.list("--only", o.only);
    options.number("--size", o.size, 16, 8192);
    options.number("--rounds", o.rounds, 1, 1000);
    options.number("--claims", o.claims, 0, 2048);
    options.text("--maps", o.maps);
    options.text("--commit", o.commit);
    options.text("--json", o.json);
    options.read(argc, argv);
    if (o.json.empty()) throw Error(Status::usage, "--json FILE is missing: where the figures go");
    if (o.devices.empty()) o.devices.push_back("");
    if (o.devices.front() == "reference") throw Error(Status::usage, "--device: the first cannot be the reference");
    return o;
}

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

/// Devices with a compiler run the switches.
bool compiles(const std::string& device, std::string* type) {
    if (device == "reference") return false;
    const DeviceInfo info = devices()[choose_device(devices(), device, Kernels::any)];
    *type = info.type;
    return info.platform != "csgrt";
}

Json run(const Options& options) {
    Json json = {{"csgrt", version()},
                 {"commit", options.commit},
                 {"command", options.command},
                 {"processor", processor_name()},
                 {"cores", std::thread::hardware_concurrency()},
                 {"threads", options.threads},
                 {"size", options.size},
                 {"rounds", options.rounds},
                 {"claims", options.claims},
                 {"models", Json::array()}};
    for (const auto& [device, program] : published_columns) json["columns"].push_back({device, program});
    for (const Published& p : published()) {
        if (!options.only.empty() && std::ranges::find(options.only, p.workload) == options.only.end()) continue;
        const std::string path = options.models + "/" + p.file;
        if (!std::filesystem::exists(path)) {
            std::fprintf(stderr, "%s: left out, there is no %s\n", p.name.c_str(), path.c_str());
            continue;
        }
        Scene scene = load_scene(path);
        std::vector<std::string> objects = p.objects.empty() ? top_objects(scene) : p.objects;
        Model model(scene, objects);
        const Subject subject{p, std::move(objects), std::move(scene), std::move(model)};
        Json entry = {{"name", p.name},
                      {"file", p.file},
                      {"objects", p.objects},
                      {"view_size", p.view_size},
                      {"picture", p.workload}};
        entry["thesis"] = {{"primitives", p.primitives},
                           {"regions", p.regions},
                           {"segments", p.segments},
                           {"partitions", p.partitions},
                           {"allocated", p.allocated},
                           {"megabytes", p.megabytes},
                           {"ms", p.ms}};
        for (const Workload& w : workloads())
            if (w.name == p.workload)
                entry["recorded"] = {{"brlcad_cpu_ms", w.brlcad_cpu_ms},
                                     {"brlcad_pocl_ms", w.brlcad_pocl_ms},
                                     {"brlcad_h200_ms", w.brlcad_h200_ms}};
        for (const BesideBrlcad& b : beside_brlcad())
            if (b.workload == p.workload)
                entry["beside_brlcad"] = {{"BRL-CAD 7.45, C, 2 threads", b.rt_2},
                                          {"csgrt beside it", b.csgrt_2},
                                          {"BRL-CAD 7.45, C, 16 threads", b.rt_16},
                                          {"csgrt beside that", b.csgrt_16},
                                          {"one thread: BRL-CAD / csgrt", b.one_thread}};
        count_as_brlcad(subject, options, entry);
        measure(subject, options, entry);
        for (const std::string& device : options.devices) {
            std::string type;
            const bool compiling = compiles(device, &type);
            if (type == "gpu" && device == options.devices.front()) count_repairs(subject, options, entry);
            if (compiling && options.claims > 0) run_switches(subject, options, device, entry);
        }
        json["models"].push_back(std::move(entry));
        std::fprintf(stderr, "%s: done\n", p.name.c_str());
    }
    if (json["models"].empty())
        throw Error(Status::file, options.models + ": it has none of the models; --models FOLDER");
    return json;
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("csgrt_thesis", [&] {
        const Options options = parse(argc, argv);
        // PoCL reads it when it starts.
        if (options.threads > 0) setenv("POCL_MAX_PTHREAD_COUNT", std::to_string(options.threads).c_str(), 1);
        Json json = run(options);
        const Json models = std::move(json["models"]);
        json.erase("models");
        std::ofstream file(options.json);
        file << json.dump().substr(0, json.dump().size() - 1) << ",\n\"models\": [";  // a line a model
        for (std::size_t i = 0; i < models.size(); ++i) file << (i ? ",\n" : "\n") << models[i].dump();
        file << "\n]}\n";
        if (!file.flush()) throw Error(Status::file, options.json + ": cannot be written");
        return 0;
    });
}
