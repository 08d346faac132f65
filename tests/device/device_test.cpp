#include "catch.hpp"

#include <numeric>
#include <thread>

#include "device/compiling_device.hpp"
#include "device/copy_feed.hpp"
#include "device/program.hpp"
#include "device/queued.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const char* const scale_source = R"(
typedef struct { double factor; uint offset; } Change;
__kernel void change(__global const uint* in, __global double* out, Change change, uint size) {
    uint id = (uint)get_global_id(0);
    if (id < size) out[id] = change.factor * in[id] + change.offset;
}
__kernel void sum_group(__global const uint* in, __global uint* out, __local uint* shared) {
    uint i = (uint)get_local_id(0), sum = 0, k;
    shared[i] = in[get_global_id(0)];
    barrier(CLK_LOCAL_MEM_FENCE);
    for (k = 0; k < get_local_size(0); ++k) sum += shared[k];
    if (i == 0) out[get_group_id(0)] = sum;
}
__kernel void is_null(__global const uint* in, __global uint* out) { out[0] = in == 0; }
)";

struct Change {
    cl_double factor;
    cl_uint offset;
};

}  // namespace

TEST_CASE("numbers go to the device, through a kernel and back", "[device]") {
    Device device(test::compiling_device());
    Program program(device, scale_source);
    Kernel change = program.kernel("change");
    std::vector<cl_uint> numbers(1000);
    std::iota(numbers.begin(), numbers.end(), 0u);
    Buffer in(device, "in", numbers), out(device, "out", numbers.size() * sizeof(double));

    const Event event = change.launch(numbers.size(), 64, in, out, Change{0.5, 3}, cl_uint(numbers.size()));
    const std::vector<double> result = out.read<double>(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) REQUIRE(result[i] == 0.5 * static_cast<double>(i) + 3);
    const TimeSpan span = time_span(event);
    CHECK(span.end > span.begin);
}

