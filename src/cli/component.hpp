// Components of csgrt that a command loads when it needs them.
#pragma once

namespace csgrt::cli {

/// The library of that name in the folder of libcsgrt, or wherever the system finds it, as dlopen() returns it; null:
/// dlerror() tells why not.
void* open_component(const char* library);

}  // namespace csgrt::cli
