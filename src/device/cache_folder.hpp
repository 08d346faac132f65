// Where PoCL keeps compiled kernels.
#pragma once

namespace csgrt {

/// PoCL crashes when it cannot write its cache. If it could not, points it to a fresh temporary folder, which is removed
/// when the process ends. Call before the first OpenCL call, and before other threads read the environment.
void ensure_cache_folder();

}  // namespace csgrt
