// csgrt_judge_pov: POV-Ray's pictures before csgrt's judge, and its times beside csgrt's; one JSON file.
//
//   csgrt_judge_pov [--workloads A,B] [--models FOLDER] [--scenes FOLDER] [--rays N] [--size N] [--rounds N]
//                   [--threads N] [--keep FOLDER] [--json FILE] [--planted]
//
// A workload of the chart (bench/chart) is written for POV-Ray, each region in a colour of its own, without light. Two
// pictures are drawn: a small one, whose pixels are the chart's judged rays (--rays, about), and one of --size pixels,
// which is timed: POV-Ray's own "Trace Time" with the faster of its two ways to bound objects, and csgrt's warm frame
// of first hits, in turn. --planted: every difference is written as a union, which the judge must see.
//
// The file is a report of the chart's kind with one row a workload: wrong pixels of the decided ones, nanoseconds a
// ray. Pixels tell no distances, so there are no ends. Without povray: skipped.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <csgrt/csgrt.hpp>

#include "bench/chart/report.hpp"
#include "bench/chart/tasks.hpp"
#include "bench/chart/truth.hpp"
#include "bench/program.hpp"
#include "compile/flatten/flatten.hpp"
#include "compile/frame.hpp"
#include "compile/linear.hpp"
#include "compile/solids/polyhedron.hpp"
#include "scene/vector.hpp"

namespace {

using namespace csgrt;
using namespace csgrt::bench;

constexpr const char* program = "POV-Ray 3.7";

struct Options {
    Sample sample{"../shared/brlcad", "scenes", 2000, {"boolean-ops", "operators", "tank_car"}};
    int size = 512, rounds = 3, threads = 2;
    bool planted = false;
    std::string folder, json = "pov.json";
};

// ---- The scene in POV-Ray's words ----

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}
std::string vector(const Vec3& v) { return "<" + number(v.x) + "," + number(v.y) + "," + number(v.z) + ">"; }
std::string columns(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& from) {
    const auto three = [](const Vec3& v) { return number(v.x) + "," + number(v.y) + "," + number(v.z); };
    return " matrix<" + three(x) + "," + three(y) + "," + three(z) + "," + three(from) + ">";
}
std::string matrix_of(const Matrix& m) {
    return columns({m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]});
}
std::string plane(const Plane& p) { return "plane{" + vector(p.normal) + "," + number(p.distance) + "}"; }
/// a x^2 + b y^2 + c z^2 + d z + e < 0
std::string quadric(double a, double b, double c, double d, double e) {
    return "quadric{" + vector({a, b, c}) + ",<0,0,0>," + vector({0, 0, d}) + "," + number(e) + "}";
}
/// What POV-Ray cannot bound by itself.
std::string bounded(const std::string& parts, const Box& box) {
    // A box of no thickness is none to POV-Ray.
    const double pad = 1e-6 * largest_coordinate(box);
    const Vec3 by{pad, pad, pad};
    return "intersection{" + parts +
           (is_finite(box) ? " bounded_by{box{" + vector(box.low - by) + "," + vector(box.high + by) + "}}" : "") + "}";
}

/// One placed solid.
struct InPov {
    const Matrix& matrix;
    const Box& box;  ///< in the world

    std::string local(const std::string& what, const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& from) const {
        return "object{" + what + columns(x, y, z, from) + matrix_of(matrix) + "}";
    }
    /// The same, cut by planes; `parts` and planes in local coordinates.
    std::string cut(const std::string& parts, const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& from) const {
        return bounded("object{intersection{" + parts + "}" + columns(x, y, z, from) + matrix_of(matrix) + "}", box);
    }
    [[noreturn]] static void refuse(const std::string& what) { throw Error(Status::usage, "POV-Ray: no " + what); }

