// OpenCL loader of the system, opened when it is first needed.
#pragma once

#include <string>

#include "device/opencl/opencl_table.hpp"

namespace csgrt {

/// The functions of the loaded OpenCL, or the reason why there are none.
struct OpenClLoader {
    const OpenCl* functions = nullptr;  ///< null: there is no usable loader
    std::string fault;                  ///< the reason; empty if none is installed
};

/// Takes the OpenCL that the process has already (its own, or a tool's), else opens the library that drivers install.
/// Once in a process; any thread.
const OpenClLoader& opencl_loader();

/// The system's message about the last library that this thread could not load; empty: nothing since the last call.
std::string last_load_fault();

}  // namespace csgrt
