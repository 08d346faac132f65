// OpenCL's functions on top of others that work: one fails where a test wants it to, a device never answers, or a bit
// of what it answers is wrong. What is made and released is counted.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <csgrt/error.hpp>

#include "catch.hpp"
#include "device/opencl/opencl_table.hpp"
#include "thrown.hpp"

namespace csgrt::test {

enum class Call : std::size_t {
#define CSGRT_CALL(name) name,
    CSGRT_OPENCL_FUNCTIONS(CSGRT_CALL)
#undef CSGRT_CALL
        count
};
inline constexpr std::size_t calls = static_cast<std::size_t>(Call::count);
inline constexpr std::array<const char*, calls> call_names = {
#define CSGRT_CALL(name) "cl" #name,
    CSGRT_OPENCL_FUNCTIONS(CSGRT_CALL)
#undef CSGRT_CALL
};

/// The errors that OpenCL 1.2 lists for a function; those of images and of user's events are left out.
inline std::vector<cl_int> codes_of(Call call) {
    std::vector<cl_int> codes;
    const auto list = [&](std::initializer_list<cl_int> more) { codes.insert(codes.end(), more); };
    switch (call) {
        case Call::GetPlatformIDs:
            return {CL_INVALID_VALUE, CL_OUT_OF_HOST_MEMORY};
        case Call::GetPlatformInfo:
            return {CL_INVALID_PLATFORM, CL_INVALID_VALUE, CL_OUT_OF_HOST_MEMORY};
        case Call::GetDeviceIDs:
            list({CL_INVALID_PLATFORM, CL_INVALID_DEVICE_TYPE, CL_INVALID_VALUE, CL_DEVICE_NOT_FOUND});
            break;
        case Call::GetDeviceInfo:
            list({CL_INVALID_DEVICE, CL_INVALID_VALUE});
            break;
        case Call::CreateContext:
            list({CL_INVALID_PLATFORM, CL_INVALID_PROPERTY, CL_INVALID_VALUE, CL_INVALID_DEVICE,
                  CL_DEVICE_NOT_AVAILABLE});
            break;
        case Call::ReleaseContext:
            list({CL_INVALID_CONTEXT});
            break;
        case Call::CreateCommandQueue:
            list({CL_INVALID_CONTEXT, CL_INVALID_DEVICE, CL_INVALID_VALUE, CL_INVALID_QUEUE_PROPERTIES});
            break;
        case Call::RetainCommandQueue:
        case Call::ReleaseCommandQueue:
        case Call::Flush:
        case Call::Finish:
            list({CL_INVALID_COMMAND_QUEUE});
            break;
        case Call::CreateBuffer:
            list({CL_INVALID_CONTEXT, CL_INVALID_VALUE, CL_INVALID_BUFFER_SIZE, CL_INVALID_HOST_PTR,
                  CL_MEM_OBJECT_ALLOCATION_FAILURE});
            break;
        case Call::ReleaseMemObject:
            list({CL_INVALID_MEM_OBJECT});
            break;
        case Call::CreateProgramWithSource:
            list({CL_INVALID_CONTEXT, CL_INVALID_VALUE});
            break;
        case Call::CreateProgramWithBinary:
            list({CL_INVALID_CONTEXT, CL_INVALID_VALUE, CL_INVALID_DEVICE, CL_INVALID_BINARY});
            break;
        case Call::BuildProgram:
            list({CL_INVALID_PROGRAM, CL_INVALID_VALUE, CL_INVALID_DEVICE, CL_INVALID_BINARY, CL_INVALID_BUILD_OPTIONS,
                  CL_INVALID_OPERATION, CL_COMPILER_NOT_AVAILABLE, CL_BUILD_PROGRAM_FAILURE});
            break;
        case Call::ReleaseProgram:
            list({CL_INVALID_PROGRAM});
            break;
        case Call::GetProgramInfo:
            list({CL_INVALID_VALUE, CL_INVALID_PROGRAM, CL_INVALID_PROGRAM_EXECUTABLE});
            break;
        case Call::GetProgramBuildInfo:
            list({CL_INVALID_DEVICE, CL_INVALID_VALUE, CL_INVALID_PROGRAM});
            break;
        case Call::CreateKernel:
            list({CL_INVALID_PROGRAM, CL_INVALID_PROGRAM_EXECUTABLE, CL_INVALID_KERNEL_NAME,
                  CL_INVALID_KERNEL_DEFINITION, CL_INVALID_VALUE});
            break;
        case Call::ReleaseKernel:
            list({CL_INVALID_KERNEL});
            break;
        case Call::GetKernelInfo:
            list({CL_INVALID_VALUE, CL_INVALID_KERNEL});
            break;
        case Call::SetKernelArg:
            return {CL_INVALID_KERNEL,   CL_INVALID_ARG_INDEX, CL_INVALID_ARG_VALUE, CL_INVALID_MEM_OBJECT,
                    CL_INVALID_ARG_SIZE, CL_OUT_OF_RESOURCES,  CL_OUT_OF_HOST_MEMORY};
        case Call::EnqueueNDRangeKernel:
            list({CL_INVALID_PROGRAM_EXECUTABLE, CL_INVALID_COMMAND_QUEUE, CL_INVALID_KERNEL, CL_INVALID_CONTEXT,
                  CL_INVALID_KERNEL_ARGS, CL_INVALID_WORK_DIMENSION, CL_INVALID_GLOBAL_WORK_SIZE,
                  CL_INVALID_GLOBAL_OFFSET, CL_INVALID_WORK_GROUP_SIZE, CL_INVALID_WORK_ITEM_SIZE,
                  CL_MISALIGNED_SUB_BUFFER_OFFSET, CL_MEM_OBJECT_ALLOCATION_FAILURE, CL_INVALID_EVENT_WAIT_LIST});
            break;
        case Call::EnqueueWriteBuffer:
        case Call::EnqueueReadBuffer:
        case Call::EnqueueReadBufferRect:
        case Call::EnqueueFillBuffer:
            list({CL_INVALID_COMMAND_QUEUE, CL_INVALID_CONTEXT, CL_INVALID_MEM_OBJECT, CL_INVALID_VALUE,
                  CL_INVALID_EVENT_WAIT_LIST, CL_MISALIGNED_SUB_BUFFER_OFFSET, CL_MEM_OBJECT_ALLOCATION_FAILURE});
            if (call != Call::EnqueueFillBuffer)
                list({CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST, CL_INVALID_OPERATION});
            break;
        case Call::EnqueueMapBuffer:
            list({CL_INVALID_COMMAND_QUEUE, CL_INVALID_CONTEXT, CL_INVALID_MEM_OBJECT, CL_INVALID_VALUE,
                  CL_INVALID_EVENT_WAIT_LIST, CL_MISALIGNED_SUB_BUFFER_OFFSET, CL_MAP_FAILURE,
                  CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST, CL_MEM_OBJECT_ALLOCATION_FAILURE,
                  CL_INVALID_OPERATION});
            break;
        case Call::EnqueueUnmapMemObject:
            list({CL_INVALID_COMMAND_QUEUE, CL_INVALID_MEM_OBJECT, CL_INVALID_VALUE, CL_INVALID_EVENT_WAIT_LIST,
                  CL_INVALID_CONTEXT});
            break;
        case Call::EnqueueMarkerWithWaitList:
            list({CL_INVALID_COMMAND_QUEUE, CL_INVALID_CONTEXT, CL_INVALID_EVENT_WAIT_LIST,
                  CL_MEM_OBJECT_ALLOCATION_FAILURE});
            break;
        case Call::WaitForEvents:
            list(
                {CL_INVALID_VALUE, CL_INVALID_CONTEXT, CL_INVALID_EVENT, CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST});
            break;
        case Call::ReleaseEvent:
            list({CL_INVALID_EVENT});
            break;
        case Call::GetEventInfo:
            list({CL_INVALID_VALUE, CL_INVALID_EVENT});
            break;
        case Call::GetEventProfilingInfo:
            list({CL_PROFILING_INFO_NOT_AVAILABLE, CL_INVALID_VALUE, CL_INVALID_EVENT});
            break;
        case Call::count:
            break;
    }
    list({CL_OUT_OF_RESOURCES, CL_OUT_OF_HOST_MEMORY});
    return codes;
}

/// One at a time. Any thread may call its functions.
class FaultyOpenCl {
public:
    static constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