    std::string operator()(const Ell& s) const { return local("sphere{<0,0,0>,1}", s.a, s.b, s.c, s.v); }
    std::string operator()(const Tgc& s) const {
        const double top = length(s.c) / length(s.a), other = length(s.d) / length(s.b);
        if (!std::isfinite(top) || !std::isfinite(other)) refuse("tgc whose base is an edge");
        if (top == other && top == 1) return local("cylinder{<0,0,0>,<0,0,1>,1}", s.a, s.b, s.h, s.v);
        if (std::abs(top - other) < 1e-12 * std::max(top, 1.0))
            return local("cone{<0,0,0>,1,<0,0,1>," + number(top) + "}", s.a, s.b, s.h, s.v);
        // x^2 (1 + b z)^2 + y^2 (1 + a z)^2 - (1 + a z)^2 (1 + b z)^2 < 0
        const double a = top - 1, b = other - 1, sum = a + b, product = a * b;
        std::string all = "polynomial{4";
        const auto term = [&](const char* powers, double factor) {
            all += std::string(",xyz(") + powers + "):" + number(factor);
        };
        term("2,0,0", 1);
        term("2,0,1", 2 * b);
        term("2,0,2", b * b);
        term("0,2,0", 1);
        term("0,2,1", 2 * a);
        term("0,2,2", a * a);
        term("0,0,0", -1);
        term("0,0,1", -2 * sum);
        term("0,0,2", -(sum * sum + 2 * product));
        term("0,0,3", -2 * sum * product);
        term("0,0,4", -product * product);
        return cut(all + " sturm} plane{<0,0,1>,1} plane{<0,0,-1>,0}", s.a, s.b, s.h, s.v);
    }
    std::string operator()(const Tor& s) const {  // its axis is y there
        const Vec3 y = unit(s.h), x = unit(cross(y, std::abs(y.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
        return local("torus{" + number(s.r_a) + "," + number(s.r_h) + "}", x, y, cross(x, y), s.v);
    }
    std::string operator()(const Half& s) const { return plane(transform_plane(matrix, s.plane)); }
    std::string planes(const std::vector<Plane>& faces) const {
        std::string all;
        for (const Plane& face : faces) all += plane(face);
        return bounded(all, box);
    }
    std::string operator()(const Arb& s) const { return planes(arb_faces(s, matrix).planes); }
    std::string operator()(const Arbn& s) const { return planes(arbn_faces(s, matrix)); }
    std::string operator()(const Epa& s) const {
        return cut(quadric(1, 1, 0, 1, -1) + "plane{<0,0,-1>,0}", s.r_1 * unit(s.a), s.r_2 * unit(cross(s.h, s.a)), s.h,
                   s.v);
    }
    /// z is the depth below the vertex: x^2 + y^2 = k (z^2 + 2 c z)
    std::string operator()(const Ehy& s) const {
        const double c = s.c / length(s.h), k = 1 / (1 + 2 * c);
        return cut(quadric(1, 1, -k, -2 * c * k, 0) + "plane{<0,0,1>,1} plane{<0,0,-1>,0}", s.r_1 * unit(s.a),
                   s.r_2 * unit(cross(s.h, s.a)), -1 * s.h, s.v + s.h);
    }
    std::string operator()(const Hyp& s) const {
        const double neck = s.neck * s.neck;
        return cut(quadric(1, 1, neck - 1, 0, -neck) + "plane{<0,0,1>,1} plane{<0,0,-1>,1}", s.a,
                   s.b * unit(cross(s.h, s.a)), 0.5 * s.h, s.v + 0.5 * s.h);
    }
    std::string operator()(const Rpc& s) const {
        return cut(quadric(0, 1, 0, 1, -1) + "plane{<0,0,-1>,0} plane{<1,0,0>,1} plane{<-1,0,0>,1}", 0.5 * s.h,
                   s.r * unit(cross(s.h, s.b)), s.b, s.v + 0.5 * s.h);
    }
    template <class Other>
    std::string operator()(const Other& s) const {
        refuse(type_name(Shape(s)));
    }
};

std::string colour(std::uint32_t region) {  // 0 is the background
    const std::uint32_t n = region + 1;
    const auto level = [&](int shift) { return (static_cast<double>(n >> shift & 255) + 0.25) / 255; };
    return vector({level(16), level(8), level(0)});
}

class PovScene {
public:
    PovScene(const Task& task, const CompiledScene& compiled, bool planted)
        : task_(task),
          compiled_(compiled),
          planted_(planted),
          flat_(flatten(task.scene, task.objects.empty() ? top_objects(task.scene) : task.objects, false)) {
        if (flat_.regions.size() != compiled.regions.size())
            throw Error(Status::usage, "POV-Ray: a scene with solids that are left out because of their places");
        for (std::uint32_t i = 0; i < flat_.regions.size(); ++i)
            regions_ += "object{" + region(i) + " pigment{rgb" + colour(i) + "}}\n";
    }

    std::string text(int size) const {
        View view;
        view.camera = task_.scene.camera;
        view.camera.perspective = 0;
        view.width = view.height = size;
        const kernel::Frame f = prepare_frame(compiled_, view, -1).frame;
        const auto vec = [](const double(&v)[3], double times) {
            return vector({times * v[0], times * v[1], times * v[2]});
        };
        return "#version 3.7;\nglobal_settings{assumed_gamma 1 max_trace_level 1}\nbackground{rgb 0}\n"
               "#default{finish{ambient 1 diffuse 0}}\ncamera{orthographic location " +
               vec(f.eye, 1) + " direction " + vec(f.w, 1) + " right " + vec(f.u, size) + " up " + vec(f.v, size) +
               "}\n" + regions_;
    }

private:
    std::string region(std::uint32_t number) const {
        std::vector<std::string> operands;
        const auto& nodes = flat_.regions[number].tree.nodes;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i].op == Operator::leaf) {
                // The compiled tree is the same one, with the numbers of solids that have boxes.
                operands.push_back(leaf(nodes[i].solid, compiled_.flat_trees[number].nodes[i].solid));
                continue;
            }
            std::vector<std::string> mine(operands.end() - nodes[i].arity, operands.end());
            operands.resize(operands.size() - nodes[i].arity);
            const Operator op = planted_ && nodes[i].op == Operator::difference ? Operator::union_ : nodes[i].op;
            if (op == Operator::not_) {
                operands.push_back("object{" + mine[0] + " inverse}");
            } else if (op == Operator::xor_) {
                std::string all = mine[0];
                for (std::size_t k = 1; k < mine.size(); ++k)
                    all = "union{difference{" + all + mine[k] + "}difference{" + mine[k] + all + "}}";
                operands.push_back(all);
            } else if (mine.size() == 1) {
                operands.push_back(mine[0]);
            } else {
                std::string all = op == Operator::union_         ? "union{"
                                  : op == Operator::intersection ? "intersection{"
                                                                 : "difference{";
                for (const std::string& one : mine) all += one + "\n";
                operands.push_back(all + "}");
            }
        }
        if (operands.empty()) throw Error(Status::usage, "POV-Ray: an empty region");
        return operands.back();
    }

