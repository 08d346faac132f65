// Loads a shared library with many dependencies in less time than one dlopen takes.
#pragma once

#include <stop_token>
#include <string>

namespace csgrt::cli {

/// Loads the libraries that `file` needs, each one after its own dependencies, and none into the global scope. The
/// caller's dlopen of `file` then finds all of them loaded. One dlopen of everything looks up each symbol in all
/// libraries that it loads, so its time grows faster than their number. If they are loaded one by one, the symbols of
/// each are looked up in its own dependencies only.
///
/// A library that is not found or cannot be loaded is skipped; the caller's dlopen reports it. Returns at the next
/// library after a request to stop. Safe from any thread. Does nothing if the C library is not glibc.
void load_leaves_first(const std::string& file, const std::stop_token& token = {});

}  // namespace csgrt::cli
