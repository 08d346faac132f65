// Loads a shared library with many dependencies in less time than one dlopen takes.
#pragma once

#include <stop_token>
#include <string>

namespace csgrt::cli {

/// Loads the libraries that `file` needs, each after those that it needs itself, none into the global scope. `file`
/// itself is left to the caller's dlopen, which then finds them all. A dlopen searches all libraries that it loads for
/// each of their symbols, one after the other, so that its time grows faster than their number. Loaded one by one, the
/// symbols of each are searched for in its own dependencies alone.
///
/// What is not found or cannot be loaded is left out, for the caller's dlopen to report. Returns early after a request
/// to stop, at the next library. Safe from any thread. Does nothing where the C library is not glibc.
void load_leaves_first(const std::string& file, const std::stop_token& token = {});

}  // namespace csgrt::cli
