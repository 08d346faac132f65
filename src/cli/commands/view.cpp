// csgrt view: a page that shows a scene, until it is interrupted.
#include <spawn.h>

#include <cstdio>
#include <filesystem>

#include <csgrt/image.hpp>
#include <csgrt/viewer.hpp>

#include "base/shell_word.hpp"
#include "commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/text/partitions.hpp"
#include "cli/text/scene.hpp"

extern char** environ;

namespace csgrt::cli {

namespace {

#ifdef CSGRT_HAVE_VIEW
/// The words behind `csgrt` that load the same model.
std::string words_of(const ViewArguments& arguments) {
    std::string text = shell_word(arguments.scene == "-" ? "SCENE" : arguments.scene);
    for (const std::string& object : arguments.objects) text += " " + shell_word(object);
    text += model_options(arguments);
    if (arguments.settings.tolerance_rule != Tolerance::length)
        text.append(" --tolerance ").append(name_of(tolerance_names, arguments.settings.tolerance_rule));
    else if (arguments.settings.tolerance >= 0)
        append_shortest(text += " --tolerance ", arguments.settings.tolerance);
    return text;
}

void open_browser(const std::string& address) {
    std::string program = "xdg-open", argument = address;
    char* words[] = {program.data(), argument.data(), nullptr};
    pid_t process = 0;
    if (posix_spawnp(&process, program.c_str(), nullptr, nullptr, words, environ) != 0)
        std::fputs("csgrt: warning: there is no xdg-open to open a browser with: open the address yourself\n", stderr);
}
#endif

}  // namespace

#ifdef CSGRT_HAVE_VIEW
Status run(const ViewArguments& arguments) {
    prepare_devices(arguments.settings);
    const auto load_model = [&arguments] {
        return Model(load(arguments.scene, arguments.load), arguments.objects, arguments.settings);
    };
    const Model model = load_model();
    report(model.warnings());
    check_interrupt();

    ViewerOptions options;
    options.address = arguments.address;
    options.port = arguments.port;
    options.name =
        arguments.scene == "-" ? "standard input" : std::filesystem::path(arguments.scene).filename().string();
    options.command = words_of(arguments);
    if (arguments.scene != "-") {
        options.file = arguments.scene;
        options.load = load_model;
    }
#ifdef CSGRT_HAVE_IMAGE
    options.write_exr = [](const Image& image, const std::string& path, const std::function<bool(double)>& progress) {
        write_image(image, path, "exr", progress);
    };
#endif
    Viewer viewer(model, arguments.settings, options);
    print(viewer.address() + "\n");
    std::fflush(stdout);
    if (arguments.open) open_browser(viewer.address());
    viewer.run([] { return !interrupted(); });
    check_interrupt();
    return Status::ok;
}
#else
Status run(const ViewArguments&) {
    throw Error(Status::usage, "this csgrt was built without zlib and shows no page: csgrt -o FILE.png draws");
}
#endif

}  // namespace csgrt::cli
