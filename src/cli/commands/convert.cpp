// csgrt convert: writes any scene that csgrt reads as csgrt's JSON.
#include <filesystem>

#include <csgrt/scene_io.hpp>

#include "commands.hpp"
#include "cli/output.hpp"

namespace csgrt::cli {

Status run(const ConvertArguments& arguments) {
    if (arguments.output != "-" && std::filesystem::path(arguments.output).extension() != ".json" &&
        !target_of(arguments.output).direct)
        throw Error(Status::usage, "OUT: '" + arguments.output + "' must end in .json, the format that is written");
    check_outputs({{"OUT", arguments.output}}, {{"IN", arguments.input}});
    Scene scene = load_with_progress(arguments.input, arguments.load);
    std::vector<Warning> warnings = scene.warnings;
    if (scene.lenient)
        validate(scene, {}, false,
                 &warnings);  // writing adds warnings about parts that are left out; the reader's are already reported
    report(warnings);
    save_scene(scene, arguments.output);
    return Status::ok;
}

}  // namespace csgrt::cli
