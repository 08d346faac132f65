#include "arguments.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "options.hpp"
#include "values.hpp"

namespace csgrt::cli {

namespace {

constexpr std::pair<std::string_view, bool> on_off[] = {{"on", true}, {"off", false}};
constexpr const char* scene_help =
    "scene file: .json, .g or .asc; - is standard input, whose first bytes tell the format";
constexpr std::pair<std::string_view, const char*> formats[] = {{"exr", "exr"}, {"png", "png"}};
constexpr std::uint64_t most_sampled = 10'000'000;  ///< rays are kept in memory; a file may hold more
constexpr double unlimited = std::numeric_limits<double>::infinity();

[[noreturn]] void fail(std::string message, std::string suggestion) {
    throw Error(Status::usage, {Diagnostic{{}, std::move(message), std::move(suggestion), {}}});
}

void define_strict(Options& options, bool& strict) {
    options.flag("--strict", "refuse a .g or .asc with anything missing or broken in it, which is left out else, with a warning",
                 strict);
}

void define_scene(Options& options, SceneArguments& arguments) {
    options.argument("SCENE", scene_help, arguments.scene);
    options.arguments("OBJECT", "objects of the scene, or paths to them (all.g/tor.r); without any, its top objects",
                      arguments.objects);
    options.flag("--air", "keep air regions", arguments.settings.air);
    define_strict(options, arguments.strict);
    options.flag("--skip-unsupported",
                 "leave out solids of types that csgrt does not know, and say which; with a .g or .asc this is done anyway",
                 arguments.settings.skip_unsupported);
}

void define_settings(Options& options, Settings& settings) {
    auto& device = options.text(
        "--device", "NAME|cpu|gpu|N|gpus",
        "device: part of its name, its type, or its number in 'csgrt devices'; several, with commas, or all "
        "'gpus' share the work; not given: a GPU if there is one, else this processor",
        settings.device);
    device.excludes = "--reference";
    options.flag("--reference", "compute with the CPU reference in place of a device", settings.reference);
    options.count("--threads", "threads of the native device and of the reference; all cores if not given",
                  settings.threads, 1, 4096);
    options.value("--max-memory", "SIZE",
                  "device memory to use, bytes, or such as 512M or 2G (powers of 1024); a frame that needs more is split into tiles",
                  settings.max_memory, parse_memory, "a number of bytes such as 800000, 512M or 2G");
    auto parse_tolerance = [&settings](const std::string& text) {
        auto rule = find_name(tolerance_names, text);
        auto length = parse_number(text);
        if (length && *length >= 0) {
            settings.tolerance = *length;
            rule = Tolerance::length;
        }
        return rule;
    };
    auto& tolerance = options.value("--tolerance", "MM|surfaces|relative|none",
                  "ends of segments closer than this along the ray, mm, are one; surfaces: those on one surface; relative: closer than 1e-9 of the "
                  "scene's size (1e-6 in single precision); none: only equal ones; not given: the scene's, or surfaces",
                  settings.tolerance_rule, parse_tolerance,
                  "a length in millimetres, 0 or more, 'surfaces', 'relative' or 'none'");
    for (const auto& entry : tolerance_names) tolerance.words.push_back(entry.first);
    options.choice("--precision",
                   "of the geometry; single: relative to the eye; single-world: in the world's coordinates; double if "
                   "not given",
                   settings.precision, precision_names);
    options.choice("--quartic", "how quartics (tori, ...) are solved; bracketed if not given", settings.quartic,
                   quartic_names);
}

/// Of commands that compute either on a device or on the reference.
void define_either(Options& options, Settings& settings) {
    define_settings(options, settings);
    auto& contraction = options.choice(
        "--contraction", "whether the device may round a product and a sum as one; results then differ; off if not given",
        settings.contraction, on_off);
    contraction.excludes = "--reference";
    auto& wait = options.flag(
        "--wait-for-device",
        "wait until a GPU has compiled its kernels; not given, the processor draws until then, with the same bits",
        settings.wait_for_device);
    wait.excludes = "--reference";
}

void define(Options& options, RenderArguments& arguments) {
    define_scene(options, arguments);
    auto& output = options.list(
        "--output", "FILE",
        "picture to write, FILE.exr (every channel) or FILE.png; - is standard output; may be given several times",
        arguments.outputs);
    output.letter = 'o';
    auto& format = options.choice(
        "--format", "format on standard output, a device or a pipe; exr if not given", arguments.format, formats);
    format.needs = "--output";
    auto parse_sides = [&arguments](const std::string& text) {
        auto size = parse_size(text);
        if (size) arguments.height = size->second;
        return size ? std::optional(size->first) : std::nullopt;
    };
    options.value("--size", "N|WxH", "pixels, one side or width and height; 1024 if not given", arguments.width, parse_sides,
                  "a size such as 1024 or 1920x1080, each side from 1 to " + std::to_string(max_side));
    options.number("--azimuth", "DEG", "where the eye is, from +x about z; the scene's, or 35, if not given",
                   arguments.azimuth, -unlimited, unlimited, "an angle in degrees");
    options.number("--elevation", "DEG", "where the eye is, upward; the scene's, or 25, if not given",
                   arguments.elevation, -unlimited, unlimited, "an angle in degrees");
    options.number("--perspective", "DEG", "angle of view, 0 is orthographic; the scene's, or 0, if not given",
                   arguments.perspective, 0, 180, "an angle in degrees, from 0 to less than 180");
    const auto vector = [&options](const char* name, const char* help, std::optional<Vec3>& target, const char* what) {
        options.value(name, "X,Y,Z", help, target, parse_vector,
                      std::string(what) + ": three numbers with commas between them, such as 10,0,-5");
    };
    vector("--center", "middle of the picture, in millimetres; the scene's, or the middle of the model's box, if not given",
           arguments.center, "a point");
    auto parse_length = [](const std::string& text) {
        auto number = parse_number(text);
        return number && *number > 0 ? number : std::nullopt;
    };
    options.value("--view-size", "MM",
                  "height of the picture at its middle; the scene's, or the diagonal of the model's box, if not given. Of a "
                  "parallel view it is a zoom: everything before the viewing plane is seen, and lit as in the whole picture",
                  arguments.view_size, parse_length, "a length in millimetres, greater than 0");
    vector("--eye",
           "where the eye stands, in place of azimuth and elevation; with a perspective it also gives the size of the view, "
           "without one, where there is no eye, only the direction, from there to the middle of the picture",
           arguments.eye, "a point");
    vector("--look-at", "what the eye looks at, the middle of the picture: another name of --center", arguments.look_at,
           "a point");
    vector("--up", "what points upward in the picture; +z if not given", arguments.up, "a direction");
    options.text("--view", "FILE",
                 "a view as MGED's saveview writes it: viewsize, orientation and eye_pt; databases themselves hold no views",
                 arguments.view);
    options.flag("--first-hit", "draw the first hits only, several times faster: no depth, partitions and overlap",
                 arguments.first_hit);
    define_either(options, arguments.settings);
    options.text("--stats", "FILE",
                 "write the figures of the frame as JSON, times in milliseconds; - is standard output", arguments.stats);
    options.count("--repeat",
                  "render N frames; the figures are medians without the first (of a GPU: with --wait-for-device)",
                  arguments.repeat, 1, 1'000'000);
}

void define(Options& options, ShootArguments& arguments) {
    define_scene(options, arguments);
    auto& rays =
        options.text("--rays", "FILE", "rays, one a line: ox oy oz dx dy dz (# begins a comment); - is standard input",
                     arguments.rays);
    rays.required = true;
    auto& output = options.text("--output", "FILE", "where to write the partitions; standard output if not given",
                                arguments.output);
    output.letter = 'o';
    define_either(options, arguments.settings);
}

void define(Options& options, VerifyArguments& arguments) {
    define_scene(options, arguments);
    auto parse_rays = [&arguments](const std::string& text) {
        auto number = parse_count(text);
        if (auto value = parse_number(text); !number && value && *value >= 0 && *value <= most_sampled &&
                                             *value == std::floor(*value))
            number = static_cast<std::uint64_t>(*value);  // 1e6
        if (!number) return text.empty() ? std::nullopt : std::optional(text);
        arguments.count = static_cast<std::size_t>(*number);
        return *number >= 1 && *number <= most_sampled ? std::optional(std::string()) : std::nullopt;
    };
    options.value("--rays", "N|FILE",
                  "how many rays to sample, half of them a view's, half random ones; or rays as 'csgrt shoot' reads "
                  "them; 10000 if not given",
                  arguments.rays, parse_rays,
                  "a number of rays from 1 to " + std::to_string(most_sampled) + ", or a file");
    options.count("--seed", "of the random rays; 1 if not given", arguments.seed, 0,
                  std::numeric_limits<std::uint64_t>::max());
    options.text("--json", "FILE", "write the result as JSON; - is standard output, in place of the table",
                 arguments.json);
    define_settings(options, arguments.settings);
}

void define(Options& options, CompareArguments& arguments) {
    options.argument("A", "EXR picture, or partitions that 'csgrt shoot' wrote", arguments.first);
    options.argument("B", "another file of that kind", arguments.second);
    options.number("--tolerance", "X",
                   "count only differences beyond X; in files of partitions X is a distance, and normals and solids do "
                   "not count; without it every bit does",
                   arguments.tolerance, 0, unlimited, "a number, 0 or more");
}

void define(Options&, DevicesArguments&) {}

void define(Options& options, InfoArguments& arguments) {
    define_scene(options, arguments);
    options.count("--depth", "levels of the tree to show; 2 if not given", arguments.depth, 0, Limits::nesting);
}

void define(Options& options, ConvertArguments& arguments) {
    options.argument("IN", scene_help, arguments.input);
    options.argument("OUT", "FILE.json to write; - is standard output", arguments.output);
    define_strict(options, arguments.strict);
}

// What the options do not say. Lines of at most 100 bytes.

constexpr const char* render_notes = R"(
Lengths are millimetres, whatever unit the scene's file has; angles are degrees. The view is a
square or a rectangle whose height is the diagonal of the model's box, centred on it.

An EXR holds 32-bit floats: R G B A; Z, the distance along the ray, mm, inf where nothing is hit;
N.X N.Y N.Z, the surface's unit normal, outward; region and solid, numbers from 1, 0 where nothing
is hit; depth, segments on the ray; partitions; overlap, how many of its partitions several regions
claim. Its header names the regions and solids that occur in it (csgrt:regions, csgrt:solids: JSON
texts such as {"17": "/all.g/x.r"}). A PNG holds the colours, 8 bits each, linear.

A picture, and the partitions along one ray:
  csgrt scenes/operators.json -o operators.png
  printf '0 -9000 0  0 1 0\n' | csgrt shoot scenes/operators.json --rays -
)";

constexpr const char* shoot_notes = R"(
A ray is six numbers on a line, apart by blanks: ox oy oz dx dy dz. Blank lines, and what follows a
#, do not count.
  ox oy oz       where it starts, millimetres (whatever unit the scene's file has), each at most
                 1e18
  dx dy dz       its direction, of any length: the largest of the three from 1e-250 to 1e250
A number too small for a double is 0; one too large is an error.

The output begins with lines that start with #: version and model; counts of rays, solids and
regions, whether air is kept (useair), the tolerance (tol.dist, mm); the box of the model (box, low
and high corner in mm, or 'unbounded' or 'empty'). Then there is for each ray, in the order of the
input, a line of four words:
  ray            this word
  INDEX          the ray's number, from 0
  PARTITIONS     how many lines of partitions follow
  OVERLAPS       how many lines of overlaps follow these
and a line a partition, a stretch of the ray within one region, from front to back, 13 words:
  region         its path in the model, /all.g/left.r
  in out         where the ray enters and leaves it, counted in lengths of the direction: mm if
                 that is 1. The point is origin + in * direction. What lies behind the start
                 counts: in is negative where the ray starts inside, in and out where it starts
                 behind the region. -inf or inf: the region has no end there
  inx iny inz    the unit normal where it enters, pointing out of the region: against the ray
  outx outy outz the unit normal where it leaves, pointing out of the region: along the ray
                 (of an infinite end, normal and solid mean nothing)
  in-solid       the solid on whose surface it enters: the region's own, one that is subtracted
                 from it, or that of another region which has the partition before it
  out-solid      the solid on whose surface it leaves, likewise
  in-type out-type  their types, in BRL-CAD's names: ell, tgc, arb8, ...
and a line an overlap, a stretch that several regions claim, which is given to one of them:
  overlap        this word
  in out         as above
  region region...  the paths of all that claim it
Numbers have 17 digits, so that they read back to the same bits. A blank or a backslash in a name
is \ooo, its byte in octal. Ends closer than the tolerance are one. Regions touch without overlap;
then nothing is listed. If any line of the input is wrong, all wrong ones are told, nothing is
shot, and the exit status is 6.
)";

constexpr const char* verify_notes = R"(
Rays and distances are as in 'csgrt help shoot'; errors of distances are told in mm and in units of
the last place. The exit status is 8 if any ray that rounding does not decide has wrong regions, or
if device and reference differ in any bit.
)";

