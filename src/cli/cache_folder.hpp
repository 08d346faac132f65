// Cache folder of PoCL's kernels. The program sets it, not the library, because it changes the environment.
#pragma once

namespace csgrt::cli {

/// Makes sure that PoCL can write its cache, because PoCL fails otherwise, or ends the process. Sets POCL_CACHE_DIR to
/// the folder that PoCL would use. If this folder cannot be written, sets it to a new temporary folder, which is
/// removed when the process ends. Call once, before the first OpenCL call and before any other thread starts: threads
/// may read the environment.
void ensure_cache_folder();

}  // namespace csgrt::cli
