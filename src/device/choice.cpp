#include "device/choice.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "base/laboratory.hpp"
#include "base/letters.hpp"
#include "scene/nearest.hpp"

namespace csgrt {

namespace {

/// The word most similar to a mistyped --device: a type, a device's or a platform's name, or a word of a name.
std::string nearest_device(const std::vector<DeviceInfo>& devices, const std::string& wanted) {
    std::vector<std::string> known = {"accelerator", "cpu", "gpu", "gpus", "native", "pocl"};
    for (const DeviceInfo& device : devices) {
        for (const std::string& name : {device.name, device.platform}) {
            known.push_back(name);
            std::string blanks = name;
            for (char& c : blanks) c = std::isalnum(static_cast<unsigned char>(c)) ? c : ' ';
            std::istringstream words(blanks);
            for (std::string word; words >> word;)
                if (word.size() > 2) known.push_back(word);
        }
    }
    // The name may be spelled correctly, and no device fits.
    if (std::find(known.begin(), known.end(), lower(wanted)) != known.end()) return {};
    return did_you_mean(wanted, {known.begin(), known.end()});
}

[[noreturn]] void refuse(const std::vector<DeviceInfo>& devices, const std::string& why, const std::string& wanted = {},
                         const std::string& advice = {}) {
    std::string list;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        list += (i ? "\n" : "") + std::to_string(i) + ": " + devices[i].name + " (" + devices[i].type + ", " +
                devices[i].platform + (devices[i].fp64 ? ")" : ", no double precision)");
    }
    Diagnostic finding;
    finding.message = why;
    finding.suggestion =
        devices.empty() ? "Build csgrt with clang, for a device of its own, or install an OpenCL driver: on Debian and "
                          "Ubuntu the package "
                          "pocl-opencl-icd brings one that runs on the processor. Or render with the CPU reference."
                        : "There is:\n" + list;
    if (const std::string near = wanted.empty() ? "" : nearest_device(devices, wanted);
        !near.empty() && !devices.empty())
        finding.suggestion = near + "\n" + finding.suggestion;
    if (!advice.empty()) finding.suggestion = advice + "\n" + finding.suggestion;
    throw Error(Status::no_device, std::vector<Diagnostic>{finding});
}

/// Refuses a native device for a precision or a method without native kernels.
[[noreturn]] void refuse_native(const std::vector<DeviceInfo>& devices) {
    refuse(devices, "native devices have the kernels of double precision alone", {},
           "An OpenCL device has those of single precision: on Debian and Ubuntu the package pocl-opencl-icd brings "
           "one that runs on the processor. The CPU reference (--reference) has them, too.");
}

}  // namespace

Kernels kernels_for(const Settings& settings) {
    const Laboratory& methods = laboratory(settings);
    const bool is_default =
        settings.precision == Precision::double_ && methods.quartic == Quartic::bracketed && !methods.contraction;
    return is_default ? Kernels::any : Kernels::compiled_by_device;
}

std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& choice, Kernels kernels) {
    if (devices.empty() && lower(choice) != "reference") refuse(devices, "no device was found");

    const auto is_too_plain = [kernels](const DeviceInfo& d) {
        return kernels == Kernels::compiled_by_device && is_native(d);
    };
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), number);
    if (!choice.empty() && end == choice.data() + choice.size()) {
        if (error != std::errc() || number >= devices.size()) refuse(devices, "no device has the number " + choice);
        if (!devices[number].fp64) refuse(devices, "device " + choice + " has no double precision");
        if (is_too_plain(devices[number])) refuse_native(devices);
        return number;
    }

    const std::string wanted = lower(choice);
    const bool by_type = wanted == "cpu" || wanted == "gpu" || wanted == "accelerator";
    bool without_fp64 = false, plain = false;
    std::size_t first = devices.size();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& device = devices[i];
        // The short name "pocl" is only in the version that PoCL's platform reports.
        const bool fits = by_type ? device.type == wanted
                                  : lower(device.name + '\n' + device.platform + '\n' + device.version).find(wanted) !=
                                        std::string::npos;
        if (!fits) continue;
        if (!device.fp64) {
            without_fp64 = true;
        } else if (is_too_plain(device)) {
            plain = true;
        } else if (!wanted.empty() || device.type == "gpu") {
            return i;
        } else {
            first = std::min(first, i);
        }
    }
    if (first < devices.size()) return first;
    if (plain) refuse_native(devices);
    if (wanted == "reference")
        refuse(devices, "the CPU reference is no device", {}, "--reference (Settings::reference) computes with it.");
    const std::string which = choice.empty() ? ""
                              : by_type      ? " of the type " + wanted
                                             : " has \"" + choice + "\" in its name";
    refuse(devices,
           without_fp64 ? "no device" + which + (choice.empty() || by_type ? " has" : " and") + " double precision"
                        : "no device" + which + (by_type ? " was found" : ""),
           by_type || without_fp64 ? "" : choice);
}

std::vector<std::size_t> choose_devices(const std::vector<DeviceInfo>& devices, const std::string& choice,
                                        Kernels kernels) {
    std::vector<std::size_t> chosen;
    if (lower(choice) == "gpus") {
        for (std::size_t i = 0; i < devices.size(); ++i)
            if (devices[i].type == "gpu" && devices[i].fp64) chosen.push_back(i);
        if (chosen.empty()) refuse(devices, "no device of the type gpu was found that has double precision");
        return chosen;
    }
    std::istringstream parts(choice);
    for (std::string part; std::getline(parts, part, ',') || chosen.empty();) {
        chosen.push_back(choose_device(devices, part, kernels));
        if (std::count(chosen.begin(), chosen.end(), chosen.back()) > 1)
            refuse(devices, "\"" + choice + "\" means device " + std::to_string(chosen.back()) + " twice");
    }
    return chosen;
}

}  // namespace csgrt
