#include "component.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <string>

#include <csgrt/version.hpp>

namespace csgrt::cli {

void* open_component(const char* library) {
    // The folder is found by the loaded libcsgrt, because a sanitizer's dlopen does not use this program's search path.
    Dl_info core;
    std::filesystem::path path;
    if (dladdr(reinterpret_cast<const void*>(&version), &core))
        path = std::filesystem::path(core.dli_fname).parent_path();
    if (void* const found = dlopen((path / library).c_str(), RTLD_LAZY | RTLD_LOCAL)) return found;
    return dlopen(library, RTLD_LAZY | RTLD_LOCAL);
}

}  // namespace csgrt::cli
