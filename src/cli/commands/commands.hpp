// The arguments of each command of csgrt, and the functions that run the commands.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <csgrt/check.hpp>
#include <csgrt/measure.hpp>
#include <csgrt/renderer.hpp>
#include <csgrt/scene_io.hpp>

#include "cli/values.hpp"

namespace csgrt::cli {

class Progress;

/// A scene file, some of its objects (none: its top objects), and settings.
struct SceneArguments {
    std::string scene;  ///< file or "-"
    std::vector<std::string> objects;
    LoadOptions load;
    Settings settings;
};

struct RenderArguments : SceneArguments {
    std::vector<std::string> outputs;  ///< "-" is standard output
    std::string format;                ///< of a picture on standard output: "exr" or "png"; empty: not given
    View picture;                      ///< camera members that `given` lacks are the scene's
    std::set<std::string> given;       ///< names of the camera's members that options set
    std::string view;                  ///< file of a saved view; empty: no such file
    std::vector<Look> looks;
    std::string stats;  ///< file, "-" or empty
    int repeat = 1;
};

struct ViewArguments : SceneArguments {
    std::string address = "127.0.0.1";
    int port = 0;  ///< 0: any free port
    bool open = false;
};

/// A format of partitions in a file.
enum class RowFormat { text, csv, binary, npy };

struct ShootArguments : SceneArguments {
    std::string rays;                          ///< file or "-"; empty: the grid
    std::optional<std::pair<Axis, int>> grid;  ///< an axis, and the number of rays along each side of the grid
    std::optional<double> near, far;           ///< the range of t, in lengths of a ray's direction
    RowFormat format = RowFormat::text;
    std::string output = "-";  ///< file or "-"
};

struct SampleArguments : SceneArguments {
    std::string points;          ///< file or "-"; empty: the plane
    std::optional<Plane> plane;  ///< absent: the file of points is used
    int width = 1024, height = 1024;
    std::string output = "-";  ///< file or "-"
};

struct VerifyArguments : SceneArguments {
    std::size_t count = 10'000;  ///< rays to sample
    std::string rays;            ///< file or "-"; empty: a sample
    std::uint64_t seed = 1;
    std::string json;  ///< file, "-" or empty
};

struct MeasureArguments : SceneArguments {
    MeasureRequest request;
    std::string densities;  ///< file or empty
    int depth = 2;
    std::string json, csv;           ///< file, "-" or empty
    std::vector<std::string> cells;  ///< files
};

struct CheckArguments : SceneArguments {
    CheckRequest request;
    std::string allow;              ///< file or empty
    std::string json, junit, rays;  ///< file, "-" or empty
};

struct CompareArguments {
    std::string first, second;
    std::optional<double> tolerance;  ///< absent: files are compared bit by bit
};

struct DevicesArguments {};

struct InfoArguments : SceneArguments {
    int depth = 2;
    bool json = false;
};

struct ConvertArguments {
    std::string input, output;
    LoadOptions load;
};

/// --help and --version: a text that is printed.
struct TextArguments {
    std::string text;
};

using Command =
    std::variant<RenderArguments, ViewArguments, ShootArguments, SampleArguments, VerifyArguments, MeasureArguments,
                 CheckArguments, CompareArguments, DevicesArguments, InfoArguments, ConvertArguments, TextArguments>;

// Each returns Status::ok; `compare`, `verify`, `measure` and `check` may also return Status::differs, the last two
// Status::interrupted. Every other failure is an Error.
Status run(const RenderArguments& arguments);
Status run(const ViewArguments& arguments);
Status run(const ShootArguments& arguments);
Status run(const SampleArguments& arguments);
Status run(const VerifyArguments& arguments);
Status run(const MeasureArguments& arguments);
Status run(const CheckArguments& arguments);
Status run(const CompareArguments& arguments);
Status run(const DevicesArguments& arguments);
Status run(const InfoArguments& arguments);
Status run(const ConvertArguments& arguments);
Status run(const TextArguments& arguments);

/// Throws Error (usage) about an option or an argument.
[[noreturn]] void refuse(const char* option, std::string message, std::string suggestion);

/// Settings whose progress function stops the work after an interrupt. Notes tell how far the work is.
Settings until_interrupt(const Settings& settings);

/// Settings whose progress function updates `progress`, and stops the work after an interrupt. `progress` must outlive
/// the settings' use.
Settings with_progress(const Settings& settings, Progress& progress);

/// Prints warnings on standard error, one a line. Of more than FindingList::most warnings it prints the first ones and
/// the number of the others. `pictures`: also warnings about the appearance of pictures.
void report(std::vector<Warning> warnings, bool pictures = true);

/// Loads a scene. Throws Error (interrupted) after an interrupt.
Scene load(const std::string& path, const LoadOptions& options);

/// load() that shows its own progress.
Scene load_with_progress(const std::string& path, const LoadOptions& options);

}  // namespace csgrt::cli
