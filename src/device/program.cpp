#include "device/program.hpp"

#include <new>
#include <optional>
#include <stdexcept>

#include <csgrt/error.hpp>

#include "device/binary_cache.hpp"
#include "device/discovery.hpp"
#include "device/driver_call.hpp"

namespace csgrt {

namespace {

std::string log_of(const Device& device, cl_program program) {
    std::size_t size = 0;
    check(device.cl().GetProgramBuildInfo(program, device.id(), CL_PROGRAM_BUILD_LOG, 0, nullptr, &size),
          "clGetProgramBuildInfo");
    std::string log(size, '\0');
    check(device.cl().GetProgramBuildInfo(program, device.id(), CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr),
          "clGetProgramBuildInfo");
    const std::size_t end = log.find_last_not_of(std::string_view(" \n\t\0", 4));
    log.resize(end == std::string::npos ? 0 : end + 1);
    return log;
}

bool rounds_single_correctly(const Device& device) {
    cl_device_fp_config config = 0;
    check(device.cl().GetDeviceInfo(device.id(), CL_DEVICE_SINGLE_FP_CONFIG, sizeof config, &config, nullptr),
          "clGetDeviceInfo");
    return config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
}

/// The key of a compiled program: everything that the binary depends on. Devices with one name may have different
/// instructions. The vector width tells most of them apart, and a driver refuses a binary that its device cannot run.
std::string key_of(const Device& device, const std::string& source, const std::string& options) {
    cl_uint vector = 0;
    check(device.cl().GetDeviceInfo(device.id(), CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE, sizeof vector, &vector, nullptr),
          "clGetDeviceInfo");
    const DeviceInfo& info = device.info();
    std::string key;
    for (const std::string* part : {&info.platform, &info.name, &info.version, &info.driver, &options})
        key += *part + '\n';
    return key + std::to_string(vector) + '\n' + source;
}

}  // namespace

Program::Program(const Device& device, const std::string& source, const std::vector<std::string>& defines, bool single)
    : device_(&device) {
    const DriverCall call(!is_native(device.info()));
    // -w: without it, PoCL prints the number of warnings, one for each function that a scene does not need.
    std::string options = std::string("-w -cl-std=CL1.2 -DCSGRT_REAL=") + (single ? "float" : "double");
    if (single && rounds_single_correctly(device)) options += " -cl-fp32-correctly-rounded-divide-sqrt";
    for (const std::string& define : defines) options += " -D" + define;
    // With 168 registers a thread, twelve warps of 32 threads fit into a multiprocessor's 65,536 registers. Without
    // this limit the compiler took 178 registers for first hits, so only ten warps fit: goliath's kernels took 1.10
    // times as long on an H100.
    if (device.info().platform == "NVIDIA CUDA") options += " -cl-nv-maxrregcount=168";

    const std::optional<BinaryCache> cache = binary_cache_for(device.info());
    const std::string key = cache ? key_of(device, source, options) : "";
    const std::optional<std::string> kept = cache ? cache->find(key) : std::nullopt;
    is_from_cache_ = kept && load(*kept);
    if (is_from_cache_) return;
    compile(source, options);
    if (cache) cache->keep(key, binary());
}

/// When memory runs out, an exception leaves PoCL's compiler and PoCL stays locked. Then no object is released, because
/// a release would wait for ever.
cl_int Program::build(const std::string& options) const {
    const Driver& cl = device_->cl();
    const cl_device_id id = device_->id();
    try {
        return cl.BuildProgram(program_.get(), 1, &id, options.c_str(), nullptr, nullptr);
    } catch (const std::bad_alloc&) {
        cl.is_lost = true;
        throw;
    }
}

void Program::compile(const std::string& source, const std::string& options) {
    // Before PoCL looks for compiled binaries, it parses a megabyte of declarations: all functions of OpenCL C for all
    // types. This takes 45 of 60 ms of each start. The options replace them by builtins.h, which declares the functions
    // that are used. Other releases than the tested ones may have the declarations elsewhere; a release that refuses
    // these options gets PoCL's declarations.
    const DeviceInfo& info = device_->info();
    has_own_declarations_ = is_pocl(info) && info.driver.starts_with("3.");

    const Driver& cl = device_->cl();
    const char* text = source.data();
    const std::size_t size = source.size();
    cl_int code = CL_SUCCESS;
    program_ = Handle<cl_program, &OpenCl::ReleaseProgram>(
        cl, cl.CreateProgramWithSource(device_->context(), 1, &text, &size, &code));
    check(code, "clCreateProgramWithSource");
    if (has_own_declarations_) {
        code = build(options + " -D_OPENCL_H_ -DCSGRT_BUILTINS");
        has_own_declarations_ = code == CL_SUCCESS;
    }
    if (!has_own_declarations_) code = build(options);
    build_log_ = log_of(*device_, program_.get());
    if (code == CL_BUILD_PROGRAM_FAILURE) {
        throw Error(Status::device_fault,
                    "the kernels do not compile for " + info.name + " (" + options + "):\n" + build_log_);
    }
    check(code, "clBuildProgram (" + options + ")");
}

/// Loads a binary. False if the driver refuses the binary: then the source is compiled.
bool Program::load(const std::string& binary) {
    const Driver& cl = device_->cl();
    const cl_device_id id = device_->id();
    const auto* bytes = reinterpret_cast<const unsigned char*>(binary.data());
    const std::size_t size = binary.size();
    cl_int status = CL_SUCCESS, code = CL_SUCCESS;
    program_ = Handle<cl_program, &OpenCl::ReleaseProgram>(
        cl, cl.CreateProgramWithBinary(device_->context(), 1, &id, &size, &bytes, &status, &code));
    if (code != CL_SUCCESS || status != CL_SUCCESS) return false;
    return build("") == CL_SUCCESS;
}

/// The binary that the driver made of the source. Empty if the driver does not return it.
std::string Program::binary() const {
    const Driver& cl = device_->cl();
    std::size_t size = 0;  // of the context's one device
    const auto info = [&](cl_program_info what, std::size_t bytes, void* out) {
        return cl.GetProgramInfo(program_.get(), what, bytes, out, nullptr) == CL_SUCCESS;
    };
    if (!info(CL_PROGRAM_BINARY_SIZES, sizeof size, &size)) return {};
    std::string binary(size, '\0');
    char* bytes = binary.data();
    return info(CL_PROGRAM_BINARIES, sizeof bytes, &bytes) ? binary : std::string();
}

Kernel Program::kernel(const std::string& name) const { return Kernel(*device_, program_.get(), name); }

Kernel::Kernel(const Device& device, cl_program program, std::string name) : device_(&device), name_(std::move(name)) {
    cl_int code = CL_SUCCESS;
    kernel_ =
        Handle<cl_kernel, &OpenCl::ReleaseKernel>(device.cl(), device.cl().CreateKernel(program, name_.c_str(), &code));
    check(code, "clCreateKernel (" + name_ + ")");
    check(
        device.cl().GetKernelInfo(kernel_.get(), CL_KERNEL_NUM_ARGS, sizeof argument_count_, &argument_count_, nullptr),
        "clGetKernelInfo (" + name_ + ")");
}

void Kernel::set(cl_uint position, const Buffer& buffer) {
    const cl_mem memory = buffer.get();
    set_bytes(position, &memory, sizeof memory);
}

void Kernel::set(cl_uint position, LocalMemory local) { set_bytes(position, nullptr, local.bytes); }

void Kernel::set_bytes(cl_uint position, const void* value, std::size_t bytes) {
    const cl_int code = device_->cl().SetKernelArg(kernel_.get(), position, bytes, value);
    if (code != CL_SUCCESS) check(code, "clSetKernelArg (" + name_ + ", argument " + std::to_string(position) + ")");
}

void Kernel::check_count(std::size_t count) const {
    if (count == argument_count_) return;
    throw std::logic_error("kernel " + name_ + " takes " + std::to_string(argument_count_) + " arguments, not " +
                           std::to_string(count));
}

Event Kernel::queue(std::size_t items, std::size_t group) {
    if (items == 0) return {};
    device_->check_end();
    const std::size_t padded = (items + group - 1) / group * group;
    cl_event event = nullptr;
    const cl_int code = device_->cl().EnqueueNDRangeKernel(device_->queue(), kernel_.get(), 1, nullptr, &padded, &group,
                                                           0, nullptr, &event);
    if (code != CL_SUCCESS) {
        check(code, "clEnqueueNDRangeKernel (" + name_ + ", " + std::to_string(items) + " items in groups of " +
                        std::to_string(group) + ")");
    }
    Event queued(device_->cl(), event);
    device_->check_end();  // a native device that was stopped has left out work-items
    return queued;
}

}  // namespace csgrt
