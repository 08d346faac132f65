#include "device/opencl/opencl.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <csgrt/error.hpp>

#include "base/clock.hpp"

namespace csgrt {

const char* opencl_error_name(cl_int code) noexcept {
#define CSGRT_NAME(x) \
    case x:           \
        return #x
    switch (code) {
        CSGRT_NAME(CL_SUCCESS);
        CSGRT_NAME(CL_DEVICE_NOT_FOUND);
        CSGRT_NAME(CL_DEVICE_NOT_AVAILABLE);
        CSGRT_NAME(CL_COMPILER_NOT_AVAILABLE);
        CSGRT_NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE);
        CSGRT_NAME(CL_OUT_OF_RESOURCES);
        CSGRT_NAME(CL_OUT_OF_HOST_MEMORY);
        CSGRT_NAME(CL_PROFILING_INFO_NOT_AVAILABLE);
        CSGRT_NAME(CL_MEM_COPY_OVERLAP);
        CSGRT_NAME(CL_IMAGE_FORMAT_MISMATCH);
        CSGRT_NAME(CL_IMAGE_FORMAT_NOT_SUPPORTED);
        CSGRT_NAME(CL_BUILD_PROGRAM_FAILURE);
        CSGRT_NAME(CL_MAP_FAILURE);
        CSGRT_NAME(CL_MISALIGNED_SUB_BUFFER_OFFSET);
        CSGRT_NAME(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST);
        CSGRT_NAME(CL_COMPILE_PROGRAM_FAILURE);
        CSGRT_NAME(CL_LINKER_NOT_AVAILABLE);
        CSGRT_NAME(CL_LINK_PROGRAM_FAILURE);
        CSGRT_NAME(CL_DEVICE_PARTITION_FAILED);
        CSGRT_NAME(CL_KERNEL_ARG_INFO_NOT_AVAILABLE);
        CSGRT_NAME(CL_INVALID_VALUE);
        CSGRT_NAME(CL_INVALID_DEVICE_TYPE);
        CSGRT_NAME(CL_INVALID_PLATFORM);
        CSGRT_NAME(CL_INVALID_DEVICE);
        CSGRT_NAME(CL_INVALID_CONTEXT);
        CSGRT_NAME(CL_INVALID_QUEUE_PROPERTIES);
        CSGRT_NAME(CL_INVALID_COMMAND_QUEUE);
        CSGRT_NAME(CL_INVALID_HOST_PTR);
        CSGRT_NAME(CL_INVALID_MEM_OBJECT);
        CSGRT_NAME(CL_INVALID_BINARY);
        CSGRT_NAME(CL_INVALID_BUILD_OPTIONS);
        CSGRT_NAME(CL_INVALID_PROGRAM);
        CSGRT_NAME(CL_INVALID_PROGRAM_EXECUTABLE);
        CSGRT_NAME(CL_INVALID_KERNEL_NAME);
        CSGRT_NAME(CL_INVALID_KERNEL_DEFINITION);
        CSGRT_NAME(CL_INVALID_KERNEL);
        CSGRT_NAME(CL_INVALID_ARG_INDEX);
        CSGRT_NAME(CL_INVALID_ARG_VALUE);
        CSGRT_NAME(CL_INVALID_ARG_SIZE);
        CSGRT_NAME(CL_INVALID_KERNEL_ARGS);
        CSGRT_NAME(CL_INVALID_WORK_DIMENSION);
        CSGRT_NAME(CL_INVALID_WORK_GROUP_SIZE);
        CSGRT_NAME(CL_INVALID_WORK_ITEM_SIZE);
        CSGRT_NAME(CL_INVALID_GLOBAL_OFFSET);
        CSGRT_NAME(CL_INVALID_EVENT_WAIT_LIST);
        CSGRT_NAME(CL_INVALID_EVENT);
        CSGRT_NAME(CL_INVALID_OPERATION);
        CSGRT_NAME(CL_INVALID_BUFFER_SIZE);
        CSGRT_NAME(CL_INVALID_GLOBAL_WORK_SIZE);
        CSGRT_NAME(CL_INVALID_PROPERTY);
        CSGRT_NAME(CL_INVALID_COMPILER_OPTIONS);
        CSGRT_NAME(CL_INVALID_LINKER_OPTIONS);
        case -1001:
            return "CL_PLATFORM_NOT_FOUND_KHR";
        default:
            return "an unknown error";
    }
#undef CSGRT_NAME
}