TEST_CASE("launches of any number of items: each item comes once", "[device]") {
    Device device(test::compiling_device());
    Program program(
        device, "__kernel void add(__global uint* x, uint n) { uint i = (uint)get_global_id(0); if (i < n) ++x[i]; }");
    Kernel add = program.kernel("add");
    for (const cl_uint items : {1u, 63u, 65'535u, 65'536u, 200'001u}) {
        INFO(items << " items");
        for (const std::size_t group : {1, 64}) {
            Buffer x(device, "x", items * sizeof(cl_uint));
            x.queue_fill(0, x.size());
            add.launch(items, group, x, items);
            CHECK(x.read<cl_uint>(items) == std::vector<cl_uint>(items, 1));
        }
    }
    Buffer x(device, "x", sizeof(cl_uint));
    CHECK_FALSE(add.launch(0, 64, x, cl_uint{0}));
}

TEST_CASE("launches queue up behind each other and are waited for once", "[device]") {
    Device device(test::compiling_device());
    Program program(device,
                    "__kernel void grow(__global uint* x, uint n) { uint i = (uint)get_global_id(0); if (i < n) x[i] = "
                    "3 * x[i] + 1; }");
    Kernel grow = program.kernel("grow");
    Buffer x(device, "x", 100 * sizeof(cl_uint));
    std::vector<cl_uint> result(100);
    std::vector<Event> events;
    events.push_back(x.queue_fill(1, x.size()));
    for (int i = 0; i < 10; ++i) events.push_back(grow.launch(100, 32, x, cl_uint{100}));
    events.push_back(x.queue_read(result.data(), x.size()));
    device.flush();
    device.finish();
    CHECK(result == std::vector<cl_uint>(100, 88573));  // (3^11 - 1) / 2
    for (const Event& event : events) CHECK(time_span(event).begin > 0);
}

TEST_CASE("what stands in different queues is all done when a device has finished, and each keeps its order",
          "[device]") {
    Device device(test::compiling_device());
    Program program(device,
                    "__kernel void grow(__global uint* x, uint n) { uint i = (uint)get_global_id(0); if (i < n) x[i] = "
                    "3 * x[i] + 1; }");
    Kernel grow = program.kernel("grow");
    std::vector<Buffer> x;
    std::vector<Event> events;
    for (std::size_t queue = 0; queue < Device::queues; ++queue) {
        x.emplace_back(device, "x", 5000 * sizeof(cl_uint));
        const Device::OnQueue taken(device, queue);
        x[queue].queue_fill(static_cast<cl_uint>(queue), x[queue].size());
        device.flush();
    }
    for (int i = 0; i < 10; ++i)
        for (std::size_t queue = 0; queue < Device::queues; ++queue) {
            const Device::OnQueue taken(device, queue);
            events.push_back(grow.launch(5000, 32, x[queue], cl_uint{5000}));
            device.flush();
        }
    wait_patiently(events.front());
    wait_patiently(Event());
    device.finish();
    for (const Event& event : events) {
        cl_int status = CL_QUEUED;
        event.cl().GetEventInfo(event.get(), CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof status, &status, nullptr);
        CHECK(status == CL_COMPLETE);
    }
    for (std::size_t queue = 0; queue < Device::queues; ++queue)  // 3^10 x + (3^10 - 1) / 2
        CHECK(x[queue].read<cl_uint>(5000) == std::vector<cl_uint>(5000, 59049 * static_cast<cl_uint>(queue) + 29524));
    QueuedRead read(device, "last");
    read.start(x[1], sizeof(cl_uint), 4999 * sizeof(cl_uint));
    read.copy();
    CHECK(read.wait<cl_uint>(1).front() == 88573);
}

TEST_CASE("a kernel takes local memory, and a null pointer for an empty buffer", "[device]") {
    Device device(test::compiling_device());
    Program program(device, scale_source);
    Buffer in(device, "in", std::vector<cl_uint>(64, 2)), out(device, "out", 4 * sizeof(cl_uint)),
        empty(device, "empty");
    program.kernel("sum_group").launch(64, 16, in, out, LocalMemory{16 * sizeof(cl_uint)});
    CHECK(out.read<cl_uint>(4) == std::vector<cl_uint>(4, 32));
    Kernel is_null = program.kernel("is_null");
    is_null.launch(1, 1, empty, out);
    CHECK(out.read<cl_uint>(1)[0] == 1);
    is_null.launch(1, 1, in, out);
    CHECK(out.read<cl_uint>(1)[0] == 0);
}

TEST_CASE("nothing to do is nothing queued", "[device]") {
    Device device(test::compiling_device());
    Program program(device, scale_source);
    Buffer empty(device, "empty");
    const Event event = program.kernel("is_null").launch(0, 64, empty, empty);
    CHECK(!event);
    CHECK(time_span(event).end == 0);
    CHECK(!empty.queue_fill(7, 0));
    empty.upload(std::vector<cl_uint>{});
    CHECK(empty.read<cl_uint>(0).empty());
}

TEST_CASE("transfers reach the middle of a buffer and never past its end", "[device]") {
    Device device(test::compiling_device());
    Buffer buffer(device, "numbers", std::vector<cl_uint>{1, 2, 3, 4});
    const cl_uint nine = 9;
    buffer.upload(&nine, sizeof nine, 2 * sizeof nine);
    CHECK(buffer.read<cl_uint>(4) == std::vector<cl_uint>{1, 2, 9, 4});
    cl_uint value = 0;
    buffer.read(&value, sizeof value, 3 * sizeof value);
    CHECK(value == 4);
    CHECK_THROWS_WITH(buffer.read<cl_uint>(5), "buffer numbers: a transfer past its end");
    CHECK_THROWS_WITH(buffer.upload(&nine, sizeof nine, 13), "buffer numbers: a transfer past its end");
    CHECK_THROWS_WITH(buffer.queue_fill(0, 20), "buffer numbers: a transfer past its end");
}

TEST_CASE("memory is counted by name and given back", "[device]") {
    Device device(test::compiling_device(), 10'000);
    CHECK(device.budget() == 10'000);
    CHECK(device.max_buffer() <= 10'000);
    {
        Buffer a(device, "a", 1000), b(device, "b", 2000), more(device, "b", 500);
        CHECK(device.allocated() == 3500);
        CHECK(device.available() == 6500);
        CHECK(device.allocations() == std::map<std::string, std::uint64_t>{{"a", 1000}, {"b", 2500}});
        a.reserve(800);
        CHECK(a.size() == 1000);
        a.reserve(4000);
        CHECK(a.size() == 4000);
        CHECK(device.allocated() == 6500);
        Buffer moved = std::move(a);
        CHECK(moved.size() == 4000);
        CHECK(device.allocated() == 6500);
        b = std::move(moved);
        CHECK(b.name() == "a");
        CHECK(device.allocated() == 6500);
    }
    CHECK(device.allocated() == 0);
    CHECK(device.allocations().empty());
}

TEST_CASE("what does not fit the budget is refused, with who holds what", "[device]") {
    Device device(test::compiling_device(), 1 << 20);
    Buffer rays(device, "rays", 700 * 1024);
    const std::string text = test::failure(Status::out_of_memory, [&] { Buffer(device, "segments", 400 * 1024); });
    CHECK(has(text, "\"segments\" needs 400.0 KiB"));
    CHECK(has(text, "of 1.0 MiB only 324.0 KiB are free"));
    CHECK(has(text, "in use: rays 700.0 KiB"));
    CHECK(device.allocated() == 700 * 1024);
    Buffer fits(device, "segments", 324 * 1024);
    CHECK(device.available() == 0);
}

TEST_CASE("one buffer larger than the device allows is refused", "[device]") {
    Device device(test::compiling_device(), std::uint64_t{1} << 62);
    const std::string text =
        test::failure(Status::out_of_memory, [&] { Buffer(device, "partitions", device.info().max_allocation + 1); });
    CHECK(has(text, "\"partitions\" needs "));
    CHECK(has(text, "one buffer may take "));
    CHECK(device.allocated() == 0);
}

TEST_CASE("without a limit the budget is less than the device has", "[device]") {
    Device device(test::compiling_device());
    CHECK(device.budget() > 0);
    CHECK(device.budget() < device.info().memory);
    CHECK(device.max_buffer() <= device.budget());
}

TEST_CASE("a program that does not compile shows the compiler's words and the kernel's file", "[device]") {
    Device device(test::compiling_device());
    const std::string source = assemble_program({"shared/base.h"}) +
                               "#line 7 \"kernels/broken.cl\"\n__kernel void f() { not_declared = 1; }\n";
    const std::string text = test::failure(Status::device_fault, [&] { Program(device, source, {"SOME=1"}); });
    INFO(text);
    CHECK(has(text, "do not compile for " + device.info().name));
    CHECK(has(text, "-DSOME=1"));
    CHECK((has(text, "kernels/broken.cl:7") || has(text, "<kernel>:")));  // NVIDIA names no file
    CHECK(has(text, "not_declared"));
}

TEST_CASE("a define reaches the kernel, and so does the precision", "[device]") {
    Device device(test::compiling_device());
    Program program(device, "__kernel void f(__global uint* out) { out[0] = COUNT; out[1] = sizeof(CSGRT_REAL); }",
                    {"COUNT=42"});
    Buffer out(device, "out", 2 * sizeof(cl_uint));
    program.kernel("f").launch(1, 1, out);
    CHECK(out.read<cl_uint>(2) == std::vector<cl_uint>{42, 8});
}

TEST_CASE("a kernel that is not there, or is called wrongly, is named", "[device]") {
    Device device(test::compiling_device());
    Program program(device, scale_source);
    const std::string missing = test::failure(Status::device_fault, [&] { program.kernel("weave"); });
    CHECK(has(missing, "clCreateKernel (weave)"));
    CHECK(has(missing, "CL_INVALID_KERNEL_NAME (-46)"));

    Kernel change = program.kernel("change");
    Buffer buffer(device, "buffer", 64);
    CHECK_THROWS_WITH(change.launch(1, 1, buffer), "kernel change takes 4 arguments, not 1");
    const std::string size = test::failure(Status::device_fault, [&] {
        change.launch(1, 1, buffer, buffer, Change{1, 1}, cl_ulong{1});
    });
    CHECK(has(size, "clSetKernelArg (change, argument 3)"));
    CHECK(has(size, "CL_INVALID_ARG_SIZE"));
    const std::string group = test::failure(Status::device_fault, [&] {
        change.launch(1, std::size_t{1} << 30, buffer, buffer, Change{1, 1}, cl_uint{0});
    });
    CHECK(has(group, "clEnqueueNDRangeKernel (change, 1 items in groups of 1073741824)"));
    CHECK(has(group, "CL_INVALID_WORK_GROUP_SIZE"));
}

TEST_CASE("an error of OpenCL has its name, and memory errors their status", "[device][promise:failures]") {
    CHECK(test::failure(Status::device_fault, [] { check(CL_OUT_OF_RESOURCES, "clFinish"); }) ==
          "clFinish failed: CL_OUT_OF_RESOURCES (-5)");
    CHECK(test::failure(Status::out_of_memory, [] { check(CL_MEM_OBJECT_ALLOCATION_FAILURE, "f"); }) ==
          "f failed: CL_MEM_OBJECT_ALLOCATION_FAILURE (-4)");
    CHECK(test::failure(Status::out_of_memory, [] { check(CL_OUT_OF_HOST_MEMORY, "f"); }) ==
          "f failed: CL_OUT_OF_HOST_MEMORY (-6)");
    CHECK(test::failure(Status::device_fault, [] { check(-9999, "f"); }) == "f failed: an unknown error (-9999)");
    CHECK_NOTHROW(check(CL_SUCCESS, "f"));
    CHECK(std::string(opencl_error_name(-1001)) == "CL_PLATFORM_NOT_FOUND_KHR");
}

TEST_CASE("pinned memory is memory that transfers reach", "[device]") {
    Device device(test::compiling_device());
    PinnedMemory pinned(device, "pixels", 1000 * sizeof(cl_uint));
    Buffer buffer(device, "pixels", 1000 * sizeof(cl_uint));
    buffer.queue_fill(5, buffer.size());
    buffer.queue_read(pinned.data(), pinned.size());
    device.finish();
    const cl_uint* values = static_cast<const cl_uint*>(pinned.data());
    CHECK(std::vector<cl_uint>(values, values + 1000) == std::vector<cl_uint>(1000, 5));
    CHECK(device.allocated() == buffer.size());
    CHECK(PinnedMemory(device, "none", 0).data() == nullptr);
}

TEST_CASE("registered host memory keeps what it holds, takes copies by lines, and may outlast the device", "[device]") {
    std::vector<float> host(100 * 40, 7);
    auto device = std::make_unique<Device>();
    std::optional<HostRegistration> registered(std::in_place, *device, host.data(), host.size() * sizeof(float));
    CHECK(host == std::vector<float>(100 * 40, 7));
    std::vector<float> values(30 * 10 + 30 * 20);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
    {
        const Buffer buffer(*device, "lines", values);
        CopyFeed copies(*device);
        copies
            .add(buffer,
                 {{.columns = 30,
                   .lines = 20,
                   .begin = 30 * 10,
                   .pitch = 30,
                   .target = host.data() + 5 * 100 + 11,
                   .target_pitch = 100}},
                 true)
            .get();
    }
    std::vector<float> expected(host.size(), 7);
    for (std::size_t y = 0; y < 20; ++y)
        for (std::size_t x = 0; x < 30; ++x) expected[(5 + y) * 100 + 11 + x] = static_cast<float>(300 + y * 30 + x);
    CHECK(host == expected);
    std::optional<HostRegistration> moved(std::move(*registered));
    registered.reset();
    device.reset();
    moved.reset();
    CHECK(host == expected);
}

TEST_CASE("the first devices of a process may be asked for by many threads at once", "[.first_threads]") {
    std::vector<std::string> names(8);
    std::vector<std::thread> threads;
    for (std::string& name : names)
        threads.emplace_back([&name] {
            try {
                prepare_devices();
                name = Device(test::compiling_device()).info().name;
            } catch (const Error& error) {
                name = error.what();
            }
        });
    for (std::thread& thread : threads) thread.join();
    const std::string after = Device(test::compiling_device()).info().name;
    for (const std::string& name : names) CHECK(name == after);
}