constexpr const char* compare_notes = R"(
X is in the units of the channel or column: mm for Z, lengths of the direction for in and out, 0 to
1 for colours, 1 for counts and numbers of regions. The exit status is 0 if nothing differs, 8 if
something does.
)";

constexpr const char* devices_notes = R"(
A line begins with the number that --device takes. Memory is in GiB (2^30 bytes). Native devices
have the kernels of the default method alone, compiled ahead; others compile theirs when they are
first wanted. A note tells of a driver that cannot be used.
)";

constexpr const char* info_notes = R"(
'units' is the unit that the file says; 'bounds' is the box of the regions in millimetres,
'unbounded' or 'empty' if there is none. A tree's operators: u union, - difference, + intersection,
^ exclusive or, ! complement.
)";

constexpr const char* convert_notes = R"(
The scene that is written means the same to the last bit, and keeps the unit that the file says.
)";

struct Entry {
    const char* name;  ///< "" is rendering, which needs no name
    const char* synopsis;
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
    suggestion += *entry.name ? std::string("'csgrt help ") + entry.name + "'" : "'csgrt --help'";
    suggestion += " lists the options";
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
constexpr Entry entry(const char* name, const char* synopsis, const char* purpose, const char* notes) {
    return {name, synopsis, purpose, notes, parse_entry<Arguments>, entry_options<Arguments>};
}

constexpr Entry entries[] = {
    entry<RenderArguments>("", "SCENE [OBJECT...] -o FILE.exr|FILE.png", "render a scene", render_notes),
    entry<ShootArguments>("shoot", "SCENE [OBJECT...] --rays FILE", "the partitions along given rays", shoot_notes),
    entry<VerifyArguments>("verify", "SCENE [OBJECT...]", "judge a scene's answers by 113-bit ones", verify_notes),
    entry<CompareArguments>("compare", "A B", "compare two pictures, or two files of partitions",
                            compare_notes),
    entry<DevicesArguments>("devices", "", "list the devices", devices_notes),
    entry<InfoArguments>("info", "SCENE [OBJECT...]", "what a scene holds", info_notes),
    entry<ConvertArguments>("convert", "IN OUT.json", "rewrite a scene as JSON", convert_notes),
};

const Entry* find_entry(const std::string& name) {
    auto found = std::find_if(std::begin(entries), std::end(entries), [&](const Entry& e) { return name == e.name; });
    return found == std::end(entries) ? nullptr : found;
}

std::string nearest_command(const std::string& word) {
    std::vector<std::string_view> names = {"help"};
    for (const Entry& entry : entries)
        if (*entry.name) names.emplace_back(entry.name);
    return suggestion(word, names);
}

std::string usage_line(const Entry& entry) {
    std::string line = "csgrt";
    for (const char* part : {entry.name, entry.synopsis})
        if (*part) line += std::string(" ") + part;
    return line;
}

std::string overview() {
    std::string text;
    auto row = [&text](std::string line, const char* purpose) {
        line.resize(std::max<std::size_t>(line.size(), 46), ' ');
        text += "  " + line + "  " + purpose + "\n";
    };
    for (const Entry& entry : entries) row(usage_line(entry), entry.purpose);
    row("csgrt help [COMMAND]", "the options of a command");
    row("csgrt --version", "print the version");
    return text;
}

constexpr const char* exit_status =
    "\nExit status: 0 done, 2 usage, 3 scene, 4 no device, 5 out of memory, 6 file, 7 device fault,\n"
    "8 a comparison or verification differs, 130 interrupted.\n";

}  // namespace