    std::string leaf(std::uint32_t number, std::uint32_t solid) const {
        const Instance& instance = flat_.instances[number];
        const Shape& shape = shape_of(task_.scene, flat_, instance);
        const InPov in_pov{*instance.matrix, compiled_.solid_boxes[solid]};
        std::string text = std::visit(in_pov, static_cast<const Shape::variant&>(shape));
        const std::vector<Plane>& cuts = cuts_of(flat_, instance);
        if (cuts.empty()) return text;
        for (const Plane& p : cuts) text += plane(transform_plane(*instance.matrix, p));
        return bounded(text, in_pov.box);
    }

    const Task& task_;
    const CompiledScene& compiled_;
    bool planted_;
    FlatScene flat_;
    std::string regions_;
};

// ---- Its program ----

/// Draws scene.pov as scene.ppm and returns "Trace Time" in milliseconds.
double draw(const std::string& folder, const std::string& text, int size, int threads, int bounding) {
    std::ofstream(folder + "/scene.pov") << text;
    const std::string size_text = std::to_string(size);
    const std::string command =
        "cd '" + folder + "' && povray +Iscene.pov +Oscene.ppm +FP8 -A -D -V +Q1 File_Gamma=1 +W" + size_text + " +H" +
        size_text + " +WT" + std::to_string(threads) + " +BM" + std::to_string(bounding) + " >told.txt 2>&1";
    const int status = std::system(command.c_str());
    std::ifstream in(folder + "/told.txt");
    std::string told((std::istreambuf_iterator<char>(in)), {});
    const std::size_t at = told.find("Trace Time:"), open = told.find('(', at);
    if (status != 0 || at == told.npos || open == told.npos)
        throw Error(Status::usage,
                    "povray fails: " + told.substr(told.size() - std::min<std::size_t>(told.size(), 600)));
    return 1000 * std::atof(told.c_str() + open + 1);
}

/// Regions by pixel, from the top left; Stretch::gap: none.
std::vector<std::uint32_t> regions_in(const std::string& path, int size) {
    std::ifstream in(path, std::ios::binary);
    std::string kind, comment;
    int width = 0, height = 0, most = 0;
    in >> kind >> std::ws;
    while (in.peek() == '#') std::getline(in, comment);
    in >> width >> height >> most;
    in.get();
    std::vector<unsigned char> bytes(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 3);
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (kind != "P6" || width != size || height != size || most != 255 || !in)
        throw Error(Status::file, path + ": not such a picture as was asked for");
    std::vector<std::uint32_t> regions;
    for (std::size_t i = 0; i < bytes.size(); i += 3)
        regions.push_back((std::uint32_t{bytes[i]} << 16 | std::uint32_t{bytes[i + 1]} << 8 | bytes[i + 2]) - 1);
    return regions;
}

