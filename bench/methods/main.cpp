// csgrt_methods: the laboratory's methods, listed and run.
//
//   csgrt_methods                                   lists them
//   csgrt_methods run NAME SCENE [OBJECTS...] [--knob X] [--size N | --rays FILE] [--first-hits] [--device D]
//                 [--threads N] [--compare]
//
// SCENE: a file, or stress:FAMILY:SEED with the rays of that scene of the stress suite (tests/stress/README.md).
// --size: a picture of the scene's view of N x N rays (256). --rays: a file for `csgrt shoot`.
// Times are those of the fastest of seven runs or more (a second of them).
// --compare: how many rays have other regions than the CPU reference; and, for methods with kernels, how long csgrt's
// own take.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>

#include <csgrt/csgrt.hpp>

#include "bench/program.hpp"
#include "compile/compiled_scene.hpp"
#include "device/choice.hpp"
#include "method.hpp"
#include "stress/families.hpp"

namespace {

using namespace csgrt;
using namespace csgrt::bench;

/// Calls run() at least seven times, and until a second has passed. Where a machine is shared, the fastest run counts:
/// whatever else the machine does disturbs the others more, and a run of more than some milliseconds most of all.
template <class Run>
void repeat(const Run& run) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 7 || std::chrono::steady_clock::now() - start < std::chrono::seconds(1); ++i) run();
}

struct Arguments {
    std::string method, scene, rays;
    std::vector<std::string> objects;
    TraceOptions trace;
    bool has_knob = false, compare = false;
    int size = 0;  ///< 0: not given
};

/// What is traced.
struct Job {
    Scene scene;
    std::vector<std::string> objects;
    bool air = false;
    std::vector<Ray> rays;
};

Arguments parse(int argc, char** argv) {
    Arguments a;
    OptionReader options;
    options.flag("--first-hits", a.trace.first_hits);
    options.flag("--compare", a.compare);
    options.value("--knob", [&](const std::string& value) {
        constexpr double most = std::numeric_limits<double>::max();
        a.trace.knob = parse_number("--knob", value, -most, most);
        a.has_knob = true;
    });
    options.number("--size", a.size, 1, 8192);
    options.text("--rays", a.rays);
    options.text("--device", a.trace.device);
    options.number("--threads", a.trace.threads, 1, 1024);
    const std::vector<std::string> words = options.read(argc, argv, 2, SIZE_MAX);
    if (words.size() < 2) throw Error(Status::usage, "run: needs the name of a method and a scene");
    if (a.size && !a.rays.empty())
        throw Error(Status::usage, "--size and --rays exclude each other: both say which rays are traced");
    a.method = words[0];
    a.scene = words[1];
    a.objects.assign(words.begin() + 2, words.end());
    return a;
}

/// One ray a line, ox oy oz dx dy dz, as `csgrt shoot` reads them; # begins a comment.
std::vector<Ray> read_rays(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw Error(Status::file, path + ": cannot be read");
    std::vector<Ray> rays;
    std::string line;
    for (int count = 1; std::getline(file, line); ++count) {
        line.resize(std::min(line.find('#'), line.size()));
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        std::istringstream words(line);
        Ray ray;
        std::string more;
        words >> ray.origin.x >> ray.origin.y >> ray.origin.z >> ray.direction.x >> ray.direction.y >> ray.direction.z;
        if (!words || words >> more || ray.direction == Vec3{})
            throw Error(Status::file, path + ":" + std::to_string(count) +
                                          ": a ray is six numbers, ox oy oz dx dy dz, of which dx dy dz are not all 0");
        rays.push_back(ray);
    }
    if (rays.empty()) throw Error(Status::file, path + ": it has no rays");
    return rays;
}

Job job_of(const Arguments& arguments) {
    Job job;
    if (arguments.scene.starts_with("stress:")) {
        const std::size_t colon = arguments.scene.find(':', 7);
        if (colon == std::string::npos || !arguments.objects.empty())
            throw Error(Status::usage, arguments.scene + ": a scene of the stress suite is stress:FAMILY:SEED, alone");
        const auto seed =
            parse_number("SEED", arguments.scene.substr(colon + 1), std::uint64_t{0}, std::uint64_t{1} << 53);
        stress::StressScene made = stress::make(arguments.scene.substr(7, colon - 7), seed);
        job = {std::move(made.scene), std::move(made.objects), made.air, std::move(made.rays)};
    } else {
        job.scene = load_scene(arguments.scene);
        job.objects = arguments.objects;
    }
    if (!arguments.rays.empty()) {
        job.rays = read_rays(arguments.rays);
    } else if (arguments.size || job.rays.empty()) {
        View view;
        view.camera = job.scene.camera;
        view.width = view.height = arguments.size ? arguments.size : 256;
        job.rays = Model(job.scene, job.objects, {.air = job.air}).grid_of(view).rays();
    }
    return job;
}

void print_wrapped(const char* what, const std::string& text) {
    constexpr std::size_t width = 100;
    std::printf("  %-8s", what);
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = text.size() - at <= width ? text.size() : text.rfind(' ', at + width);
        if (end == std::string::npos || end <= at) end = text.size();
        std::printf("%s%s\n", at ? "          " : "", text.substr(at, end - at).c_str());
        at = end + 1;
    }
}

void list_methods() {
    for (const Method& method : methods()) {
        std::printf("%s (%s)\n", method.name.c_str(), method.source.c_str());
        print_wrapped("", method.about);
        print_wrapped("modes", std::string(method.every_partition ? "every partition" : "") +
                                   (method.every_partition && method.first_hits ? ", " : "") +
                                   (method.first_hits ? "first hits" : "") + (method.exact ? "; exact" : "") +
                                   (method.on_device ? "; on a device" : ""));
        if (!method.knob.empty()) {
            std::string values = method.knob + ":";
            char value[32];
            for (const double knob : method.knob_values) {
                std::snprintf(value, sizeof value, " %g", knob);
                values += value;
            }
            print_wrapped("knob", values);
        }
        print_wrapped("breaks", method.breaks);
        std::printf("\n");
    }
}

