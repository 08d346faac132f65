#include "commands.hpp"

#include <cstdio>

#include <csgrt/scene_io.hpp>

#include "interrupt.hpp"
#include "progress.hpp"

namespace csgrt::cli {

Settings with_progress(const Settings& settings, Progress& progress) {
    Settings result = settings;
    result.progress = [&progress](double fraction) {
        progress.update(fraction);
        return !interrupted();
    };
    return result;
}

void report_skipped(const Renderer& renderer) {
    std::string text;
    for (const std::string& solid : renderer.skipped()) text += "csgrt: left out: " + solid + "\n";
    for (const std::string& note : renderer.notes()) text += "csgrt: note: " + note + "\n";
    std::fputs(text.c_str(), stderr);
}

Scene load(const std::string& path) try {
    Scene scene = load_scene(path);
    check_interrupt();
    return scene;
} catch (const Error&) {
    check_interrupt();  // a signal may be why it could not be read
    throw;
}

Scene load_with_progress(const std::string& path) {
    Progress progress;
    progress.stage("loading");
    return load(path);
}

}  // namespace csgrt::cli