void check(cl_int code, std::string_view call) {
    if (code == CL_SUCCESS) return;
    const bool memory = code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_HOST_MEMORY;
    throw Error(memory ? Status::out_of_memory : Status::device_fault,
                std::string(call) + " failed: " + opencl_error_name(code) + " (" + std::to_string(code) + ")");
}

void Driver::check_lost() const {
    if (is_lost) give_up();
}

void Driver::give_up() const {
    is_lost = true;
    char seconds[32];
    const std::string text(seconds, std::to_chars(seconds, std::end(seconds), patience).ptr);
    if (patience == 0) throw Error(Status::device_fault, device + " is used no more: memory ended in its driver");
    throw Error(Status::device_fault,
                {Diagnostic{.message = device + " gave no answer for " + text + " s and is used no more",
                            .suggestion = "Use another device, or give it more time (--device-timeout, "
                                          "Settings::device_timeout)"}});
}

void keep_for_ever(std::shared_ptr<const void> memory) {
    static std::mutex mutex;
    static auto& kept = *new std::vector<std::shared_ptr<const void>>;
    const std::lock_guard lock(mutex);
    kept.push_back(std::move(memory));
}

namespace {

/// A wait of the host with a time limit. A wait within the driver has no limit, but returns as soon as the event is
/// done.
class Wait {
public:
    explicit Wait(const Driver& driver) : driver_(driver), begin_(Clock::now()) {}
    double ms() const { return milliseconds_since(begin_); }
    void check() const {
        driver_.check_lost();
        if (driver_.patience > 0 && ms() > 1000 * driver_.patience) driver_.give_up();
    }

private:
    const Driver& driver_;
    Clock::time_point begin_;
};

void flush_queue_of(const Event& event) {
    cl_command_queue queue = nullptr;
    check(event.cl().GetEventInfo(event.get(), CL_EVENT_COMMAND_QUEUE, sizeof queue, &queue, nullptr),
          "clGetEventInfo");
    check(event.cl().Flush(queue), "clFlush");
}

}  // namespace

void wait_for(const Event& event) {
    if (!event) return;
    if (event.cl().patience > 0 && !is_done(event)) {
        constexpr double at_once_ms = 2;  // the host first polls without sleeping, as drivers do for short commands
        flush_queue_of(event);
        for (const Wait wait(event.cl()); !is_done(event) && wait.ms() < at_once_ms;) {
            wait.check();
            std::this_thread::yield();
        }
        const Event* const one = &event;
        wait_for_one({&one, 1});
    }
    const cl_event one = event.get();
    check(event.cl().WaitForEvents(1, &one), "clWaitForEvents");
}

bool is_done(const Event& event) {
    if (!event) return true;
    event.cl().check_lost();
    cl_int status = CL_COMPLETE;
    check(event.cl().GetEventInfo(event.get(), CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof status, &status, nullptr),
          "clGetEventInfo");
    return status <= CL_COMPLETE;
}

void wait_patiently(const Event& event) {
    const Event* const one = &event;
    wait_for_one({&one, 1});
    wait_for(event);
}

void wait_for_one(std::span<const Event* const> events) {
#ifdef __linux__
    struct Slack {  // with the usual slack, a sleep takes 50 microseconds longer
        const int before = prctl(PR_GET_TIMERSLACK);
        Slack() { prctl(PR_SET_TIMERSLACK, 1000ul); }
        ~Slack() { prctl(PR_SET_TIMERSLACK, static_cast<unsigned long>(before)); }
    } slack;
#endif
    std::optional<Wait> wait;
    while (std::ranges::none_of(events, [](const Event* event) { return is_done(*event); })) {
        if (!wait) wait.emplace(events.front()->cl());
        wait->check();
        std::this_thread::sleep_for(std::chrono::microseconds(10));
    }
}

void wait_until_done(const Event& event) noexcept {
    try {
        wait_for(event);
    } catch (...) {
    }
}

TimeSpan time_span(const Event& event) {
    if (!event) return {};
    wait_for(event);
    const cl_event one = event.get();
    cl_ulong begin = 0, end = 0;
    check(event.cl().GetEventProfilingInfo(one, CL_PROFILING_COMMAND_START, sizeof begin, &begin, nullptr),
          "clGetEventProfilingInfo");
    check(event.cl().GetEventProfilingInfo(one, CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr),
          "clGetEventProfilingInfo");
    return {begin, std::max(begin, end)};
}

}  // namespace csgrt
