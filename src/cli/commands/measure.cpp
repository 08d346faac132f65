// csgrt measure: volumes, masses, areas and moments of a scene's parts, with their errors.
#include <algorithm>
#include <utility>

#include "commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/text/cells.hpp"
#include "cli/text/measurement.hpp"

namespace csgrt::cli {

namespace {

/// Takes out the rows of a table whose paths are of no region. A table may be that of a larger model.
std::vector<Warning> drop_unused(std::vector<Density>& densities, const Model& model) {
    std::vector<Warning> warnings;
    std::erase_if(densities, [&](const Density& row) {
        if (row.path.empty() || !model.regions(row.path).empty()) return false;
        warnings.push_back({row.path, {}, "no region has this path or lies below it, so its density has no effect"});
        return true;
    });
    return warnings;
}

void check_grid(const MeasureArguments& arguments) {
    const bool has_grid = arguments.request.grid[0] > 0;
    if (has_grid && arguments.cells.empty())
        refuse("--grid", "a table cannot show the volumes in cells",
               "name a file with --grid-output FILE.npz or FILE.vti");
    if (!has_grid && !arguments.cells.empty())
        refuse("--grid-output", "there are no cells to write", "say how many with --grid NX,NY,NZ");
    for (const std::string& file : arguments.cells)
        if (const std::string extension = extension_of(file); extension != ".npz" && extension != ".vti")
            refuse("--grid-output", "'" + file + "' ends in neither .npz nor .vti", "a file's name says its format");
}

}  // namespace

Status run(const MeasureArguments& arguments) {
    std::vector<NamedFile> outputs, inputs = {{"SCENE", arguments.scene}};
    if (!arguments.json.empty()) outputs.push_back({"--json", arguments.json});
    if (!arguments.csv.empty()) outputs.push_back({"--csv", arguments.csv});
    if (!arguments.densities.empty()) inputs.push_back({"--densities", arguments.densities});
    check_grid(arguments);
    for (const std::string& file : arguments.cells) outputs.push_back({"--grid-output", file});
    check_outputs(outputs, inputs);
    MeasureRequest request = arguments.request;
    if (!arguments.densities.empty()) request.densities = load_densities(arguments.densities);
    Measurement result;
    {
        Progress progress;
        progress.stage("loading");
        prepare_devices(arguments.settings);
        Scene scene = load(arguments.scene, arguments.load);
        if (arguments.densities.empty()) request.densities = scene.densities;
        progress.stage("compiling");
        Model model(std::move(scene), arguments.objects, with_progress(arguments.settings, progress));
        report(model.warnings(), false);
        report(drop_unused(request.densities, model), false);
        check_interrupt();
        Measurer measurer(std::move(model), until_interrupt(arguments.settings));
        report(measurer.renderer().device_warnings(), false);
        progress.stage("measuring");
        result = measurer.measure(request, [&](const Measurement& so_far) {
            progress.note(to_note(so_far, request));
            return !interrupted();
        });
    }
    if (!arguments.json.empty()) write_file(arguments.json, to_json(result, request));
    if (!arguments.csv.empty()) write_file(arguments.csv, to_csv(result));
    if (!arguments.cells.empty() && result.grid.sides[0] == 0)
        refuse("--grid", "the model has no bounded region for a grid to cover", "name other objects");
    for (const std::string& file : arguments.cells) write_cells(result, file);
    if (arguments.json != "-" && arguments.csv != "-") print(to_text(result, request, arguments.depth, table_width()));
    if (interrupted()) return Status::interrupted;
    return result.parts.front().thin > 0 ? Status::differs : Status::ok;
}

}  // namespace csgrt::cli
