#include "native/driver.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>

#include <csgrt/renderer.hpp>

#include "device/host_memory.hpp"
#include "native/kernels.hpp"
#include "base/parallel.hpp"

namespace csgrt::native {
namespace {

/// The number of the current work-item, in the form of builtins.h.
struct WorkItem {
    std::size_t id, size;
    const std::atomic<bool>* stop;
};
static_assert(sizeof(std::atomic<bool>) == 1 && std::atomic<bool>::is_always_lock_free, "kernels read it as a byte");
const std::atomic<bool> never{false};
thread_local WorkItem item;

}  // namespace
}  // namespace csgrt::native

extern "C" void* csgrt_native_item() { return &csgrt::native::item; }

namespace csgrt::native {
namespace {

// ---- The objects behind OpenCL's handles ----

struct Context {
    const std::atomic<bool>* const* stop = nullptr;
    std::mutex kernels;  ///< one kernel runs at a time
};
struct Queue {
    explicit Queue(Context& c) : context(c) {}

    Context& context;
    std::atomic<int> owners{1};
};
struct Memory {
    char* data;
    bool is_own;
};
struct BuiltProgram {
    std::string name;
    const Program* program = nullptr;  ///< null: not built, or refused
};
struct BuiltKernel {
    const CompiledKernel* compiled;
    std::vector<std::uint64_t> arguments;
};
struct Event {
    cl_ulong start, end;
};

template <class T, class Handle>
T& as(Handle handle) {
    return *reinterpret_cast<T*>(handle);
}
template <class Handle, class T>
Handle handle_of(T* object) {
    return reinterpret_cast<Handle>(object);
}

/// A device is an element of compiled_levels() that can run here. Its address is its handle.
const Level& level_of(cl_device_id device) { return *reinterpret_cast<const Level*>(device); }

int platform;  // only its address counts

cl_ulong now() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return static_cast<cl_ulong>(std::chrono::duration_cast<std::chrono::nanoseconds>(since).count());
}

void tell(cl_event* event, cl_ulong start) {
    if (event) *event = handle_of<cl_event>(new Event{start, now()});
}

void set(cl_int* code, cl_int value) {
    if (code) *code = value;
}

// ---- Information queries ----

cl_int answer(const void* value, std::size_t bytes, std::size_t room, void* out, std::size_t* needed) {
    if (needed) *needed = bytes;
    if (!out) return CL_SUCCESS;
    if (room < bytes) return CL_INVALID_VALUE;
    std::memcpy(out, value, bytes);
    return CL_SUCCESS;
}
cl_int answer(const std::string& text, std::size_t room, void* out, std::size_t* needed) {
    return answer(text.c_str(), text.size() + 1, room, out, needed);
}
template <class T>
requires std::is_arithmetic_v<T> cl_int answer(T value, std::size_t room, void* out, std::size_t* needed) {
    return answer(&value, sizeof value, room, out, needed);
}

std::string name_of(const Level& level) { return "native-" + std::string(level.name); }

cl_int get_platform_ids(cl_uint room, cl_platform_id* platforms, cl_uint* count) {
    if (count) *count = 1;
    if (platforms && room > 0) *platforms = handle_of<cl_platform_id>(&platform);
    return CL_SUCCESS;
}

cl_int get_platform_info(cl_platform_id, cl_platform_info what, std::size_t room, void* out, std::size_t* needed) {
    return what == CL_PLATFORM_NAME ? answer(std::string(platform_name), room, out, needed) : CL_INVALID_VALUE;
}

cl_int get_device_ids(cl_platform_id, cl_device_type, cl_uint room, cl_device_id* devices, cl_uint* count) {
    cl_uint found = 0;
    for (const Level& level : compiled_levels()) {
        if (!can_run(level.name)) continue;
        if (devices && found < room) devices[found] = handle_of<cl_device_id>(const_cast<Level*>(&level));
        ++found;
    }
    if (count) *count = found;
    return found > 0 ? CL_SUCCESS : CL_DEVICE_NOT_FOUND;
}

cl_int get_device_info(cl_device_id device, cl_device_info what, std::size_t room, void* out, std::size_t* needed) {
    switch (what) {
        case CL_DEVICE_NAME:
            return answer(name_of(level_of(device)), room, out, needed);
        case CL_DEVICE_VERSION:
            return answer(std::string("compiled ahead"), room, out, needed);
        case CL_DRIVER_VERSION:
            return answer(std::string(version()), room, out, needed);
        case CL_DEVICE_EXTENSIONS:
            return answer(std::string("cl_khr_fp64"), room, out, needed);
        case CL_DEVICE_TYPE:
            return answer(cl_device_type{CL_DEVICE_TYPE_CPU}, room, out, needed);
        case CL_DEVICE_GLOBAL_MEM_SIZE:
        case CL_DEVICE_MAX_MEM_ALLOC_SIZE:
            return answer(cl_ulong{host_memory()}, room, out, needed);
        case CL_DEVICE_MAX_COMPUTE_UNITS:
            return answer(cl_uint{processor_count()}, room, out, needed);
        case CL_DEVICE_AVAILABLE:
        case CL_DEVICE_HOST_UNIFIED_MEMORY:
            return answer(cl_bool{CL_TRUE}, room, out, needed);
        default:
            return CL_INVALID_VALUE;
    }
}

// ---- Contexts, queues ----

cl_context create_context(const cl_context_properties* properties, cl_uint, const cl_device_id*,
                          void (*)(const char*, const void*, std::size_t, void*), void*, cl_int* code) {
    auto* const context = new Context;
    for (; properties && properties[0] != 0; properties += 2) {
        if (properties[0] == stop_property)
            context->stop = reinterpret_cast<const std::atomic<bool>* const*>(properties[1]);
    }
    set(code, CL_SUCCESS);
    return handle_of<cl_context>(context);
}
cl_int release_context(cl_context context) {
    delete &as<Context>(context);
    return CL_SUCCESS;
}

cl_command_queue create_queue(cl_context context, cl_device_id, cl_command_queue_properties, cl_int* code) {
    set(code, CL_SUCCESS);
    return handle_of<cl_command_queue>(new Queue(as<Context>(context)));
}
cl_int retain_queue(cl_command_queue queue) {
    ++as<Queue>(queue).owners;
    return CL_SUCCESS;
}
cl_int release_queue(cl_command_queue queue) {
    if (--as<Queue>(queue).owners == 0) delete &as<Queue>(queue);
    return CL_SUCCESS;
}
cl_int flush(cl_command_queue) { return CL_SUCCESS; }
cl_int finish(cl_command_queue) { return CL_SUCCESS; }

// ---- Memory ----

constexpr std::size_t alignment = 128;  // the alignment of the longest vector, double16, as in OpenCL

cl_mem create_buffer(cl_context, cl_mem_flags flags, std::size_t bytes, void* host, cl_int* code) {
    const bool is_own = !(flags & CL_MEM_USE_HOST_PTR);
    void* const data = is_own ? ::operator new (bytes, std::align_val_t{alignment}, std::nothrow) : host;
    set(code, data ? CL_SUCCESS : CL_MEM_OBJECT_ALLOCATION_FAILURE);
    return data ? handle_of<cl_mem>(new Memory{static_cast<char*>(data), is_own}) : nullptr;
}
cl_int release_memory(cl_mem memory) {
    Memory& m = as<Memory>(memory);
    if (m.is_own) ::operator delete (m.data, std::align_val_t{alignment});
    delete &m;
    return CL_SUCCESS;
}

cl_int write(cl_command_queue, cl_mem memory, cl_bool, std::size_t offset, std::size_t bytes, const void* from, cl_uint,
             const cl_event*, cl_event* event) {
    const cl_ulong start = now();
    std::memcpy(as<Memory>(memory).data + offset, from, bytes);
    tell(event, start);
    return CL_SUCCESS;
}
cl_int read(cl_command_queue, cl_mem memory, cl_bool, std::size_t offset, std::size_t bytes, void* to, cl_uint,
            const cl_event*, cl_event* event) {
    const cl_ulong start = now();
    std::memcpy(to, as<Memory>(memory).data + offset, bytes);
    tell(event, start);
    return CL_SUCCESS;
}
cl_int read_rect(cl_command_queue, cl_mem memory, cl_bool, const std::size_t* from, const std::size_t* to,
                 const std::size_t* region, std::size_t row, std::size_t slice, std::size_t host_row,
                 std::size_t host_slice, void* host, cl_uint, const cl_event*, cl_event* event) {
    const cl_ulong start = now();
    const auto or_tight = [](std::size_t pitch, std::size_t tight) { return pitch ? pitch : tight; };
    row = or_tight(row, region[0]);
    slice = or_tight(slice, row * region[1]);
    host_row = or_tight(host_row, region[0]);
    host_slice = or_tight(host_slice, host_row * region[1]);
    const char* const source = as<Memory>(memory).data + from[0] + from[1] * row + from[2] * slice;
    char* const target = static_cast<char*>(host) + to[0] + to[1] * host_row + to[2] * host_slice;
    for (std::size_t z = 0; z < region[2]; ++z)
        for (std::size_t y = 0; y < region[1]; ++y)
            std::memcpy(target + y * host_row + z * host_slice, source + y * row + z * slice, region[0]);
    tell(event, start);
    return CL_SUCCESS;
}
cl_int fill(cl_command_queue, cl_mem memory, const void* pattern, std::size_t size, std::size_t offset,
            std::size_t bytes, cl_uint, const cl_event*, cl_event* event) {
    std::uint32_t value = 0;
    if (size != sizeof value) return CL_INVALID_VALUE;
    std::memcpy(&value, pattern, size);
    const cl_ulong start = now();
    std::fill_n(reinterpret_cast<std::uint32_t*>(as<Memory>(memory).data + offset), bytes / size, value);
    tell(event, start);
    return CL_SUCCESS;
}
void* map(cl_command_queue, cl_mem memory, cl_bool, cl_map_flags, std::size_t offset, std::size_t, cl_uint,
          const cl_event*, cl_event* event, cl_int* code) {
    tell(event, now());
    set(code, CL_SUCCESS);
    return as<Memory>(memory).data + offset;
}
cl_int unmap(cl_command_queue, cl_mem, void*, cl_uint, const cl_event*, cl_event* event) try {
    tell(event, now());
    return CL_SUCCESS;
} catch (const std::bad_alloc&) {  // destructors call this function, so it must not throw
    return CL_OUT_OF_HOST_MEMORY;
}

cl_int mark(cl_command_queue, cl_uint, const cl_event*, cl_event* event) {
    tell(event, now());
    return CL_SUCCESS;
}

// ---- Programs: the source is the name of a program that was compiled ahead ----

cl_program create_program(cl_context, cl_uint, const char** texts, const std::size_t* sizes, cl_int* code) {
    auto* const program = new BuiltProgram{std::string(texts[0], sizes[0])};
    set(code, CL_SUCCESS);
    return handle_of<cl_program>(program);
}
cl_int build(cl_program program, cl_uint, const cl_device_id* devices, const char*, void (*)(cl_program, void*),
             void*) {
    BuiltProgram& p = as<BuiltProgram>(program);
    p.program = level_of(*devices).program(p.name);
    return p.program ? CL_SUCCESS : CL_BUILD_PROGRAM_FAILURE;
}
cl_int release_program(cl_program program) {
    delete &as<BuiltProgram>(program);
    return CL_SUCCESS;
}
cl_int get_build_info(cl_program program, cl_device_id, cl_program_build_info what, std::size_t room, void* out,
                      std::size_t* needed) {
    if (what != CL_PROGRAM_BUILD_LOG) return CL_INVALID_VALUE;
    const char* const refusal = "the native device has the kernels that were compiled with csgrt, no others";
    return answer(std::string(as<BuiltProgram>(program).program ? "" : refusal), room, out, needed);
}

// ---- Kernels ----

cl_kernel create_kernel(cl_program program, const char* name, cl_int* code) {
    const Program* const built = as<BuiltProgram>(program).program;
    const CompiledKernel* compiled = built ? built->kernel(name) : nullptr;
    if (!compiled && built) compiled = Program{"scan", scan_kernels()}.kernel(name);
    set(code, compiled ? CL_SUCCESS : built ? CL_INVALID_KERNEL_NAME : CL_INVALID_PROGRAM_EXECUTABLE);
    if (!compiled) return nullptr;
    return handle_of<cl_kernel>(new BuiltKernel{compiled, std::vector<std::uint64_t>(compiled->argument_count)});
}
cl_int release_kernel(cl_kernel kernel) {
    delete &as<BuiltKernel>(kernel);
    return CL_SUCCESS;
}
cl_int get_kernel_info(cl_kernel kernel, cl_kernel_info what, std::size_t room, void* out, std::size_t* needed) {
    if (what != CL_KERNEL_NUM_ARGS) return CL_INVALID_VALUE;
    return answer(cl_uint{as<BuiltKernel>(kernel).compiled->argument_count}, room, out, needed);
}

cl_int set_argument(cl_kernel kernel, cl_uint index, std::size_t bytes, const void* value) {
    BuiltKernel& k = as<BuiltKernel>(kernel);
    if (index >= k.arguments.size()) return CL_INVALID_ARG_INDEX;
    const std::uint32_t of_value = k.compiled->argument_sizes[index];
    if (bytes != (of_value ? of_value : sizeof(cl_mem))) return CL_INVALID_ARG_SIZE;
    if (!value) return CL_INVALID_ARG_VALUE;
    std::uint64_t& argument = k.arguments[index];
    argument = 0;
    if (of_value) {
        std::memcpy(&argument, value, bytes);
        return CL_SUCCESS;
    }
    cl_mem memory = nullptr;
    std::memcpy(&memory, value, bytes);
    if (memory) argument = reinterpret_cast<std::uintptr_t>(as<Memory>(memory).data);
    return CL_SUCCESS;
}

}  // namespace

