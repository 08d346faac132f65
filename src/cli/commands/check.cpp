// csgrt check: regions of a scene that overlap.
#include <algorithm>
#include <cstdio>
#include <utility>

#include "commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/text/overlaps.hpp"

namespace csgrt::cli {

Status run(const CheckArguments& arguments) {
    const NamedFile named[] = {
        {"--json", arguments.json}, {"--junit", arguments.junit}, {"--write-rays", arguments.rays}};
    std::vector<NamedFile> outputs, inputs = {{"SCENE", arguments.scene}};
    for (const NamedFile& file : named)
        if (!file.path.empty()) outputs.push_back(file);
    if (!arguments.allow.empty()) inputs.push_back({"--allow", arguments.allow});
    check_outputs(outputs, inputs);
    CheckRequest request = arguments.request;
    if (!arguments.allow.empty()) request.allowed = load_allowed_overlaps(arguments.allow);
    CheckResult result;
    std::vector<Warning> warnings;
    std::string table, json, junit, rays;
    {
        Progress progress;
        progress.stage("loading");
        prepare_devices(arguments.settings);
        Scene scene = load(arguments.scene, arguments.load);
        progress.stage("compiling");
        Model model(std::move(scene), arguments.objects, with_progress(arguments.settings, progress));
        report(model.warnings(), false);
        check_interrupt();
        Checker checker(model, until_interrupt(arguments.settings));
        report(checker.renderer().device_warnings(), false);
        progress.stage("checking");
        bool is_told = on_terminal();
        result = checker.check(request, [&](const CheckResult& so_far) {
            progress.note(to_note(so_far));
            if (so_far.rays_to_come > 0 && !std::exchange(is_told, true))
                std::fprintf(stderr, "csgrt: %s\n", to_note(so_far).c_str());
            return !interrupted();
        });
        for (const std::uint32_t region : result.unbounded)
            warnings.push_back({model.regions()[region].path,
                                {},
                                "has no end: only its part within the box of the others was searched"});
        table = to_text(result, request, model, table_width());
        if (!arguments.json.empty()) json = to_json(result, request, model);
        if (!arguments.junit.empty()) junit = to_junit(result, model, arguments.scene);
        if (!arguments.rays.empty()) rays = to_rays(result, model);
    }
    for (const AllowedOverlap& row : result.unused)
        if (result.is_complete)
            warnings.push_back(
                {arguments.allow, {}, "no overlap needs the row '" + row.first + " " + row.second + "'"});
    report(std::move(warnings));
    write_file(arguments.json, json);
    write_file(arguments.junit, junit);
    write_file(arguments.rays, rays);
    const bool is_taken = std::ranges::any_of(outputs, [](const NamedFile& file) { return file.path == "-"; });
    if (!is_taken) print(table);
    if (interrupted()) return Status::interrupted;
    return result.new_overlaps > 0 ? Status::differs : Status::ok;
}

}  // namespace csgrt::cli
