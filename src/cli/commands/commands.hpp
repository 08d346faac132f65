// The commands of csgrt: what each one is told, and the functions that carry them out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt::cli {

class Progress;

/// A scene file, the objects of it (none: its top objects), and how to compute.
struct SceneArguments {
    std::string scene;  ///< file or "-"
    std::vector<std::string> objects;
    bool strict = false;  ///< what is missing or broken in a database is refused
    Settings settings;
};

struct RenderArguments : SceneArguments {
    std::vector<std::string> outputs;  ///< "-" is standard output
    std::string format;                ///< of "-": "exr" or "png"; empty: not given
    int width = 1024, height = 1024;
    std::optional<double> azimuth, elevation, perspective, view_size;  ///< absent: the scene's
    std::optional<Vec3> center, eye, look_at, up;
    std::string view;  ///< file of a saved view; empty: none
    bool first_hit = false;
    std::string stats;  ///< file, "-" or empty
    int repeat = 1;
};

struct ShootArguments : SceneArguments {
    std::string rays;          ///< file or "-"
    std::string output = "-";  ///< file or "-"
};

struct VerifyArguments : SceneArguments {
    std::size_t count = 10'000;  ///< rays to sample
    std::string rays;            ///< file or "-"; empty: a sample
    std::uint64_t seed = 1;
    std::string json;  ///< file, "-" or empty
};

struct CompareArguments {
    std::string first, second;
    std::optional<double> tolerance;  ///< absent: bit by bit
};

struct DevicesArguments {};

struct InfoArguments : SceneArguments {
    int depth = 2;
};

struct ConvertArguments {
    std::string input, output;
    bool strict = false;
};

/// --help and --version.
struct TextArguments {
    std::string text;
};

using Command = std::variant<RenderArguments, ShootArguments, VerifyArguments, CompareArguments, DevicesArguments,
                             InfoArguments, ConvertArguments, TextArguments>;

// Each returns Status::ok, or Status::differs where it compares or judges; everything else that goes wrong is thrown as
// Error.
Status run(const RenderArguments& arguments);
Status run(const ShootArguments& arguments);
Status run(const VerifyArguments& arguments);
Status run(const CompareArguments& arguments);
Status run(const DevicesArguments& arguments);
Status run(const InfoArguments& arguments);
Status run(const ConvertArguments& arguments);
Status run(const TextArguments& arguments);

/// The settings of a command with its progress and the user's Ctrl-C tied in. `progress` must outlive the result's use.
Settings with_progress(const Settings& settings, Progress& progress);

/// Says warnings on standard error, a line each; of very many, the first and how many more. `pictures`: those, too,
/// that tell what pictures lack.
void report(std::vector<Warning> warnings, bool pictures = true);

/// load_scene, as one that can be interrupted.
Scene load(const std::string& path, bool strict);

/// load() with a progress of its own.
Scene load_with_progress(const std::string& path, bool strict);

}  // namespace csgrt::cli