void run_here(const CompiledKernel& kernel, std::size_t items, const std::uint64_t* arguments,
              const std::atomic<bool>* stop) {
    item.size = items;
    item.stop = stop ? stop : &never;
    kernel.run(0, items, arguments);
}

namespace {

// A thread takes parts until no part is left. Parts are small, since rays differ in cost, but large enough that taking
// a part costs little.
void run(Context& context, const CompiledKernel& kernel, const std::uint64_t* arguments, std::size_t items,
         std::size_t group) {
    constexpr std::size_t parts_a_thread = 64, most_items = 4096, few_items = 64;
    const std::size_t groups = items / group;
    const unsigned threads = items < few_items || groups == 1 ? 1 : thread_count(0);
    const std::size_t each = std::min(groups / (threads * parts_a_thread), most_items / group) + 1;
    std::atomic<std::size_t> next{0};
    const std::atomic<bool>* const stop = context.stop && *context.stop ? *context.stop : &never;
    const auto work = [&] {
        item.size = items;
        item.stop = stop;
        for (std::size_t first; (first = next.fetch_add(each, std::memory_order_relaxed)) < groups;)
            kernel.run(first * group, std::min(groups, first + each) * group, arguments);
    };
    on_threads(threads, work);
}

cl_int launch(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const std::size_t*,
              const std::size_t* items, const std::size_t* group, cl_uint, const cl_event*, cl_event* event) {
    if (dimensions != 1) return CL_INVALID_WORK_DIMENSION;
    const std::size_t group_size = group ? *group : 1;
    if (group_size == 0 || group_size > 4096 || *items % group_size != 0) return CL_INVALID_WORK_GROUP_SIZE;
    const BuiltKernel& k = as<BuiltKernel>(kernel);
    Context& context = as<Queue>(queue).context;
    const std::lock_guard one_at_a_time(context.kernels);
    const cl_ulong start = now();
    run(context, *k.compiled, k.arguments.data(), *items, group_size);
    tell(event, start);
    return CL_SUCCESS;
}

// ---- Events ----

cl_int wait_for_events(cl_uint, const cl_event*) { return CL_SUCCESS; }
cl_int release_event(cl_event event) {
    delete &as<Event>(event);
    return CL_SUCCESS;
}
cl_int get_event_info(cl_event, cl_event_info what, std::size_t room, void* out, std::size_t* needed) {
    return what == CL_EVENT_COMMAND_EXECUTION_STATUS ? answer(cl_int{CL_COMPLETE}, room, out, needed)
                                                     : CL_INVALID_VALUE;
}
cl_int get_event_times(cl_event event, cl_profiling_info what, std::size_t room, void* out, std::size_t* needed) {
    const Event& e = as<Event>(event);
    if (what == CL_PROFILING_COMMAND_START) return answer(e.start, room, out, needed);
    return what == CL_PROFILING_COMMAND_END ? answer(e.end, room, out, needed) : CL_INVALID_VALUE;
}

}  // namespace

