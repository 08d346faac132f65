// csgrt info: the contents of a scene, and of the compiled scene.
#include <cstdio>
#include <optional>
#include <utility>

#include "commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "cli/text/scene.hpp"

namespace csgrt::cli {

namespace {

std::string row(const char* name, const std::string& text) {
    std::string line = name;
    line.resize(10, ' ');
    return line + text + "\n";
}

std::string decimal(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

std::string objects_text(const Scene& scene) {
    std::map<std::string, std::size_t> types;
    for (const Object& object : scene.objects) {
        if (auto* solid = std::get_if<Solid>(&object))
            ++types[type_name(solid->shape)];
        else
            ++types[std::get<Combination>(object).region ? "region" : "combination"];
    }
    return count_text(types);
}

Renderer compile_with_progress(const Scene& scene, const InfoArguments& arguments) {
    Progress progress;
    progress.stage("compiling");
    Settings settings = with_progress(arguments.settings, progress);
    settings.reference = true;  // needs no device
    Renderer renderer(scene, arguments.objects, settings);
    check_interrupt();
    return renderer;  // it never draws, so it does not use `progress` again
}

}  // namespace

Status run(const InfoArguments& arguments) {
    Scene scene = load_with_progress(arguments.scene, arguments.load);

    std::string text;
    if (!scene.title.empty()) text += row("title", scene.title);
    text += row("units", scene.units + (scene.unit_length == 1 ? "" : " (" + decimal(scene.unit_length) + " mm)"));
    text += row("objects", objects_text(scene));
    text +=
        "\n" + tree_text(scene, arguments.objects.empty() ? top_objects(scene) : arguments.objects, arguments.depth);
    print(text);

    std::optional<Renderer> compiled;
    try {
        compiled.emplace(compile_with_progress(scene, arguments));
    } catch (const Error& error) {
        // If nothing is left to render, the parts that were left out are listed. An object that does not exist is an
        // error.
        std::vector<Warning> warnings = scene.warnings;
        if (error.status() != Status::scene || !scene.lenient ||
            !validate(scene, arguments.objects, false, &warnings, arguments.settings.max_instances).empty())
            throw;
        text = "\n" + row("compiled", "no: " + error.diagnostics().front().message);
        for (const Warning& warning : warnings) text += row("warning", format(warning));
        print(text);
        return Status::ok;
    }
    const Renderer& renderer = *compiled;
    std::map<std::string, std::size_t> types;
    for (const SolidInfo& solid : renderer.solids())
        if (solid.piece == 0) ++types[solid.type];
    text = "\n" + row("solids", count_text(types));
    text += row("regions", std::to_string(renderer.regions().size()));
    text += row("bounds", bounds_text(renderer, true, decimal));
    char compile[32];
    std::snprintf(compile, sizeof compile, "%.3g ms", renderer.statistics().ms.compile);
    text += row("compiled", compile);
    for (const Warning& warning : renderer.warnings()) text += row("warning", format(warning));
    print(text);
    return Status::ok;
}

}  // namespace csgrt::cli
