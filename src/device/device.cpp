#include "device/device.hpp"

#include <algorithm>
#include <vector>

#include "base/thread.hpp"
#include "device/choice.hpp"
#include "device/host_memory.hpp"
#include "native/driver.hpp"
#include "device/bytes_text.hpp"

namespace csgrt {

namespace {

/// The default budget for buffers. A driver takes some memory for itself and does not report how much. A device that
/// shares the host's memory leaves half of it to the host.
std::uint64_t default_budget(const DeviceInfo& info, bool shares_host_memory) {
    if (!shares_host_memory) return info.memory / 8 * 7;
    const std::uint64_t host = available_host_memory();
    return std::min(info.memory, host ? host : info.memory) / 2;
}

/// The default time limit of a kernel in seconds: a longer kernel would keep a GPU's other users waiting. Processors
/// have no limit.
constexpr double default_timeout = 60;

double patience_with(const DeviceInfo& info, double timeout) {
    return timeout >= 0 ? timeout : info.type == "cpu" ? 0 : default_timeout;
}

FoundDevice chosen(const std::string& choice) {
    const std::vector<FoundDevice> found = find_devices().devices;
    return found[choose_device(infos_of(found), choice)];
}

}  // namespace

Device::Device(const std::string& choice, std::uint64_t max_memory) : Device(chosen(choice), max_memory) {}

Device::Device(const FoundDevice& device, std::uint64_t max_memory, double timeout)
    : info_(device.info),
      cl_(std::make_shared<const Driver>(*device.cl, info_.name, patience_with(info_, timeout))),
      id_(device.id) {
    const cl_context_properties properties[] = {native::stop_property, reinterpret_cast<cl_context_properties>(&stop_),
                                                0};
    cl_int code = CL_SUCCESS;
    const BlockedSignals blocked;  // drivers start threads in this scope
    context_ =
        Context(cl(), cl().CreateContext(is_native(info_) ? properties : nullptr, 1, &id_, nullptr, nullptr, &code));
    check(code, "clCreateContext (" + info_.name + ")");
    for (auto& queue : queues_) {
        queue = Queue(cl(), cl().CreateCommandQueue(context(), id_, CL_QUEUE_PROFILING_ENABLE, &code));
        check(code, "clCreateCommandQueue (" + info_.name + ")");
    }
    copy_queue_ = Queue(cl(), cl().CreateCommandQueue(context(), id_, 0, &code));
    check(code, "clCreateCommandQueue (copies, " + info_.name + ")");

    cl_bool unified = CL_FALSE;
    check(cl().GetDeviceInfo(id_, CL_DEVICE_HOST_UNIFIED_MEMORY, sizeof unified, &unified, nullptr), "clGetDeviceInfo");
    budget_ = max_memory ? max_memory : default_budget(info_, unified || info_.type == "cpu");
    max_buffer_ = std::min(budget_, info_.max_allocation);
}

void Device::check_end() const {
    cl_->check_lost();
    if (stop_ && *stop_) throw Error(Status::interrupted, "interrupted");
}

void Device::flush() const {
    cl_->check_lost();
    check(cl().Flush(queue()), "clFlush");
}

void Device::flush_copies() const {
    cl_->check_lost();
    check(cl().Flush(copy_queue()), "clFlush (copies)");
}

void Device::finish() const {
    for (const auto& queue : queues_) {
        if (cl_->patience == 0) {
            check(cl().Finish(queue.get()), "clFinish");
            continue;
        }
        cl_->check_lost();
        cl_event end = nullptr;
        check(cl().EnqueueMarkerWithWaitList(queue.get(), 0, nullptr, &end), "clEnqueueMarkerWithWaitList");
        wait_for(Event(cl(), end));
    }
}

void Device::claim(const std::string& name, std::uint64_t bytes) {
    if (bytes > info_.max_allocation) {
        throw Error(Status::out_of_memory, "device memory: \"" + name + "\" needs " + bytes_text(bytes) +
                                               ", but one buffer may take " + bytes_text(info_.max_allocation) +
                                               " on " + info_.name);
    }
    if (bytes > available()) {
        std::string holders;
        for (const auto& [holder, held] : allocations_) {
            holders += (holders.empty() ? "; in use: " : ", ") + holder + " " + bytes_text(held);
        }
        throw Error(Status::out_of_memory, "device memory: \"" + name + "\" needs " + bytes_text(bytes) + ", but of " +
                                               bytes_text(budget_) + " only " + bytes_text(available()) +
                                               " are free on " + info_.name + holders);
    }
    allocations_[name] += bytes;
    allocated_ += bytes;
}

void Device::release(const std::string& name, std::uint64_t bytes) noexcept {
    allocated_ -= bytes;
    const auto entry = allocations_.find(name);
    if (entry != allocations_.end() && (entry->second -= bytes) == 0) allocations_.erase(entry);
}

}  // namespace csgrt