const Method& method_called(const std::string& name) {
    std::string names;
    for (const Method& method : methods()) {
        if (method.name == name) return method;
        names += (names.empty() ? "" : ", ") + ("\"" + method.name + "\"");
    }
    throw Error(Status::usage, "there is no method \"" + name + "\"; there are " + names);
}

void print(const char* name, const Sequence& sequence) {
    std::printf("    %-10s", name);
    for (std::size_t k = 0; k < sequence.size() && k < 12; ++k) {
        const Stretch& s = sequence[k];
        std::printf(" %s [%.9g, %.9g]", s.region == Stretch::gap ? "-" : std::to_string(s.region).c_str(), s.in, s.out);
    }
    std::printf("%s\n", sequence.size() > 12 ? " ..." : "");
}

/// How many rays have other regions than the reference says. Prints the first of them.
std::size_t compare(const Job& job, const TraceOptions& options, const std::vector<Answer>& answers) {
    Settings settings;
    settings.reference = true;
    settings.air = job.air;
    const std::vector<RayPartitions> expected = Renderer(job.scene, job.objects, settings).shoot(job.rays);
    std::size_t different = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
        if (!answers[i].answered) continue;
        Sequence should = sequence_of(expected[i]);
        if (options.first_hits && !should.empty()) should.resize(1);
        const Sequence is = joined(answers[i].stretches);
        if (same_regions(is, should)) continue;
        if (different++ > 0) continue;
        const Vec3 &o = job.rays[i].origin, &d = job.rays[i].direction;
        std::printf("  the first of them is ray %zu: %.17g %.17g %.17g %.17g %.17g %.17g\n", i, o.x, o.y, o.z, d.x, d.y,
                    d.z);
        print("method", is);
        print("reference", should);
    }
    return different;
}

/// The library's own kernels on the same device, for every partition of the same rays.
void print_own_times(const Job& job, const TraceOptions& options) {
    Settings settings;
    settings.device = options.device.empty() ? std::to_string(choose_device(devices(), "", Kernels::compiled_by_device))
                                             : options.device;
    settings.air = job.air;
    settings.wait_for_device = true;
    Renderer renderer(job.scene, job.objects, settings);
    double before = std::numeric_limits<double>::infinity(), evaluate = before;
    repeat([&] {
        renderer.shoot(job.rays);
        const auto& ms = renderer.statistics().ms;
        before = std::min(before, ms.count_segments + ms.scan + ms.store_segments + ms.weave);
        evaluate = std::min(evaluate, ms.evaluate);
    });
    std::printf("csgrt on %s: kernel 4 %.4g ms, kernels 1 to 3 %.4g ms\n", renderer.statistics().device.c_str(),
                evaluate, before);
}

Status run(const Arguments& arguments) {
    const Method& method = method_called(arguments.method);
    TraceOptions options = arguments.trace;
    if (arguments.has_knob && method.knob.empty()) throw Error(Status::usage, method.name + ": it has no knob");
    if (!arguments.has_knob && !method.knob.empty()) options.knob = method.knob_values.back();
    if (options.first_hits ? !method.first_hits : !method.every_partition)
        throw Error(Status::usage, method.name + ": it finds " +
                                       (options.first_hits ? "every partition, not first hits: leave --first-hits out"
                                                           : "first hits only: give --first-hits"));
    const Job job = job_of(arguments);
    const CompiledScene compiled = compile(job.scene, job.objects, {.air = job.air});
    std::printf("%s: %zu solids, %zu regions, %zu rays\n", arguments.scene.c_str(), compiled.solids.size(),
                compiled.region_info.size(), job.rays.size());
    const std::unique_ptr<Tracer> tracer = method.prepare({job.scene, job.objects, compiled}, options);
    const std::vector<Answer> answers = tracer->trace(job.rays);  // compiles kernels and allocates
    double seconds = std::numeric_limits<double>::infinity();
    std::map<std::string, double> figures;
    repeat([&] {
        tracer->trace(job.rays);
        if (tracer->seconds() >= seconds) return;
        seconds = tracer->seconds();
        figures = tracer->figures();
    });
    std::size_t given_up = 0, stretches = 0;
    for (const Answer& answer : answers) {
        given_up += !answer.answered;
        stretches += answer.stretches.size();
    }
    std::printf("%s: %zu stretches, %zu rays given up; %.4g ms, %.4g us a ray\n", method.name.c_str(), stretches,
                given_up, 1e3 * seconds, 1e6 * seconds / static_cast<double>(job.rays.size()));
    if (!method.knob.empty()) std::printf("  %s: %g\n", method.knob.c_str(), options.knob);
    for (const auto& [name, value] : figures) std::printf("  %s: %.6g\n", name.c_str(), value);
    if (!arguments.compare) return Status::ok;
    if (method.on_device) print_own_times(job, options);
    const std::size_t different = compare(job, options, answers);
    std::printf("%zu of %zu rays have other regions than the reference\n", different, job.rays.size() - given_up);
    return method.exact && different ? Status::differs : Status::ok;
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("csgrt_methods", [&] {
        if (argc == 1) {
            list_methods();
            return 0;
        }
        if (std::string(argv[1]) != "run")
            throw Error(Status::usage, std::string(argv[1]) +
                                           ": unknown; csgrt_methods alone lists the methods, and "
                                           "`csgrt_methods run NAME SCENE` runs one");
        return static_cast<int>(run(parse(argc, argv)));
    });
}
