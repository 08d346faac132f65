#include "device/choice.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <future>
#include <mutex>
#include <sstream>

#include "device/opencl.hpp"
#include "scene/nearest.hpp"

namespace csgrt {

namespace {

constexpr cl_int platform_not_found = -1001;  // of the ICD loader (cl_khr_icd), when no driver is installed

template <class Get>
std::string text_of(Get get, const char* call) {
    std::size_t size = 0;
    check(get(0, nullptr, &size), call);
    std::string text(size, '\0');
    check(get(size, text.data(), nullptr), call);
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
    return text;
}

std::string device_text(cl_device_id id, cl_device_info what) {
    return text_of([&](std::size_t size, void* out, std::size_t* needed) { return clGetDeviceInfo(id, what, size, out, needed); },
                   "clGetDeviceInfo");
}

template <class T>
T device_value(cl_device_id id, cl_device_info what) {
    T value{};
    check(clGetDeviceInfo(id, what, sizeof value, &value, nullptr), "clGetDeviceInfo");
    return value;
}

DeviceInfo describe(cl_platform_id platform, cl_device_id id) {
    DeviceInfo info;
    info.name = device_text(id, CL_DEVICE_NAME);
    info.platform = text_of([&](std::size_t size, void* out, std::size_t* needed) {
        return clGetPlatformInfo(platform, CL_PLATFORM_NAME, size, out, needed);
    }, "clGetPlatformInfo");
    info.version = device_text(id, CL_DEVICE_VERSION);
    info.driver = device_text(id, CL_DRIVER_VERSION);
    const auto type = device_value<cl_device_type>(id, CL_DEVICE_TYPE);
    info.type = type & CL_DEVICE_TYPE_GPU ? "gpu" : type & CL_DEVICE_TYPE_CPU ? "cpu" : "accelerator";
    info.memory = device_value<cl_ulong>(id, CL_DEVICE_GLOBAL_MEM_SIZE);
    info.max_allocation = device_value<cl_ulong>(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
    info.compute_units = device_value<cl_uint>(id, CL_DEVICE_MAX_COMPUTE_UNITS);
    info.fp64 = (" " + device_text(id, CL_DEVICE_EXTENSIONS) + " ").find(" cl_khr_fp64 ") != std::string::npos;
    return info;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// What --device may have meant: a type, a device's or a platform's name, or a word of one.
std::string nearest_device(const std::vector<DeviceInfo>& devices, const std::string& wanted) {
    std::vector<std::string> known = {"accelerator", "cpu", "gpu", "gpus"};
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
    return did_you_mean(wanted, {known.begin(), known.end()});
}

[[noreturn]] void refuse(const std::vector<DeviceInfo>& devices, const std::string& why, const std::string& wanted = {}) {
    std::string list;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        list += (i ? "\n" : "") + std::to_string(i) + ": " + devices[i].name + " (" + devices[i].type + ", " +
                devices[i].platform + (devices[i].fp64 ? ")" : ", no double precision)");
    }
    Diagnostic finding;
    finding.message = why;
    finding.suggestion =
        devices.empty()
            ? "Install an OpenCL driver: on Debian and Ubuntu the package pocl-opencl-icd brings one that runs on the "
              "processor. Or render with the CPU reference."
            : "There is:\n" + list;
    if (const std::string near = wanted.empty() ? "" : nearest_device(devices, wanted); !near.empty() && !devices.empty())
        finding.suggestion = near + "\n" + finding.suggestion;
    throw Error(Status::no_device, std::vector<Diagnostic>{finding});
}

}  // namespace

std::vector<FoundDevice> find_devices() {
    // One thread at a time: where two begin at once, ocl-icd tells the second that there is no device, and PoCL crashes.
    static std::mutex mutex;
    const std::lock_guard lock(mutex);

    cl_uint platform_count = 0;
    const cl_int found = clGetPlatformIDs(0, nullptr, &platform_count);
    if (found == platform_not_found) return {};
    check(found, "clGetPlatformIDs");
    std::vector<cl_platform_id> platforms(platform_count);
    if (platform_count > 0) check(clGetPlatformIDs(platform_count, platforms.data(), nullptr), "clGetPlatformIDs");

    std::vector<FoundDevice> devices;
    for (const cl_platform_id platform : platforms) {
        cl_uint count = 0;
        const cl_int code = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count);
        if (code == CL_DEVICE_NOT_FOUND || (code == CL_SUCCESS && count == 0)) continue;
        check(code, "clGetDeviceIDs");
        std::vector<cl_device_id> ids(count);
        check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, ids.data(), nullptr), "clGetDeviceIDs");
        for (const cl_device_id id : ids) {
            if (device_value<cl_bool>(id, CL_DEVICE_AVAILABLE)) devices.push_back({id, describe(platform, id)});
        }
    }
    return devices;
}