std::string help_text(const std::string& command) {
    const Entry* entry = find_entry(command);
    if (!entry) {
        std::string near = nearest_command(command);
        fail("no command '" + command + "'", near.empty() ? "'csgrt --help' lists the commands" : near);
    }
    if (!command.empty()) return usage_line(*entry) + "\n\n" + entry->options() + entry->notes + exit_status;
    return "csgrt: exact ray tracing of Constructive Solid Geometry\n\n" + overview() + "\nTo render a scene:\n\n" +
           entry->options() + entry->notes + exit_status;
}

Command parse_arguments(const std::vector<std::string>& words) {
    if (words.empty()) fail("no scene and no command", overview());
    const std::string& first = words[0];
    if (first == "--version") return TextArguments{std::string("csgrt ") + version() + "\n"};
    if (first == "help") return TextArguments{help_text(words.size() > 1 ? words[1] : "")};
    if (const Entry* entry = find_entry(first); entry && *entry->name)
        return entry->parse(*entry, {words.begin() + 1, words.end()});

    std::error_code ignored;
    bool may_be_command = first.find_first_of("-./") == first.npos && !std::filesystem::exists(first, ignored);
    if (std::string near = nearest_command(first); may_be_command && !near.empty())
        fail("no command and no file '" + first + "'", near);
    return entries[0].parse(entries[0], words);
}

}  // namespace csgrt::cli