    explicit FaultyOpenCl(const OpenCl& working) {
        state().working = &working;
        reset();
        live() = 0;
    }

    const OpenCl& functions() const {
        static const OpenCl all = {
#define CSGRT_FORWARD(name) .name = Forward<Call::name, &OpenCl::name>::call,
            CSGRT_OPENCL_FUNCTIONS(CSGRT_FORWARD)
#undef CSGRT_FORWARD
        };
        return all;
    }

    /// All is well from now on, and calls are counted from 0.
    void reset() {
        for (auto& count : state().counts) count = 0;
        state().failing = Call::count;
        state().tampered = Call::count;
        state().events = 0;
        state().last_event = never;
        state().asked_when_hung = 0;
    }
    std::size_t count(Call call) const { return state().counts[static_cast<std::size_t>(call)]; }
    std::size_t all_calls() const {
        std::size_t sum = 0;
        for (const auto& count : state().counts) sum += count;
        return sum;
    }
    /// The call with this number, from 1 on, fails; what releases something has released it.
    void fail(Call call, std::size_t number, cl_int code) {
        state().failing = call;
        state().number = number;
        state().code = code;
    }
    /// After so many events none is ever done, and a wait within the driver is counted by waits().
    void hang_after(std::size_t events) { state().last_event = events; }
    std::size_t events() const { return state().events; }
    std::size_t waits() const { return state().asked_when_hung; }
    /// The read or map with this number has a bit wrong, in the middle of its bytes.
    void tamper(Call call, std::size_t number) {
        state().tampered = call;
        state().number = number;
    }
    /// Objects that were made, or retained, and not released.
    static std::atomic<long>& live() {
        static std::atomic<long> objects{0};
        return objects;
    }

private:
    struct State {
        const OpenCl* working = nullptr;
        std::array<std::atomic<std::size_t>, calls> counts{};
        std::atomic<Call> failing{Call::count}, tampered{Call::count};
        std::atomic<std::size_t> number{0}, events{0}, last_event{never}, asked_when_hung{0};
        std::atomic<cl_int> code{0};
        std::atomic<cl_command_queue> queue{nullptr};
    };
    static State& state() {
        static State only;
        return only;
    }

