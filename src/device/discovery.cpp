#include "device/driver_call.hpp"
#include "device/discovery.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>

#include "base/load_fault.hpp"
#include "base/process.hpp"
#include "base/thread.hpp"
#include "native/driver.hpp"
#include "device/opencl/opencl.hpp"
#include "device/opencl/opencl_loader.hpp"

namespace csgrt {

namespace {

constexpr cl_int platform_not_found = -1001;  // the ICD loader's code (cl_khr_icd) if no driver is installed

template <class Get>
std::string text_of(Get get, const char* call) {
    std::size_t size = 0;
    check(get(0, nullptr, &size), call);
    std::string text(size, '\0');
    check(get(size, text.data(), nullptr), call);
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
    return text;
}

std::string device_text(const OpenCl& cl, cl_device_id id, cl_device_info what) {
    return text_of(
        [&](std::size_t size, void* out, std::size_t* needed) { return cl.GetDeviceInfo(id, what, size, out, needed); },
        "clGetDeviceInfo");
}

template <class T>
T device_value(const OpenCl& cl, cl_device_id id, cl_device_info what) {
    T value{};
    check(cl.GetDeviceInfo(id, what, sizeof value, &value, nullptr), "clGetDeviceInfo");
    return value;
}

std::string platform_text(const OpenCl& cl, cl_platform_id platform) {
    return text_of(
        [&](std::size_t size, void* out, std::size_t* needed) {
            return cl.GetPlatformInfo(platform, CL_PLATFORM_NAME, size, out, needed);
        },
        "clGetPlatformInfo");
}

/// The machine that a test simulates.
struct Pretence {
    std::string platform;
    bool are_broken = false;
};
std::atomic<const OpenCl*> native_table{&native::functions()};
std::mutex pretence_mutex;
Pretence pretence;

Pretence pretended() {
    const std::lock_guard lock(pretence_mutex);
    return pretence;
}
bool is_pretended(const std::string& platform) { return !platform.empty() && platform == pretended().platform; }

DeviceInfo describe(const OpenCl& cl, cl_platform_id platform, cl_device_id id) {
    DeviceInfo info;
    info.name = device_text(cl, id, CL_DEVICE_NAME);
    info.platform = platform_text(cl, platform);
    info.version = device_text(cl, id, CL_DEVICE_VERSION);
    info.driver = device_text(cl, id, CL_DRIVER_VERSION);
    const auto type = device_value<cl_device_type>(cl, id, CL_DEVICE_TYPE);
    info.type = type & CL_DEVICE_TYPE_GPU || is_pretended(info.platform) ? "gpu"
                : type & CL_DEVICE_TYPE_CPU                              ? "cpu"
                                                                         : "accelerator";
    info.memory = device_value<cl_ulong>(cl, id, CL_DEVICE_GLOBAL_MEM_SIZE);
    info.max_allocation = device_value<cl_ulong>(cl, id, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
    info.compute_units = device_value<cl_uint>(cl, id, CL_DEVICE_MAX_COMPUTE_UNITS);
    info.fp64 = (" " + device_text(cl, id, CL_DEVICE_EXTENSIONS) + " ").find(" cl_khr_fp64 ") != std::string::npos;
    return info;
}

std::vector<FoundDevice> devices_of(const OpenCl& cl, cl_platform_id platform) {
    cl_uint count = 0;
    const cl_int code = cl.GetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count);
    if (code == CL_DEVICE_NOT_FOUND || (code == CL_SUCCESS && count == 0)) return {};
    check(code, "clGetDeviceIDs");
    std::vector<cl_device_id> ids(count);
    check(cl.GetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, ids.data(), nullptr), "clGetDeviceIDs");
    std::vector<FoundDevice> devices;
    for (const cl_device_id id : ids) {
        if (!device_value<cl_bool>(cl, id, CL_DEVICE_AVAILABLE)) continue;
        devices.push_back({&cl, id, describe(cl, platform, id)});
        if (is_pretended(devices.back().info.platform) && pretended().are_broken) devices.back().id = nullptr;
    }
    return devices;
}

/// Adds the devices of each platform. If a platform fails, a note is added, and other platforms are still used.
void add_devices(const OpenCl& cl, Discovery& found) {
    cl_uint count = 0;
    const cl_int code = cl.GetPlatformIDs(0, nullptr, &count);
    if (code == platform_not_found || (code == CL_SUCCESS && count == 0)) return;
    std::vector<cl_platform_id> platforms(count);
    try {
        check(code, "clGetPlatformIDs");
        check(cl.GetPlatformIDs(count, platforms.data(), nullptr), "clGetPlatformIDs");
    } catch (const Error& error) {
        found.lacked_memory |= error.status() == Status::out_of_memory;
        found.notes.push_back("OpenCL cannot be used: " + std::string(error.what()));
        return;
    }
    for (const cl_platform_id platform : platforms) {
        std::string name = "an OpenCL driver without a name";
        try {
            name = platform_text(cl, platform);
            for (FoundDevice& device : devices_of(cl, platform)) found.devices.push_back(std::move(device));
        } catch (const Error& error) {
            found.lacked_memory |= error.status() == Status::out_of_memory;
            found.notes.push_back("the OpenCL driver \"" + name + "\" cannot be used: " + error.what());
        }
    }
}

/// Adds native devices. The best one stands before all other processors. The other levels, which do not use all of this
/// processor's instructions, stand last.
void add_native(Discovery& found) {
    std::vector<FoundDevice> native = find_native_devices();
    if (native.empty()) return;
    const auto is_cpu = [](const FoundDevice& device) { return device.info.type == "cpu"; };
    found.devices.insert(std::find_if(found.devices.begin(), found.devices.end(), is_cpu), std::move(native.front()));
    std::move(native.begin() + 1, native.end(), std::back_inserter(found.devices));
}

#ifdef __linux__
bool has_render_node(const std::filesystem::path& folder) {
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (entry->path().filename().string().starts_with("renderD")) return true;
    return static_cast<bool>(error) && std::filesystem::exists(folder, error);  // the folder exists but cannot be read
}
#endif

}  // namespace

