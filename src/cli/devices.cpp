// csgrt devices: what --device can choose from.
#include <cstdio>

#include <csgrt/renderer.hpp>

#include "commands.hpp"
#include "output.hpp"

namespace csgrt::cli {

namespace {

std::string gibibytes(std::uint64_t bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f GiB", static_cast<double>(bytes) / (1 << 30));
    return text;
}

}  // namespace

Status run(const DevicesArguments&) {
    auto found = devices();
    if (found.empty()) {
        const char* advice = "install a driver; pocl-opencl-icd makes a device of the CPU, and --reference needs none";
        throw Error(Status::no_device, {Diagnostic{{}, "no OpenCL device", advice, {}}});
    }
    std::string text;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const DeviceInfo& device = found[i];
        text += std::to_string(i) + "  " + device.type + "  " + device.name + "\n";
        text += "     " + device.platform + ", " + device.version + ", driver " + device.driver + "\n";
        text += "     " + gibibytes(device.memory) + " of memory, " + gibibytes(device.max_allocation) +
                " in one piece, " + std::to_string(device.compute_units) + " compute units, " +
                (device.fp64 ? "double precision" : "NO double precision: csgrt cannot use it") + "\n";
    }
    print(text);
    return Status::ok;
}

}  // namespace csgrt::cli
