// Component: a part of csgrt that a command loads when it needs it.
#pragma once

namespace csgrt::cli {

/// Opens the library of this name in the folder of libcsgrt, or wherever the system finds it, as dlopen() does; null:
/// dlerror() has the reason.
void* open_component(const char* library);

}  // namespace csgrt::cli
