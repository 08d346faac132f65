// OpenCL loader of the system, opened when it is first needed.
#pragma once

#include <string>

#include "device/opencl/opencl_table.hpp"

namespace csgrt {

/// The functions of OpenCL, or the reason why they could not be loaded.
struct OpenClLoader {
    const OpenCl* functions = nullptr;  ///< null: there is no usable loader
    std::string fault;                  ///< the reason; empty if no loader is installed
};

/// Uses the OpenCL library that the process has already loaded, or else opens the installed library. This happens once
/// in a process. Any thread.
const OpenClLoader& opencl_loader();

/// The system's message about the last library that this thread could not load. Empty if no load failed since the last
/// call.
std::string last_load_fault();

}  // namespace csgrt
