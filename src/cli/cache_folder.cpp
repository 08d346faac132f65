#include "cache_folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace csgrt::cli {

namespace {

namespace fs = std::filesystem;

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// PoCL's cache folder, from the variables that PoCL reads, in its order: POCL_CACHE_DIR, XDG_CACHE_HOME, HOME.
fs::path cache_folder() {
    if (const std::string folder = variable("POCL_CACHE_DIR"); !folder.empty()) return folder;
    if (const std::string folder = variable("XDG_CACHE_HOME"); !folder.empty())
        return fs::path(folder) / "pocl" / "kcache";
    if (const std::string folder = variable("HOME"); !folder.empty())
        return fs::path(folder) / ".cache" / "pocl" / "kcache";
    return {};
}

/// Can the folder be written? The test writes a file: permissions do not tell whether the file system is full or
/// read-only.
bool can_write(const fs::path& folder) {
    if (folder.empty()) return false;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return false;
    std::string probe = (folder / "csgrt-probe-XXXXXX").string();
    const int file = mkstemp(probe.data());
    if (file < 0) return false;
    const bool written = write(file, "x", 1) == 1;
    close(file);
    unlink(probe.c_str());
    return written;
}

fs::path& temporary_folder() {
    static fs::path folder;
    return folder;
}

}  // namespace

void ensure_cache_folder() {
    if (const fs::path folder = cache_folder(); can_write(folder)) {
        setenv("POCL_CACHE_DIR", folder.c_str(), 1);  // PoCL would take an empty variable for a name
        return;
    }
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    std::string made = ((error ? fs::path("/tmp") : parent) / "csgrt-pocl-XXXXXX").string();
    if (!mkdtemp(made.data())) return;  // no folder can be written: a GPU's driver may work without one
    temporary_folder() = made;
    setenv("POCL_CACHE_DIR", made.c_str(), 1);
    // The removal is registered before the driver is loaded, so it runs after the driver's own work at exit.
    constexpr auto remove = [] {
        std::error_code ignored;
        fs::remove_all(temporary_folder(), ignored);
    };
    std::atexit(remove);
#ifndef __APPLE__
    std::at_quick_exit(remove);
#endif
}

}  // namespace csgrt::cli
