#include "arguments.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "described.hpp"
#include "help_notes.hpp"
#include "options.hpp"
#include "values.hpp"
#include "form/check.hpp"
#include "form/measure.hpp"

namespace csgrt::cli {

namespace {

constexpr const char* scene_help =
    "scene file: .json, .g or .asc; - is standard input, whose first bytes tell the format";
constexpr std::pair<std::string_view, const char*> formats[] = {{"exr", "exr"}, {"png", "png"}};
constexpr std::pair<std::string_view, RowFormat> row_formats[] = {
    {"text", RowFormat::text}, {"csv", RowFormat::csv}, {"binary", RowFormat::binary}, {"npy", RowFormat::npy}};
constexpr std::uint64_t most_sampled = 10'000'000;  ///< the rays of a sample are all in memory; a file may hold more
constexpr double unlimited = std::numeric_limits<double>::infinity();

[[noreturn]] void fail(std::string message, std::string suggestion) {
    throw Error(Status::usage, {Diagnostic{{}, std::move(message), std::move(suggestion), {}}});
}

void define_scene(Options& options, SceneArguments& arguments) {
    options.argument("SCENE", scene_help, arguments.scene);
    options.arguments("OBJECT", "objects of the scene, or paths to them (all.g/tor.r); its top objects if not given",
                      arguments.objects);
    define_members(options, arguments.settings, form::Concern::model);
    define_members(options, arguments.load, form::Concern::model);
}

void define_settings(Options& options, Settings& settings) {
    define_members(options, settings, form::Concern::work);
    auto parse_tolerance = [&settings](const std::string& text) {
        auto rule = find_name(tolerance_names, text);
        auto length = parse_number(text);
        if (length && *length >= 0) {
            settings.tolerance = *length;
            rule = Tolerance::length;
        }
        return rule;
    };
    auto& tolerance = options.value(
        "--tolerance", "MM|surfaces|relative|none",
        "which ends of segments along a ray are one; MM: those closer than that; surfaces: those on one "
        "surface; relative: those closer than 1e-9 of the scene's size (1e-6 in single precision); none: only "
        "equal ones; the scene's, or surfaces, if not given",
        settings.tolerance_rule, parse_tolerance,
        "a length in millimetres, 0 or more, 'surfaces', 'relative' or 'none'");
    for (const auto& entry : tolerance_names) tolerance.words.push_back(entry.first);
}

/// Defines the options of commands that compute either on a device or on the reference.
void define_either(Options& options, Settings& settings) {
    define_settings(options, settings);
    define_members(options, settings, form::Concern::either);
}

Option& define_size(Options& options, int& width, int& height) {
    auto parse_sides = [&height](const std::string& text) {
        auto size = parse_size(text);
        if (size) height = size->second;
        return size ? std::optional(size->first) : std::nullopt;
    };
    return options.value("--size", "N|WxH", "pixels, one side or width and height; 1024 if not given", width,
                         parse_sides,
                         "a size such as 1024 or 1920x1080, each side from 1 to " + std::to_string(max_side));
}

/// Defines the options of looks. All go into one list in their order, because the last look of a region counts.
void define_looks(Options& options, std::vector<Look>& looks) {
    const auto state = [&](const char* name, const char* help, State value) {
        options.each(
            name, "PATH", help, looks,
            [value](const std::string& path) {
                return path.starts_with('/') ? std::optional(Look{.path = path, .state = value}) : std::nullopt;
            },
            "the path of a region, or its beginning, as 'csgrt info --json' lists them");
    };
    state("--hide", "do not draw the region of that path, nor those below it; may be given several times",
          State::hidden);
    state("--show", "draw them, after a --hide of more; of options about one region the last counts", State::shown);
    options.each("--color", "PATH:R,G,B", "give them that colour, display values from 0 to 1", looks, parse_look_color,
                 "a path and three numbers from 0 to 1, such as /all/wheel.r:1,0.5,0");
}

void define(Options& options, RenderArguments& arguments) {
    define_scene(options, arguments);
    auto& output = options.list(
        "--output", "FILE",
        "picture to write, FILE.exr (every channel) or FILE.png; - is standard output; may be given several times",
        arguments.outputs);
    output.letter = 'o';
    options.choice("--format", "format on standard output, a device or a pipe; exr if not given", arguments.format,
                   formats);
    define_size(options, arguments.picture.width, arguments.picture.height);
    define_members(options, arguments.picture.camera, form::Concern::picture, [&](const auto& member, Option& option) {
        option.accept = [accept = option.accept, &arguments, name = std::string(member.key.member)](const auto& text) {
            arguments.given.insert(name);
            return accept(text);
        };
    });
    options.text("--view", "FILE",
                 "view as MGED's saveview writes it: viewsize, orientation and eye_pt; databases hold no views",
                 arguments.view);
    define_members(options, arguments.picture, form::Concern::picture);
    define_looks(options, arguments.looks);
    define_members(options, arguments.settings, form::Concern::picture);
    define_either(options, arguments.settings);
    options.text("--stats", "FILE",
                 "write the figures of the frame as JSON, times in milliseconds; - is standard output",
                 arguments.stats);
    options.count("--repeat",
                  "render N frames; the figures are medians without the first frame (add --wait-for-device for a GPU)",
                  arguments.repeat, 1, 1'000'000);
}

void define(Options& options, ViewArguments& arguments) {
    define_scene(options, arguments);
    options.flag("--open", "open the page in the desktop's browser, too", arguments.open);
    options.count("--port", "port to listen on; any that is free if not given", arguments.port, 1, 65'535);
    options.text("--address", "ADDRESS",
                 "address of the interface to listen on; 127.0.0.1, which no other machine reaches, if not given",
                 arguments.address);
    define_settings(options, arguments.settings);
}

void define(Options& options, ShootArguments& arguments) {
    define_scene(options, arguments);
    auto parse_rays = [&arguments](const std::string& text) {
        constexpr std::string_view grid = "grid:";
        if (!text.starts_with(grid)) return text.empty() ? std::nullopt : std::optional(text);
        arguments.grid = parse_grid(std::string_view(text).substr(grid.size()));
        return arguments.grid ? std::optional(std::string()) : std::nullopt;
    };
    options
        .value("--rays", "FILE|grid:AXIS:N",
               "file of rays, one a line: ox oy oz dx dy dz (# begins a comment); - is standard input; or N by N rays "
               "along the axis x, y or z that cover the model's box",
               arguments.rays, parse_rays,
               "a file, or a grid such as grid:x:512, of 1 to " + std::to_string(max_side) + " rays each way")
        .required = true;
    const auto bound = [&options](const char* name, const char* help, std::optional<double>& target) {
        options.value(name, "T", help, target, parse_bound, "a number, inf or -inf");
    };
    bound("--near", "where rays begin, in lengths of their directions, as in and out; 0 if not given", arguments.near);
    bound("--far", "where rays end; inf if not given", arguments.far);
    options.choice("--format", "format of the partitions; text if not given", arguments.format, row_formats);
    auto& output = options.text("--output", "FILE", "where to write the partitions; standard output if not given",
                                arguments.output);
    output.letter = 'o';
    define_either(options, arguments.settings);
}

void define(Options& options, SampleArguments& arguments) {
    define_scene(options, arguments);
    options.text("--points", "FILE", "file of points, one a line: x y z (# begins a comment); - is standard input",
                 arguments.points);
    options
        .value("--plane", "AXIS:OFFSET",
               "plane across the axis x, y or z at OFFSET mm; NX,NY,NZ:OFFSET: the points p with n . p = OFFSET, n "
               "being the unit vector of NX,NY,NZ",
               arguments.plane, parse_plane, "a plane such as z:2.5 or 1,0,1:2.5")
        .excludes = "--points";
    define_size(options, arguments.width, arguments.height).excludes = "--points";
    auto& output = options.text("--output", "FILE",
                                "FILE.npy, FILE.csv, or of a plane FILE.png; CSV on standard output if not given",
                                arguments.output);
    output.letter = 'o';
    define_either(options, arguments.settings);
}

void define(Options& options, VerifyArguments& arguments) {
    define_scene(options, arguments);
    auto parse_rays = [&arguments](const std::string& text) {
        auto number = parse_count(text);
        if (auto value = parse_number(text);
            !number && value && *value >= 0 && *value <= most_sampled && *value == std::floor(*value))
            number = static_cast<std::uint64_t>(*value);  // for example 1e6
        if (!number) return text.empty() ? std::nullopt : std::optional(text);
        arguments.count = static_cast<std::size_t>(*number);
        return *number >= 1 && *number <= most_sampled ? std::optional(std::string()) : std::nullopt;
    };
    options.value("--rays", "N|FILE",
                  "number of rays to sample, half of a view and half random; or a file of rays as 'csgrt shoot' reads "
                  "them; 10000 if not given",
                  arguments.rays, parse_rays,
                  "a number of rays from 1 to " + std::to_string(most_sampled) + ", or a file");
    options.count("--seed", "seed of the random rays; 1 if not given", arguments.seed, 0,
                  std::numeric_limits<std::uint64_t>::max());
    options.text("--json", "FILE", "write the result as JSON; - is standard output, instead of the table",
                 arguments.json);
    define_settings(options, arguments.settings);
}

void define_json(Options& options, std::string& file) {
    options.text("--json", "FILE", "write all figures as JSON; - is standard output, instead of the table", file);
}

void define(Options& options, MeasureArguments& arguments) {
    define_scene(options, arguments);
    define_members(options, arguments.request, form::Concern::work);
    options.text("--densities", "FILE",
                 "densities of materials: on each line a number of a material or a path, g/cm^3, a name; those of the "
                 "scene (BRL-CAD's _DENSITIES) if not given",
                 arguments.densities);
    options.count("--depth", "levels of the tree in the table; 2 if not given", arguments.depth, 0, Limits::nesting);
    define_json(options, arguments.json);
    options.text("--csv", "FILE", "write all figures as CSV, a line for each part; - is standard output, likewise",
                 arguments.csv);
    options.list(
        "--grid-output", "FILE",
        "write the volumes in the cells of --grid, by the suffix as arrays for NumPy (.npz) or as an image for "
        "VTK (.vti); may be given several times",
        arguments.cells);
    define_either(options, arguments.settings);
}

void define(Options& options, CheckArguments& arguments) {
    define_scene(options, arguments);
    define_members(options, arguments.request, form::Concern::work);
    options.text("--allow", "FILE",
                 "overlaps that are allowed: on each line two patterns of paths; * stands for any characters, and # "
                 "begins a comment",
                 arguments.allow);
    define_json(options, arguments.json);
    options.text("--junit", "FILE", "write a report for CI as JUnit's XML; - is standard output, likewise",
                 arguments.junit);
    options.text(
        "--write-rays", "FILE",
        "write for each overlap a ray that shows it, as 'csgrt shoot' reads it; - is standard output, likewise",
        arguments.rays);
    define_either(options, arguments.settings);
}

void define(Options& options, CompareArguments& arguments) {
    options.argument("A", "EXR picture, or partitions that 'csgrt shoot' wrote", arguments.first);
    options.argument("B", "another file of the same kind", arguments.second);
    options.number("--tolerance", "X",
                   "count only differences beyond X; in files of partitions X is a distance, and normals and solids do "
                   "not count; every bit counts if not given",
                   arguments.tolerance, 0, unlimited, "a number, 0 or more");
}

void define(Options&, DevicesArguments&) {}

void define(Options& options, InfoArguments& arguments) {
    define_scene(options, arguments);
    options.count("--depth", "levels of the tree to show; 2 if not given", arguments.depth, 0, Limits::nesting);
    options.flag("--json", "print one JSON object instead, without the tree", arguments.json);
}

void define(Options& options, ConvertArguments& arguments) {
    options.argument("IN", scene_help, arguments.input);
    options.argument("OUT", "FILE.json to write; - is standard output", arguments.output);
    define_members(options, arguments.load, form::Concern::model);
}

struct Entry {
    const char* name;
    const char* usage;
    const char* purpose;
    const char* notes;
    Command (*parse)(const Entry&, const std::vector<std::string>&);
    std::string (*options)();
};

template <class Arguments>
Command parse_entry(const Entry& entry, const std::vector<std::string>& words) {
    Options options;
    Arguments arguments;
    define(options, arguments);
    auto findings = options.parse(words);
    if (options.help_wanted()) return TextArguments{help_text(entry.name)};
    if (findings.empty()) return arguments;
    std::string& suggestion = findings.back().suggestion;
    if (!suggestion.empty()) suggestion += '\n';
    suggestion += std::string("'csgrt help ") + entry.name + "' lists the options";
    throw Error(Status::usage, std::move(findings));
}

template <class Arguments>
std::string entry_options() {
    Options options;
    Arguments arguments;
    define(options, arguments);
    return options.help();
}

template <class Arguments>
constexpr Entry entry(const char* name, const char* usage, const char* purpose, const char* notes) {
    return {name, usage, purpose, notes, parse_entry<Arguments>, entry_options<Arguments>};
}

constexpr Entry entries[] = {
    entry<RenderArguments>("render", "csgrt [render] SCENE [OBJECT...] -o FILE",
                           "render a scene, as FILE.exr or FILE.png", render_notes),
    entry<ViewArguments>("view", "csgrt view SCENE [OBJECT...]", "show a scene in a browser", view_notes),
    entry<ShootArguments>("shoot", "csgrt shoot SCENE [OBJECT...] --rays FILE", "list the partitions along given rays",
                          shoot_notes),
    entry<SampleArguments>("sample", "csgrt sample SCENE [OBJECT...] --plane z:0", "tell which region holds points",
                           sample_notes),
    entry<VerifyArguments>("verify", "csgrt verify SCENE [OBJECT...]", "judge a scene's answers by 113-bit ones",
                           verify_notes),
    entry<MeasureArguments>("measure", "csgrt measure SCENE [OBJECT...]",
                            "volumes, masses, areas, moments, with errors", measure_notes),
    entry<CheckArguments>("check", "csgrt check SCENE [OBJECT...]", "find regions that overlap", check_notes),
    entry<CompareArguments>("compare", "csgrt compare A B", "compare two pictures, or two files of partitions",
                            compare_notes),
    entry<DevicesArguments>("devices", "csgrt devices", "list the devices", devices_notes),
    entry<InfoArguments>("info", "csgrt info SCENE [OBJECT...]", "show what a scene holds", info_notes),
    entry<ConvertArguments>("convert", "csgrt convert IN OUT.json", "rewrite a scene as JSON", convert_notes),
};
constexpr const Entry& render_entry = entries[0];  ///< the command's name may be left out

const Entry* find_entry(const std::string& name) {
    auto found = std::find_if(std::begin(entries), std::end(entries), [&](const Entry& e) { return name == e.name; });
    return found == std::end(entries) ? nullptr : found;
}

std::string nearest_command(const std::string& word) {
    std::vector<std::string_view> names = {"help"};
    for (const Entry& entry : entries) names.emplace_back(entry.name);
    return suggestion(word, names);
}

std::string overview() {
    std::string text;
    auto row = [&text](std::string line, const char* purpose) {
        line.resize(42, ' ');
        text += "  " + line + "  " + purpose + "\n";
    };
    for (const Entry& entry : entries) row(entry.usage, entry.purpose);
    row("csgrt help [COMMAND]", "list the options of a command");
    row("csgrt --version", "print the version");
    return text;
}

std::string options_and_notes(const Entry& entry) { return "\n" + entry.options() + entry.notes + exit_status; }

}  // namespace

std::string help_text(const std::string& command) {
    if (command.empty())
        return "csgrt: exact ray tracing of Constructive Solid Geometry\n\n" + overview() + "\nTo render a scene:\n" +
               options_and_notes(render_entry);
    if (const Entry* entry = find_entry(command)) return std::string(entry->usage) + "\n" + options_and_notes(*entry);
    std::string near = nearest_command(command);
    fail("no command '" + command + "'", near.empty() ? "'csgrt --help' lists the commands" : near);
}

Command parse_arguments(const std::vector<std::string>& words) {
    if (words.empty()) fail("no scene and no command", overview());
    const std::string& first = words[0];
    if (first == "--version") return TextArguments{std::string("csgrt ") + version() + "\n"};
    if (first == "--help" || first == "-h") return TextArguments{help_text("")};
    if (first == "help") return TextArguments{help_text(words.size() > 1 ? words[1] : "")};
    if (const Entry* entry = find_entry(first)) return entry->parse(*entry, {words.begin() + 1, words.end()});

    std::error_code ignored;
    bool may_be_command = first.find_first_of("-./") == first.npos && !std::filesystem::exists(first, ignored);
    if (std::string near = nearest_command(first); may_be_command && !near.empty())
        fail("no command and no file '" + first + "'", near);
    return render_entry.parse(render_entry, words);
}

}  // namespace csgrt::cli
