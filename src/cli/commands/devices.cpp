// csgrt devices: the devices that --device can choose.
#include <cstdio>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "commands.hpp"
#include "cli/output.hpp"

namespace csgrt::cli {

namespace {

std::string gibibytes(std::uint64_t bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f GiB", static_cast<double>(bytes) / (1 << 30));
    return text;
}

}  // namespace

Status run(const DevicesArguments&) {
    std::vector<std::string> notes;
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
