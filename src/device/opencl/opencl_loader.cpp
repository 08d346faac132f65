#include "device/opencl/opencl_loader.hpp"

#include <type_traits>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace csgrt {
namespace {

#ifdef _WIN32
using Library = HMODULE;
constexpr const char* library_names[] = {"OpenCL.dll"};
Library of_process() { return nullptr; }
Library open_library(const char* name) { return LoadLibraryA(name); }
void* symbol_of(Library library, const char* name) { return reinterpret_cast<void*>(GetProcAddress(library, name)); }
// Windows gives only a number.
std::string last_words() { return {}; }
std::string fault_of_opening(const char*) { return {}; }
#else
using Library = void*;
#ifdef __APPLE__
constexpr const char* library_names[] = {"/System/Library/Frameworks/OpenCL.framework/OpenCL"};
#else
constexpr const char* library_names[] = {"libOpenCL.so.1", "libOpenCL.so"};
#endif
// RTLD_DEFAULT is not used, because a library that it finds may be closed later.
Library of_process() { return dlopen(nullptr, RTLD_NOW); }
Library open_library(const char* name) { return dlopen(name, RTLD_NOW | RTLD_LOCAL); }
void* symbol_of(Library library, const char* name) { return dlsym(library, name); }
std::string last_words() {
    const char* const words = dlerror();
    return words ? words : "";
}
/// The reason why a library was not opened. Empty if only the library itself is missing. That another library, which it
/// needs, is missing counts as a fault.
std::string fault_of_opening(const char* name) {
    const std::string fault = last_words();
    return fault.starts_with(std::string(name) + ": cannot open shared object file") ? "" : fault;
}
#endif

/// Fills the table. Returns the name of the first missing function, or an empty text.
std::string fill(Library library, OpenCl& functions) {
    std::string missing;
#define CSGRT_FILL(name)                                                                         \
    functions.name = reinterpret_cast<decltype(functions.name)>(symbol_of(library, "cl" #name)); \
    if (!functions.name && missing.empty()) missing = "cl" #name;
    CSGRT_OPENCL_FUNCTIONS(CSGRT_FILL)
#undef CSGRT_FILL
    return missing;
}

OpenClLoader open_loader() {
    static OpenCl functions;
    OpenClLoader loader;
    if (const Library library = of_process(); library && fill(library, functions).empty()) {
        loader.functions = &functions;
        return loader;
    }
    for (const char* name : library_names) {
        const Library library = open_library(name);
        if (!library) {
            if (loader.fault.empty()) loader.fault = fault_of_opening(name);
            continue;
        }
        const std::string missing = fill(library, functions);
        loader.fault = missing.empty() ? "" : std::string(name) + " has no function " + missing;
        if (missing.empty()) loader.functions = &functions;
        return loader;
    }
    return loader;
}

}  // namespace

const OpenClLoader& opencl_loader() {
    static const auto& loader = *new const OpenClLoader(open_loader());  // never destroyed: threads may outlive exit()
    return loader;
}

std::string last_load_fault() { return last_words(); }

}  // namespace csgrt