std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& choice) {
    if (devices.empty()) refuse(devices, "no OpenCL device was found");

    std::size_t number = 0;
    const auto [end, error] = std::from_chars(choice.data(), choice.data() + choice.size(), number);
    if (!choice.empty() && end == choice.data() + choice.size()) {
        if (error != std::errc() || number >= devices.size()) refuse(devices, "no OpenCL device has the number " + choice);
        if (!devices[number].fp64) refuse(devices, "OpenCL device " + choice + " has no double precision");
        return number;
    }

    const std::string wanted = lower(choice);
    const bool by_type = wanted == "cpu" || wanted == "gpu" || wanted == "accelerator";
    bool without_fp64 = false;
    std::size_t first = devices.size();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& device = devices[i];
        const bool fits = by_type ? device.type == wanted
                                  : lower(device.name + '\n' + device.platform).find(wanted) != std::string::npos;
        if (!fits) continue;
        if (!device.fp64) {
            without_fp64 = true;
        } else if (!wanted.empty() || device.type == "gpu") {
            return i;
        } else {
            first = std::min(first, i);
        }
    }
    if (first < devices.size()) return first;
    const std::string which = choice.empty() ? "" : by_type ? " of the type " + wanted : " has \"" + choice + "\" in its name";
    refuse(devices, without_fp64 ? "no OpenCL device" + which + (choice.empty() || by_type ? " has" : " and") + " double precision"
                                 : "no OpenCL device" + which + (by_type ? " was found" : ""),
           by_type || without_fp64 ? "" : choice);
}

std::vector<std::size_t> choose_devices(const std::vector<DeviceInfo>& devices, const std::string& choice) {
    std::vector<std::size_t> chosen;
    if (lower(choice) == "gpus") {
        for (std::size_t i = 0; i < devices.size(); ++i)
            if (devices[i].type == "gpu" && devices[i].fp64) chosen.push_back(i);
        if (chosen.empty()) refuse(devices, "no OpenCL device of the type gpu was found that has double precision");
        return chosen;
    }
    std::istringstream parts(choice);
    for (std::string part; std::getline(parts, part, ',') || chosen.empty();) {
        chosen.push_back(choose_device(devices, part));
        if (std::count(chosen.begin(), chosen.end(), chosen.back()) > 1)
            refuse(devices, "\"" + choice + "\" means OpenCL device " + std::to_string(chosen.back()) + " twice");
    }
    return chosen;
}

std::vector<DeviceInfo> infos_of(const std::vector<FoundDevice>& devices) {
    std::vector<DeviceInfo> all;
    for (const FoundDevice& device : devices) all.push_back(device.info);
    return all;
}

std::vector<DeviceInfo> devices() { return infos_of(find_devices()); }

void prepare_devices() {
    // Whoever needs the devices waits for find_devices(), and is told what is wrong with them. Where there is no thread to be
    // had, nothing is looked for before.
    static const std::future<void> looking = std::async([] {
        try {
            find_devices();
        } catch (const std::exception&) {
        }
    });
}

}  // namespace csgrt
