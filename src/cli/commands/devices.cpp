// csgrt devices: lists the devices that --device can choose.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <csgrt/renderer.hpp>

#include "commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/output.hpp"

namespace csgrt::cli {

namespace {

std::string gibibytes(std::uint64_t bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f GiB", static_cast<double>(bytes) / (1 << 30));
    return text;
}

/// Can drivers be loaded? A driver may end the process that loads it, so a child process loads the drivers first.
bool can_load_drivers() {
#ifdef CSGRT_HAS_OWN_HANDLERS  // a sanitizer: a child may wait for ever for a lock of the parent's threads
    return true;
#endif
    const pid_t child = fork();
    if (child == 0) {
#ifdef __linux__
        prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
        for (const int signal : {SIGABRT, SIGBUS, SIGSEGV}) std::signal(signal, SIG_DFL);
        try {
            static_cast<void>(devices());
        } catch (const std::exception&) {  // the parent will have the same fault, and reports it
        }
        _exit(0);
    }
    int status = 0;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
        if (interrupted()) kill(child, SIGKILL);
    check_interrupt();
    return child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

}  // namespace

Status run(const DevicesArguments&) {
    std::vector<std::string> notes;
    if (!can_load_drivers()) {
        setenv("OCL_ICD_VENDORS", "/none/", 1);  // tells the OpenCL loader that there are no drivers
        setenv("OCL_ICD_FILENAMES", "", 1);
        notes.push_back(
            "OpenCL cannot be used: one of its drivers ends the process that loads it. Those are in the folder "
            "/etc/OpenCL/vendors or OCL_ICD_VENDORS");
    }
    const std::vector<DeviceInfo> found = devices(&notes);
    if (found.empty()) {
        std::string advice =
            "install an OpenCL driver; pocl-opencl-icd makes a device of the CPU, and --reference needs none";
        for (const std::string& note : notes) advice += "\n" + note;
        throw Error(Status::no_device, {Diagnostic{{}, "no device", advice, {}}});
    }
    std::string text;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const DeviceInfo& device = found[i];
        const bool is_native = device.platform == "csgrt";
        text += std::to_string(i) + "  " + device.type + "  " + device.name + "\n     " + device.platform + ", " +
                device.version + (is_native ? "" : ", driver " + device.driver) + "\n";
        text += "     " + gibibytes(device.memory) + " of memory, " + gibibytes(device.max_allocation) +
                " in one piece, " + std::to_string(device.compute_units) + " compute units, " +
                (device.fp64 ? "double precision" : "NO double precision: csgrt cannot use it") + "\n";
    }
    for (const std::string& note : notes) text += "note: " + note + "\n";
    print(text);
    return Status::ok;
}

}  // namespace csgrt::cli
