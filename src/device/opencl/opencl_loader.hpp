// The OpenCL loader of the system, opened when it is first needed.
#pragma once

#include <string>

#include "device/opencl/opencl_table.hpp"

namespace csgrt {

struct OpenClLoader {
    const OpenCl* functions = nullptr;  ///< null: there is none that can be used
    std::string fault;                  ///< why; empty if none is installed
};

/// Takes the OpenCL that the process has already (its own, or a tool's), else opens the library that drivers install.
/// Once in a process; any thread.
const OpenClLoader& opencl_loader();

}  // namespace csgrt
