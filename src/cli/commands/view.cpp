// csgrt view: serves a page that shows a scene, until it is interrupted.
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __GLIBC__  // which the headers above tell
#include <malloc.h>
#endif

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

#include <csgrt/image.hpp>
#include <csgrt/viewer.hpp>

#include "base/private_folder.hpp"
#include "commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"
#include "cli/text/scene.hpp"
#include "form/written_back.hpp"

extern char** environ;

namespace csgrt::cli {

namespace {

#ifdef CSGRT_HAVE_VIEW
void warn(const char* what) { std::fprintf(stderr, "csgrt: warning: %s\n", what); }

/// Opens the desktop's browser with a file that redirects to the address. The address holds a secret, and every user
/// can read a process's arguments.
class Browser {
public:
    explicit Browser(const std::string& address) {
        const std::string file = folder_ / "page.html";
        std::ofstream(file) << "<!DOCTYPE html><meta http-equiv=\"refresh\" content=\"0; url=" << address << "\">\n";
        std::string program = "xdg-open", argument = file;
        char* words[] = {program.data(), argument.data(), nullptr};
        if (posix_spawnp(&process_, program.c_str(), nullptr, nullptr, words, environ) != 0) {
            process_ = 0;
            warn("there is no xdg-open to open a browser with: open the address yourself");
        }
    }
    /// Reaps the program that opens the browser. Such a program may run as long as the browser does.
    void reap() {
        int status = 0;
        if (process_ == 0 || waitpid(process_, &status, WNOHANG) == 0) return;
        process_ = 0;
        if (status != 0) warn("xdg-open has opened no browser: open the address yourself");
    }

private:
    PrivateFolder folder_;
    pid_t process_ = 0;
};

/// Whether this process's output is a pipe whose readers have all ended.
bool is_output_closed() {
    pollfd output{STDOUT_FILENO, 0, 0};
    return poll(&output, 1, 0) > 0 && (output.revents & POLLERR) != 0;
}

bool is_of_this_machine(const std::string& address) {
    return address.starts_with("127.") || address == "::1" || address == "localhost";
}
#endif

}  // namespace

#ifdef CSGRT_HAVE_VIEW
Status run(const ViewArguments& arguments) {
#ifdef __GLIBC__
    // Pictures go back to the system when they are freed: else glibc keeps some for each thread, up to 0.7 GB.
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
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
    const bool is_input = arguments.scene == "-";
    options.name = is_input ? "standard input" : std::filesystem::path(arguments.scene).filename().string();
    Settings in_double = arguments.settings;  // rays are traced in double; pictures have their own precision
    in_double.precision = Precision::double_;
    options.command = model_words(is_input ? "SCENE" : arguments.scene, arguments.objects, arguments.load, in_double);
    if (!is_input) {
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
    if (!is_of_this_machine(arguments.address))
        warn("other machines can connect, and who listens on the way sees the address and the pictures");
    std::optional<Browser> browser;
    try {
        if (arguments.open) browser.emplace(viewer.address());
    } catch (const Error& error) {
        warn((std::string(error.what()) + ": open the address yourself").c_str());
    }
    viewer.run([&] {
        if (browser) browser->reap();
        // The program that gave its scene through a pipe may have ended without closing its page.
        return !interrupted() && !(is_input && is_output_closed());
    });
    check_interrupt();
    return Status::ok;
}
#else
Status run(const ViewArguments&) {
    throw Error(Status::usage, "this csgrt was built without zlib and shows no page: csgrt -o FILE.png draws");
}
#endif

}  // namespace csgrt::cli
