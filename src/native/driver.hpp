// Native device: this machine's processors, used through OpenCL's functions like any other device, with kernels that
// are compiled together with csgrt (kernels.hpp). It needs no driver, loader or compiler on the user's machine.
//
// A command is done when the call that queues it returns, in any queue. An event has only the times of its command. The
// driver implements the part of OpenCL that csgrt uses: one dimension, buffers, programs of double precision with the
// default quartic. The source of such a program is its name in kernels.hpp, and it takes no options.
#pragma once

#include <vector>

#include "device/opencl/opencl_table.hpp"
#include "native/kernels.hpp"

namespace csgrt::native {

inline constexpr const char* platform_name = "csgrt";

/// The property of a context with the address of a std::atomic<bool>, which may be null. While the flag is true,
/// kernels skip work-items that have not begun.
inline constexpr cl_context_properties stop_property = 0x63736773;

const OpenCl& functions();

/// The kernels of a device, if `table` is the native device's table; else null.
const Level* level_of(const OpenCl* table, cl_device_id device);

}  // namespace csgrt::native
