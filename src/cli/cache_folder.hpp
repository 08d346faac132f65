// The folder of PoCL's kernel cache. The program sets it, not the library, because it changes the environment.
#pragma once

namespace csgrt::cli {

/// PoCL fails, or ends the process, when it cannot write its cache. Sets POCL_CACHE_DIR to the folder that it would
/// use, or, if that cannot be written, to a fresh temporary one, which is removed when the process ends. Call once,
/// before the first OpenCL call and before any other thread starts: threads may read the environment.
void ensure_cache_folder();

}  // namespace csgrt::cli
