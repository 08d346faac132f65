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

/// Assembles one text of the named files, in the given order. Each `#include "..."` is replaced by the file that it
/// names, relative to the including file. A file is included once, where it is first needed, so an #include must not
/// stand inside an #if that may be false. After an #undef of its guard (CSGRT_ELL_H of geometry/ell.h) it may be
/// included once more. #line marks make a compiler name the true file and line. Throws std::logic_error if there is no
/// such file: a fault of the library, not of its user.
std::string assemble_program(const std::vector<std::string>& names);

/// The source of a Program for the device: the text of the named files, or for a native device the name of a program
/// that was compiled ahead. The name is empty for another method than the default.
std::string program_source(const DeviceInfo& device, const Settings& settings, const char* native_name,
                           const std::vector<std::string>& files);

}  // namespace csgrt
