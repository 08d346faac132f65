#include "commands.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <csgrt/scene_io.hpp>

#include "cli/fatal_end.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "scene/faults/finding_list.hpp"

namespace csgrt::cli {

void refuse(const char* option, std::string message, std::string suggestion) {
    Diagnostic diagnostic;
    diagnostic.place.pointer = option;
    diagnostic.message = std::move(message);
    diagnostic.suggestion = std::move(suggestion);
    throw Error(Status::usage, {std::move(diagnostic)});
}

Settings until_interrupt(const Settings& settings) {
    Settings result = settings;
    result.progress = [](double) {
        catch_fatal_ends_again();
        return !interrupted();
    };
    return result;
}

Settings with_progress(const Settings& settings, Progress& progress) {
    Settings result = until_interrupt(settings);
    result.progress = [&progress, goes_on = result.progress](double fraction) {
        progress.update(fraction);
        return goes_on(fraction);
    };
    return result;
}

void report(std::vector<Warning> warnings, bool pictures) {
    constexpr std::size_t most = FindingList::most;
    if (!pictures) std::erase_if(warnings, [](const Warning& warning) { return warning.appearance; });
    std::string text;
    for (std::size_t i = 0; i < std::min(warnings.size(), most); ++i)
        text += "csgrt: warning: " + format(warnings[i]) + "\n";
    if (warnings.size() > most)
        text += "csgrt: " + std::to_string(warnings.size() - most) + " more warnings; 'csgrt info' lists all\n";
    std::fputs(text.c_str(), stderr);
}

Scene load(const std::string& path, const LoadOptions& options) try {
    Scene scene = load_scene(path, options);
    check_interrupt();
    return scene;
} catch (const Error&) {
    check_interrupt();  // a signal may have caused the failure
    throw;
}

Scene load_with_progress(const std::string& path, const LoadOptions& options) {
    Progress progress;
    progress.stage("loading");
    return load(path, options);
}

}  // namespace csgrt::cli
