// Programs and their kernels. This file includes all of src/device that a pipeline needs.
#pragma once

#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "device/buffer.hpp"
#include "device/device.hpp"
#include "device/kernel_source.hpp"

namespace csgrt {

/// Local memory for a kernel's __local pointer, in bytes.
struct LocalMemory {
    std::size_t bytes;
};

/// One kernel of a program, ready to be queued. One thread at a time: OpenCL keeps a kernel's arguments in it.
class Kernel {
public:
    /// Queues `items` work-items in groups of `group`, and does not wait. The last group is filled up, so the kernel
    /// must check that its index is below `items`. The arguments have the order of the kernel's parameters: a Buffer, a
    /// tuple of Buffers, LocalMemory, or a value of exactly the parameter's type (cl_uint, cl_double, a struct of
    /// kernels/shared/layout.h). 0 items: nothing is queued, and the event is empty. Throws Error (device_fault,
    /// out_of_memory) that names the kernel, or Error (interrupted), see Device::end_by().
    template <class... Arguments>
    Event launch(std::size_t items, std::size_t group, const Arguments&... arguments) {
        cl_uint position = 0;
        (add(position, arguments), ...);
        check_count(position);
        return queue(items, group);
    }

    const std::string& name() const noexcept { return name_; }

private:
    friend class Program;
    Kernel(const Device& device, cl_program program, std::string name);

    template <class T>
    void add(cl_uint& position, const T& argument) {
        set(position++, argument);
    }
    template <class... Buffers>
    void add(cl_uint& position, const std::tuple<Buffers...>& group) {
        std::apply([&](const auto&... buffers) { (add(position, buffers), ...); }, group);
    }
    void set(cl_uint position, const Buffer& buffer);
    void set(cl_uint position, LocalMemory local);
    template <class T>
    void set(cl_uint position, const T& value) {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>, "kernels take plain values");
        static_assert(!std::is_same_v<T, bool>, "OpenCL takes no bool: pass a cl_int or cl_uint");
        set_bytes(position, &value, sizeof(T));
    }
    void set_bytes(cl_uint position, const void* value, std::size_t bytes);
    void check_count(std::size_t count) const;
    Event queue(std::size_t items, std::size_t group);

    const Device* device_;
    std::string name_;
    cl_uint argument_count_ = 0;
    Handle<cl_kernel, &OpenCl::ReleaseKernel> kernel_;
};

/// OpenCL C source, compiled for one device. `source`: see program_source. Each of `defines` becomes a -D ("COUNT=3",
/// "HAS_TORUS"). `real` is double, or float if `single`. In float, division and square root are rounded correctly if
/// the device can do so. In double, every result is rounded correctly.
class Program {
public:
    /// Compiles the source. If the driver keeps no compiled programs itself, takes a binary from an earlier compilation
    /// (binary_cache.hpp). Throws Error (device_fault) with the compiler's message if the source does not compile.
    Program(const Device& device, const std::string& source, const std::vector<std::string>& defines = {},
            bool single = false);

    /// Throws Error (device_fault) if the program has no kernel of that name.
    Kernel kernel(const std::string& name) const;
    /// The compiler's messages. Empty for a program from the cache.
    const std::string& build_log() const noexcept { return build_log_; }
    /// Whether the program's binary is from the cache.
    bool is_from_cache() const noexcept { return is_from_cache_; }
    /// Whether the program was built with the declarations of builtins.h instead of the driver's.
    bool has_own_declarations() const noexcept { return has_own_declarations_; }

private:
    cl_int build(const std::string& options) const;
    void compile(const std::string& source, const std::string& options);
    bool load(const std::string& binary);
    std::string binary() const;

    const Device* device_;
    Handle<cl_program, &OpenCl::ReleaseProgram> program_;
    std::string build_log_;
    bool has_own_declarations_ = false, is_from_cache_ = false;
};

}  // namespace csgrt
