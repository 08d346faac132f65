#include "device/host_memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#if defined(_WIN32)
#include <windows.h>
#elif defined(__APPLE__)
#include <sys/sysctl.h>
#else
#include <unistd.h>
#endif

namespace csgrt {

#if defined(_WIN32)

namespace {

MEMORYSTATUSEX memory_of_system() {
    MEMORYSTATUSEX memory{};
    memory.dwLength = sizeof memory;
    if (!GlobalMemoryStatusEx(&memory)) memory.ullAvailPhys = memory.ullTotalPhys = 0;
    return memory;
}

}  // namespace

std::uint64_t available_host_memory() { return memory_of_system().ullAvailPhys; }
std::uint64_t host_memory() { return memory_of_system().ullTotalPhys; }

#elif defined(__APPLE__)

// macOS has no such number: it frees and compresses memory on demand.
std::uint64_t available_host_memory() { return 0; }

std::uint64_t host_memory() {
    std::uint64_t bytes = 0;
    std::size_t size = sizeof bytes;
    return sysctlbyname("hw.memsize", &bytes, &size, nullptr, 0) == 0 ? bytes : 0;
}

#else

namespace {

constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();

std::uint64_t number_in(const char* path) {
    std::ifstream file(path);
    std::uint64_t number = 0;
    return file >> number ? number : unknown;  // cgroup v2 says "max" if there is no limit
}

std::uint64_t rest_of(const char* limit_path, const char* used_path) {
    const std::uint64_t limit = number_in(limit_path), used = number_in(used_path);
    if (limit == unknown || used == unknown) return unknown;
    return limit > used ? limit - used : 0;
}

std::uint64_t of_system(const std::string& wanted) {
    std::ifstream file("/proc/meminfo");
    std::string key, unit;
    std::uint64_t kilobytes = 0;
    while (file >> key >> kilobytes) {
        if (key == wanted) return kilobytes * 1024;
        std::getline(file, unit);
    }
    return unknown;
}

}  // namespace

std::uint64_t available_host_memory() {
    const std::uint64_t bytes = std::min(
        {of_system("MemAvailable:"), rest_of("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
         rest_of("/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes")});
    return bytes == unknown ? 0 : bytes;
}

std::uint64_t host_memory() {
    const std::uint64_t bytes = of_system("MemTotal:");
    if (bytes != unknown) return bytes;
#ifdef _SC_PHYS_PAGES
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);  // some systems have no /proc
    if (pages > 0 && page > 0) return static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
#endif
    return 0;
}

#endif

}  // namespace csgrt
