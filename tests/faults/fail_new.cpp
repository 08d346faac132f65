// Loaded before a command (LD_PRELOAD): its allocation number CSGRT_FAIL_NEW fails, and with CSGRT_FAIL_NEW_ON all
// later ones. Of those of less than CSGRT_FAIL_NEW_LEAST bytes none counts. Allocations are counted from 1, those of
// all threads together, less those that libraries make when they are loaded. The file CSGRT_FAIL_NEW_TOLD is made when
// that happens. The library for pictures makes the file CSGRT_SLOW_LOAD when its loading begins, and goes on when that
// is removed.
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

thread_local int loads = 0;  ///< libraries

namespace {

std::atomic<unsigned long> count{0};

void* allocate(std::size_t size, std::size_t alignment) {
    static const char* const number = std::getenv("CSGRT_FAIL_NEW");
    static const unsigned long failing = number ? std::strtoul(number, nullptr, 10) : 0;
    static const char* const bytes = std::getenv("CSGRT_FAIL_NEW_LEAST");
    static const unsigned long least = bytes ? std::strtoul(bytes, nullptr, 10) : 0;
    static const bool on = std::getenv("CSGRT_FAIL_NEW_ON") != nullptr;
    const unsigned long mine = loads > 0 || size < least ? 0 : ++count;
    if (failing > 0 && mine > 0 && (mine == failing || (on && mine > failing))) {
        if (const char* const told = std::getenv("CSGRT_FAIL_NEW_TOLD"))
            close(open(told, O_CREAT | O_WRONLY | O_CLOEXEC, 0600));
        throw std::bad_alloc();
    }
    void* const memory = alignment > 0 ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                                       : std::malloc(size > 0 ? size : 1);
    if (!memory) throw std::bad_alloc();
    return memory;
}

}  // namespace

extern "C" void* dlopen(const char* name, int flags) noexcept {
    static const auto real = reinterpret_cast<decltype(&dlopen)>(dlsym(RTLD_NEXT, "dlopen"));
    ++loads;
    const char* const held = std::getenv("CSGRT_SLOW_LOAD");
    if (held != nullptr && name != nullptr && std::strstr(name, "csgrt_image") != nullptr)
        for (close(open(held, O_CREAT | O_WRONLY | O_CLOEXEC, 0600)); access(held, F_OK) == 0;) usleep(10'000);
    void* const library = real(name, flags);
    --loads;
    return library;
}

void* operator new(std::size_t size) { return allocate(size, 0); }
void* operator new[](std::size_t size) { return allocate(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
