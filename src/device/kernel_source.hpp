// Kernel source: the kernels' text, which is embedded in the library.
#pragma once

#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt {

/// A file of kernels/, embedded in the library.
struct KernelFile {
    const char* name;  ///< under kernels/, with forward slashes: "shared/base.h"
    const char* text;
};
/// Every file under kernels/, by name. Written by cmake/embed.cmake.
const std::vector<KernelFile>& kernel_files();

/// Joins the named files to one text, in the given order. Each `#include "..."`, whose path is relative to the
/// including file, is replaced by the file's text. A file is included only the first time, so an #include must not be
/// inside an #if that may be false. After an #undef of its guard (CSGRT_GEOMETRY_ELL_H for geometry/ell.h) a file may
/// be included once more. #line directives make a compiler name the true file and line. Throws std::logic_error if a
/// file is missing, which is a fault of the library.
std::string assemble_program(const std::vector<std::string>& names);

/// The source of a Program for the device: the text of the named files or, for a native device, the name of a program
/// that was compiled ahead. `native_name`: empty if the method is not the default.
std::string program_source(const DeviceInfo& device, const Settings& settings, const char* native_name,
                           const std::vector<std::string>& files);

}  // namespace csgrt