    static constexpr bool makes(Call call) {
        return call == Call::CreateContext || call == Call::CreateCommandQueue || call == Call::CreateBuffer ||
               call == Call::CreateProgramWithSource || call == Call::CreateProgramWithBinary ||
               call == Call::CreateKernel;
    }
    static constexpr bool releases(Call call) {
        return call == Call::ReleaseContext || call == Call::ReleaseCommandQueue || call == Call::ReleaseMemObject ||
               call == Call::ReleaseProgram || call == Call::ReleaseKernel || call == Call::ReleaseEvent;
    }
    static bool hangs() { return state().events > state().last_event; }

    template <Call call, auto member>
    struct Forward;
    template <Call name, class Result, class... Arguments, Result (*OpenCl::*member)(Arguments...)>
    struct Forward<name, member> {
        static Result call(Arguments... arguments) {
            State& s = state();
            const std::size_t mine = ++s.counts[static_cast<std::size_t>(name)];
            const bool fails = s.failing == name && s.number == mine;
            if (fails && !releases(name)) return failure(arguments...);
            if (hangs()) {
                if constexpr (name == Call::WaitForEvents || name == Call::Finish) ++s.asked_when_hung;
                if constexpr (name == Call::EnqueueReadBuffer || name == Call::EnqueueMapBuffer)
                    s.asked_when_hung += blocks(arguments...);
                if constexpr (name == Call::GetEventInfo) return not_done(arguments...);
            }
            const Result result = (s.working->*member)(arguments...);
            if constexpr (makes(name)) live() += result != nullptr;
            if constexpr (name == Call::CreateCommandQueue) s.queue = result;
            if constexpr (name == Call::RetainCommandQueue) live() += result == CL_SUCCESS;
            if constexpr (releases(name)) --live();
            (count_event(arguments), ...);
            if (s.tampered == name && s.number == mine) {
                if constexpr (name == Call::EnqueueReadBuffer) flip_read(arguments...);
                if constexpr (name == Call::EnqueueMapBuffer) flip(result, bytes_of_map(arguments...));
            }
            if constexpr (std::is_same_v<Result, cl_int>) {
                if (fails) return s.code;
            }
            return result;
        }

        static Result failure(Arguments... arguments) {
            if constexpr (std::is_same_v<Result, cl_int>) {
                return state().code;
            } else {
                (set_code(arguments), ...);
                return nullptr;
            }
        }
    };

    template <class T>
    static void set_code(T argument) {
        if constexpr (std::is_same_v<T, cl_int*>) {
            if (argument) *argument = state().code;
        }
    }
    template <class T>
    static void count_event(T argument) {
        if constexpr (std::is_same_v<T, cl_event*>) {
            if (argument == nullptr || *argument == nullptr) return;
            ++state().events;
            ++live();
        }
    }
    template <class... More>
    static bool blocks(cl_command_queue, cl_mem, cl_bool wait, More...) {
        return wait == CL_TRUE;
    }
    static cl_int not_done(cl_event, cl_event_info what, std::size_t, void* out, std::size_t*) {
        if (what == CL_EVENT_COMMAND_QUEUE)
            *static_cast<cl_command_queue*>(out) = state().queue;
        else
            *static_cast<cl_int*>(out) = CL_RUNNING;
        return CL_SUCCESS;
    }
    static void flip(void* data, std::size_t bytes) { static_cast<unsigned char*>(data)[bytes / 2] ^= 4; }
    static void flip_read(cl_command_queue, cl_mem, cl_bool, std::size_t, std::size_t bytes, void* to, cl_uint,
                          const cl_event*, cl_event*) {
        flip(to, bytes);
    }
    static std::size_t bytes_of_map(cl_command_queue, cl_mem, cl_bool, cl_map_flags, std::size_t, std::size_t bytes,
                                    cl_uint, const cl_event*, cl_event*, cl_int*) {
        return bytes;
    }
};

/// What a call says that fails as a device's fault; empty: it does not fail.
inline std::string failure(const std::function<void()>& call) { return failure(Status::device_fault, call); }

}  // namespace csgrt::test