const OpenCl& functions() {
    static const OpenCl all = {.GetPlatformIDs = get_platform_ids,
                               .GetPlatformInfo = get_platform_info,
                               .GetDeviceIDs = get_device_ids,
                               .GetDeviceInfo = get_device_info,
                               .CreateContext = create_context,
                               .ReleaseContext = release_context,
                               .CreateCommandQueue = create_queue,
                               .RetainCommandQueue = retain_queue,
                               .ReleaseCommandQueue = release_queue,
                               .Flush = flush,
                               .Finish = finish,
                               .CreateBuffer = create_buffer,
                               .ReleaseMemObject = release_memory,
                               .CreateProgramWithSource = create_program,
                               .BuildProgram = build,
                               .ReleaseProgram = release_program,
                               .GetProgramBuildInfo = get_build_info,
                               .CreateKernel = create_kernel,
                               .ReleaseKernel = release_kernel,
                               .GetKernelInfo = get_kernel_info,
                               .SetKernelArg = set_argument,
                               .EnqueueNDRangeKernel = launch,
                               .EnqueueWriteBuffer = write,
                               .EnqueueReadBuffer = read,
                               .EnqueueReadBufferRect = read_rect,
                               .EnqueueFillBuffer = fill,
                               .EnqueueMapBuffer = map,
                               .EnqueueUnmapMemObject = unmap,
                               .EnqueueMarkerWithWaitList = mark,
                               .WaitForEvents = wait_for_events,
                               .ReleaseEvent = release_event,
                               .GetEventInfo = get_event_info,
                               .GetEventProfilingInfo = get_event_times};
    return all;
}

const Level* level_of(const OpenCl* table, cl_device_id device) {
    return table == &functions() ? &level_of(device) : nullptr;
}

}  // namespace csgrt::native
