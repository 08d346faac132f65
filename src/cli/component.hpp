// Component: a library of csgrt that a command loads only when it needs the library.
#pragma once

namespace csgrt::cli {

/// Opens `library` as dlopen() does, from libcsgrt's folder or else from where the system finds it. Null: dlerror()
/// tells the reason.
void* open_component(const char* library);

}  // namespace csgrt::cli