bool has_drivers() {
    static FirstUser user;
    return user.is_this_process();
}

std::vector<FoundDevice> find_native_devices() {
    Discovery native;
    if (const OpenCl* const functions = native_table) add_devices(*functions, native);
    return std::move(native.devices);
}

Discovery find_devices() {
    Discovery found;
    if (has_drivers()) {
        // Only one thread at a time searches: if two begin at once, ocl-icd tells the second that there is no device,
        // and PoCL crashes.
        static std::mutex mutex;
        const std::lock_guard lock(mutex);
        const BlockedSignals blocked;
        const OpenClLoader& loader = opencl_loader();
        if (loader.functions) {
            static bool lacked = false;  // ocl-icd loads drivers once, and does not report those that fail
            static_cast<void>(last_load_fault());
            add_devices(*loader.functions, found);
            lacked |= lacked_memory(last_load_fault());
            if (lacked) found.notes.push_back("a driver of OpenCL cannot be used: there was not enough memory");
            found.lacked_memory |= lacked;
            wait_for_driver_calls_at_exit();
        }
        found.lacked_memory |= lacked_memory(loader.fault);
        if (!loader.fault.empty()) found.notes.push_back("the OpenCL loader cannot be opened: " + loader.fault);
    } else {
        found.notes.push_back(
            "OpenCL cannot be used: its drivers were loaded before this process was forked, and serve the parent only");
    }
    add_native(found);
    return found;
}

bool may_have_gpu(const std::string& folder) {
    if (!pretended().platform.empty()) return true;
#ifdef __linux__
    const std::filesystem::path root = folder;
    // Device files of the drivers of NVIDIA, AMD, WSL, Arm and Qualcomm; all others draw through the kernel's render
    // nodes.
    for (const char* name : {"nvidiactl", "nvidia0", "kfd", "dxg", "mali0", "kgsl-3d0"}) {
        std::error_code error;
        if (std::filesystem::exists(root / name, error)) return true;
    }
    return has_render_node(root / "dri");
#else
    static_cast<void>(folder);
    return true;
#endif
}

PretendedGpu::PretendedGpu(std::string platform, bool are_broken) {
    const std::lock_guard lock(pretence_mutex);
    pretence = {std::move(platform), are_broken};
}

PretendedGpu::~PretendedGpu() {
    const std::lock_guard lock(pretence_mutex);
    pretence = {};
}

NativeTable::NativeTable(const OpenCl* functions) { native_table = functions; }
NativeTable::~NativeTable() { native_table = &native::functions(); }

bool is_native(const DeviceInfo& device) { return device.platform == native::platform_name; }

bool is_pocl(const DeviceInfo& device) { return device.platform == "Portable Computing Language"; }

std::vector<DeviceInfo> infos_of(const std::vector<FoundDevice>& devices) {
    std::vector<DeviceInfo> all;
    for (const FoundDevice& device : devices) all.push_back(device.info);
    return all;
}

std::vector<DeviceInfo> devices(std::vector<std::string>* notes) {
    const FloatingPoint own;
    Discovery found = find_devices();
    if (notes) notes->insert(notes->end(), found.notes.begin(), found.notes.end());
    return infos_of(found.devices);
}

}  // namespace csgrt
