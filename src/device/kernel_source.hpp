// The kernels' text, which travels inside the library.
#pragma once

#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt {

struct KernelFile {
    const char* name;  ///< under kernels/, with forward slashes: "shared/base.h"
    const char* text;
};
/// Every file under kernels/, by name. Written by cmake/embed.cmake.
const std::vector<KernelFile>& kernel_files();

/// One text of the named files, in that order, each `#include "..."` replaced by the file that it names, relative to
/// the file that has it. A file comes in once, where it is first wanted, so an #include must not stand inside an #if
/// that may be false; after an #undef of its guard (CSGRT_ELL_H of geometry/ell.h) it may be included once more. #line
/// marks make a compiler name the true file and line. Throws std::logic_error if there is no such file: that is a fault
/// of the library, not of its user.
std::string assemble_program(const std::vector<std::string>& names);

/// What a Program of the device is made of: the text of the named files, or for a native device, whose programs are of
/// the default method, the name of one that was compiled ahead. That is empty for another method.
std::string program_source(const DeviceInfo& device, const Settings& settings, const char* native_name,
                           const std::vector<std::string>& files);

}  // namespace csgrt
