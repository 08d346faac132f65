#include "device/device_plan.hpp"

#include <algorithm>
#include <chrono>
#include <future>
#include <utility>

#ifdef __linux__
#include <unistd.h>
#endif

#include "base/letters.hpp"
#include "base/process.hpp"
#include "base/thread.hpp"
#include "device/choice.hpp"

namespace csgrt {
namespace {

std::vector<FoundDevice> pick(const std::vector<FoundDevice>& devices, const std::vector<std::size_t>& numbers) {
    std::vector<FoundDevice> picked;
    for (const std::size_t number : numbers) picked.push_back(devices[number]);
    return picked;
}

bool is_processor(const FoundDevice& device) { return device.info.type == "cpu"; }

/// The GPU that the default choice prefers to processors, if there is one.
std::vector<FoundDevice> find_gpu() {
    const std::vector<FoundDevice> devices = find_devices().devices;
    const auto fits = [](const FoundDevice& device) { return device.info.type == "gpu" && device.info.fp64; };
    const auto gpu = std::find_if(devices.begin(), devices.end(), fits);
    return gpu == devices.end() ? std::vector<FoundDevice>{} : std::vector<FoundDevice>{*gpu};
}

/// The native device that `settings` name, if it is known without loading a driver: the best native device stands
/// before all other processors. Of several choices with commas, one may be a number, which counts all devices.
std::vector<FoundDevice> chosen_native(const Settings& settings) {
    const std::string choice = lower(settings.device);
    const bool is_one = choice == "cpu" || (choice.starts_with("native") && choice.find(',') == std::string::npos);
    if (!is_one || kernels_for(settings) != Kernels::any) return {};
    const std::vector<FoundDevice> native = find_native_devices();
    if (native.empty()) return {};
    try {
        return pick(native, choose_devices(infos_of(native), settings.device));
    } catch (const Error&) {  // the caller, which will look at all devices, reports the error
        return {};
    }
}

/// The native device, if it draws by default.
std::vector<FoundDevice> native_by_default(const Settings& settings) {
    std::vector<FoundDevice> native;
    if (kernels_for(settings) == Kernels::any) native = find_native_devices();
    if (native.size() > 1) native.resize(1);
    return native;
}

DevicePlan plan_default(const Settings& settings) {
    DevicePlan plan;
    plan.first = native_by_default(settings);
    if (!plan.first.empty()) {
        if (!may_have_gpu()) return plan;
        plan.find_next = find_gpu;
        plan.next = "gpu";
        return plan;
    }
    Discovery found = find_devices();
    const Kernels kernels = kernels_for(settings);
    try {
        plan.first = pick(found.devices, choose_devices(infos_of(found.devices), "", kernels));
    } catch (const Error&) {
        if (kernels != Kernels::any) throw;
        plan.notes = std::move(found.notes);
        plan.notes.push_back("there is no OpenCL device with double precision");
    }
    return plan;
}

/// Throws `error`, and adds the faults of drivers that cannot be used, because the named device may need such a driver.
[[noreturn]] void refuse_with(const Discovery& found, const Error& error) {
    std::vector<Diagnostic> findings = error.diagnostics();
    for (const std::string& note : found.notes) findings.back().suggestion += "\n" + note;
    throw Error(found.lacked_memory ? Status::out_of_memory : error.status(), std::move(findings));
}

DevicePlan plan_chosen(const Settings& settings) {
    DevicePlan plan;
    plan.is_default = false;
    plan.first = chosen_native(settings);
    if (!plan.first.empty()) return plan;
    const Discovery found = find_devices();
    try {
        plan.first =
            pick(found.devices, choose_devices(infos_of(found.devices), settings.device, kernels_for(settings)));
    } catch (const Error& error) {
        refuse_with(found, error);
    }
    std::vector<FoundDevice> native = native_by_default(settings);
    const bool are_processors = std::all_of(plan.first.begin(), plan.first.end(), is_processor);
    if (settings.wait_for_device || are_processors || native.empty()) return plan;
    for (const FoundDevice& device : plan.first) plan.next += (plan.next.empty() ? "" : " + ") + device.info.name;
    plan.find_next = [chosen = std::move(plan.first)] { return chosen; };
    plan.first = std::move(native);
    return plan;
}

#ifdef __linux__
/// Makes the main thread wait for the search at exit. exit() destroys the thread-local objects of the calling thread
/// first, and then all static objects, the youngest first. So libraries that the search loads would be destroyed before
/// any static object that could wait.
struct WaitAtExit {
    const std::future<void>& looking;
    unsigned process = process_number();
    ~WaitAtExit() {
        if (process == process_number() && looking.wait_for(std::chrono::seconds(0)) != std::future_status::deferred)
            looking.wait();
    }
};
#endif

}  // namespace

bool may_use_drivers(const Settings& settings) {
    if (settings.reference) return false;
    if (settings.device.empty()) return native_by_default(settings).empty() || may_have_gpu();
    return chosen_native(settings).empty();
}

DevicePlan plan_devices(const Settings& settings) {
    return settings.device.empty() ? plan_default(settings) : plan_chosen(settings);
}

void prepare_devices(const Settings& settings) {
    const FloatingPoint own;
    if (!may_use_drivers(settings) || !has_drivers()) return;
    // A caller that needs the devices waits in find_devices(), which reports their faults. If no thread is available,
    // there is no search ahead.
    static const std::unique_ptr<std::future<void>, DeleteOwn> looking(new std::future<void>(start_async([] {
        try {
            find_devices();
        } catch (const std::exception&) {
        }
    })));
#ifdef __linux__
    if (gettid() == getpid()) {
        static thread_local const WaitAtExit wait{*looking};
    }
#endif
}

}  // namespace csgrt