/// `ours`: csgrt's own row, timed in turn with POV-Ray's. Its rays are not judged.
Row judge(const ChartWorkload& workload, const Options& options, Row& ours) {
    Row row;
    row.mode = Mode::first_hits;
    row.variant = row.method = program;
    row.laboratory = true;
    row.workload = workload.name;
    row.family = workload.family;
    ours = row;
    ours.variant = ours.method = "default";
    ours.laboratory = false;
    const Task& task = workload.tasks.front();
    const CompiledScene compiled = compile(task.scene, task.objects);
    try {
        const PovScene scene(task, compiled, options.planted);
        const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(task.rays.size()))));
        draw(options.folder, scene.text(side), side, options.threads, 2);
        const std::vector<std::uint32_t> regions = regions_in(options.folder + "/scene.ppm", side);
        const std::vector<TrueRay> truth = true_rays(task.scene, task.objects, task.rays);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            // A picture tells the region alone, so no distance is judged: the true one stands for it.
            const auto& sequence = truth[i].sequence;
            const bool hits = regions[i] != Stretch::gap;
            Stretch seen{regions[i], 1, 2};
            if (!sequence.empty()) seen = {regions[i], sequence.front().in, sequence.front().out};
            row.accuracy.add(truth[i], hits ? Sequence{seen} : Sequence{}, Mode::first_hits);
        }

        Settings settings;
        settings.device = "cpu";
        settings.threads = static_cast<unsigned>(options.threads);
        Renderer renderer(task.scene, task.objects, settings);
        View view;
        view.camera = task.scene.camera;
        view.camera.perspective = 0;
        view.width = view.height = options.size;
        view.every_partition = false;
        view.channels = channel::ids | channel::distance;
        renderer.render(view);  // it takes memory
        std::vector<double> theirs[2], frames;
        for (int i = 0; i < options.rounds; ++i) {
            for (int bounding = 1; bounding <= 2; ++bounding)
                theirs[bounding - 1].push_back(
                    draw(options.folder, scene.text(options.size), options.size, options.threads, bounding));
            renderer.render(view);
            frames.push_back(renderer.statistics().ms.frame);
        }
        const double pixels = static_cast<double>(options.size) * options.size;
        const auto time = [&](Row& timed, const std::vector<double>& ms) {
            timed.frame_ms = quantile(ms, 0.5);
            timed.ns_per_ray = 1e6 * timed.frame_ms / pixels;
            timed.ns = median_interval(ms);
            timed.ns.low *= 1e6 / pixels;
            timed.ns.high *= 1e6 / pixels;
        };
        time(row, quantile(theirs[0], 0.5) < quantile(theirs[1], 0.5) ? theirs[0] : theirs[1]);
        time(ours, frames);
    } catch (const Error& error) {
        row.error = error.what();
    }
    return row;
}

Options parse(int argc, char** argv) {
    Options o;
    OptionReader options;
    options.list("--workloads", o.sample.only);
    options.text("--models", o.sample.models);
    options.text("--scenes", o.sample.scenes);
    options.number("--rays", o.sample.rays, 1, 1'000'000);
    options.number("--size", o.size, 1, 1'000'000);
    options.number("--rounds", o.rounds, 1, 1'000'000);
    options.number("--threads", o.threads, 1, 1'000'000);
    options.text("--keep", o.folder);
    options.text("--json", o.json);
    options.flag("--planted", o.planted);
    options.read(argc, argv);
    return o;
}

}  // namespace

int main(int argc, char** argv) {
    return run_program("csgrt_judge_pov", [&] {
        Options options = parse(argc, argv);
        if (std::system("povray --version >/dev/null 2>&1") != 0) {
            std::puts("skipped: there is no povray (Debian: apt-get install povray)");
            return 0;
        }
        const bool is_kept = !options.folder.empty();
        if (!is_kept) {
            std::string name = (std::filesystem::temp_directory_path() / "csgrt-pov-XXXXXX").string();
            if (!mkdtemp(name.data())) throw Error(Status::file, name + ": cannot be made");
            options.folder = name;
        }
        std::filesystem::create_directories(options.folder);
        Report report{"processors", "cpu", version(), options.size, options.rounds, options.sample.rays, 0, {}, {}, {}};
        Method& pov = report.methods.emplace_back();
        pov.name = program;
        pov.source = "www.povray.org";
        pov.about = "A picture without light, each region in a colour of its own.";
        pov.breaks = "No family was named beforehand.";
        for (const WorkloadMaker& workload : chart_workloads(options.sample)) {
            Row ours;
            const Row row = judge(workload.make(), options, ours);
            report.rows.push_back(ours);
            report.rows.push_back(row);
            if (!row.error.empty())
                std::printf("%-16s %s\n", row.workload.c_str(), row.error.c_str());
            else
                std::printf(
                    "%-16s %zu wrong of %zu decided pixels, %zu ties, %zu rule; %.0f ns a ray, csgrt %.0f, "
                    "ratio %.1f\n",
                    row.workload.c_str(), row.accuracy.wrong, row.accuracy.decided, row.accuracy.ties,
                    row.accuracy.rule, row.ns_per_ray, ours.ns_per_ray, row.ns_per_ray / ours.ns_per_ray);
            std::fflush(stdout);
        }
        if (!is_kept) std::filesystem::remove_all(options.folder);
        if (report.rows.empty()) throw Error(Status::usage, "there is no workload to judge");
        write_whole(to_json(report), options.json);
        return 0;
    });
}
