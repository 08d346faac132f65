// csgrt info: prints the contents of a scene, before and after compilation.
#include <cstdio>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "base/clock.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/progress.hpp"
#include "form/answers.hpp"
#include "cli/text/figures.hpp"
#include "cli/text/partitions.hpp"
#include "cli/text/scene.hpp"
#include "cli/text/statistics.hpp"

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
    for (const Object& object : scene.objects) ++types[type_name(object)];
    return count_text(types);
}

std::string contents_text(const Scene& scene, const InfoArguments& arguments) {
    std::string text;
    if (!scene.title.empty()) text += row("title", scene.title);
    text += row("units", scene.units + (scene.unit_length == 1 ? "" : " (" + decimal(scene.unit_length) + " mm)"));
    text += row("objects", objects_text(scene));
    return text + "\n" +
           tree_text(scene, arguments.objects.empty() ? top_objects(scene) : arguments.objects, arguments.depth);
}

struct Compiled {
    std::optional<Model> model;  ///< absent: nothing is left to render
    std::string fault;           ///< the reason why there is no model
    double milliseconds = 0;
    std::vector<Warning> warnings;
};

Compiled compile_what_is_left(const Scene& scene, const InfoArguments& arguments) try {
    Progress progress;
    progress.stage("compiling");
    const auto begin = Clock::now();
    const Model model(scene, arguments.objects, arguments.settings);
    check_interrupt();
    return {model, "", milliseconds_since(begin), model.warnings()};
} catch (const Error& error) {
    // If nothing is left to render, csgrt info lists the parts that were left out. An object that does not exist is an
    // error.
    std::vector<Warning> warnings = scene.warnings;
    if (error.status() != Status::scene || !scene.lenient ||
        !validate(scene, arguments.objects, false, &warnings, arguments.settings.max_instances).empty())
        throw;
    return {std::nullopt, error.diagnostics().front().message, 0, std::move(warnings)};
}

std::string model_rows(const Compiled& compiled) {
    std::string text = "\n";
    if (compiled.model) {
        const Model& model = *compiled.model;
        std::map<std::string, std::size_t> types;
        for (const SolidInfo& solid : model.solids())
            if (solid.piece == 0) ++types[solid.type];
        text += row("solids", count_text(types));
        text += row("regions", std::to_string(model.regions().size()));
        text += row("bounds", bounds_text(model, true, decimal));
        char compile[32];
        std::snprintf(compile, sizeof compile, "%.3g ms", compiled.milliseconds);
        text += row("compiled", compile);
    } else {
        text += row("compiled", "no: " + compiled.fault);
    }
    for (const Warning& warning : compiled.warnings) text += row("warning", format(warning));
    return text;
}

// ---- JSON ----

std::string json_box(const Box& box) {
    if (!(box.low.x <= box.high.x)) return "null";
    return "{\"low\": " + json_point(box.low) + ", \"high\": " + json_point(box.high) + "}";
}

std::string json_region(const RegionInfo& region, std::size_t index) {
    std::string text = "{\"index\": " + std::to_string(index);
    form::for_members(form::of<RegionInfo>, [&](const auto& member) {
        const auto& value = region.*member.at;
        using Value = std::remove_cvref_t<decltype(value)>;
        if constexpr (!std::is_same_v<Value, Finish>) {
            text += ", " + json_text(member.key.json) + ": ";
            if constexpr (std::is_same_v<Value, std::string>)
                text += json_text(value);
            else if constexpr (std::is_same_v<Value, int>)
                text += std::to_string(value);
            else if constexpr (std::is_same_v<Value, Vec3>)
                text += json_point(value);
            else if constexpr (std::is_same_v<Value, Box>)
                text += json_box(value);
            else
                text += json_text(name_of(*member.kind.names, value));
        }
    });
    return text + "}";
}

std::string json_warning(const Warning& warning) {
    std::string place = format(Warning{.object = {}, .place = warning.place, .reason = {}});
    if (place.ends_with(": ")) place.resize(place.size() - 2);
    return "{\"object\": " + json_text(warning.object) + ", \"place\": " + json_text(place) +
           ", \"reason\": " + json_text(warning.reason) + "}";
}

std::string model_json(const Scene& scene, const Compiled& compiled) {
    constexpr const char* between = ",\n    ";
    std::string regions, warnings;
    std::size_t solids = 0;
    Box bounds{{1, 1, 1}, {0, 0, 0}};  // an empty box
    if (compiled.model) {
        for (const SolidInfo& solid : compiled.model->solids()) solids += solid.piece == 0;
        bounds = compiled.model->bounds();
        for (std::size_t i = 0; i < compiled.model->regions().size(); ++i)
            regions += (i > 0 ? between : "\n    ") + json_region(compiled.model->regions()[i], i);
    }
    for (const Warning& warning : compiled.warnings)
        warnings += (warnings.empty() ? "\n    " : between) + json_warning(warning);
    return "{\n  \"title\": " + json_text(scene.title) + ",\n  \"units\": " + json_text(scene.units) +
           ",\n  \"bounds\": " + json_box(bounds) + ",\n  \"solids\": " + std::to_string(solids) +
           ",\n  \"regions\": [" + regions + "],\n  \"warnings\": [" + warnings + "]\n}\n";
}

}  // namespace

Status run(const InfoArguments& arguments) {
    Scene scene = load_with_progress(arguments.scene, arguments.load);
    if (!arguments.json) print(contents_text(scene, arguments));
    const Compiled compiled = compile_what_is_left(scene, arguments);
    print(arguments.json ? model_json(scene, compiled) : model_rows(compiled));
    return Status::ok;
}

}  // namespace csgrt::cli
