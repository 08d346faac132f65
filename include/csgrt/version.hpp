// Version of these headers, as macros, and of the library that a program runs with. CMakeLists.txt takes the project's
// version from here.
#pragma once

#define CSGRT_VERSION_MAJOR 0
#define CSGRT_VERSION_MINOR 2
#define CSGRT_VERSION_PATCH 0

/// The version as a number, 10,000 x major + 100 x minor + patch: #if CSGRT_VERSION >= 200 holds from version 0.2.0 on.
#define CSGRT_VERSION (CSGRT_VERSION_MAJOR * 10000 + CSGRT_VERSION_MINOR * 100 + CSGRT_VERSION_PATCH)

#define CSGRT_TEXT_OF_(x) #x
#define CSGRT_TEXT_(x) CSGRT_TEXT_OF_(x)
/// The version as text, "0.2.0".
#define CSGRT_VERSION_STRING \
    CSGRT_TEXT_(CSGRT_VERSION_MAJOR) "." CSGRT_TEXT_(CSGRT_VERSION_MINOR) "." CSGRT_TEXT_(CSGRT_VERSION_PATCH)

#ifdef __cplusplus
#include <csgrt/error.hpp>

namespace csgrt {

/// The version of the library that the program has loaded, as CSGRT_VERSION_STRING has it. It differs from
/// CSGRT_VERSION_STRING if the program was compiled with the headers of another version. Throws nothing. Any thread.
CSGRT_API const char* version();

}  // namespace csgrt
#endif
