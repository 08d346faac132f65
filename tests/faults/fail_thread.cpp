// Loaded before a command (LD_PRELOAD): its thread number CSGRT_FAIL_THREAD is not to be had, and with
// CSGRT_FAIL_THREAD_ON all later ones. They are counted from 1, with CSGRT_FAIL_THREAD_LOADS also those that libraries
// start when they are loaded. The file CSGRT_FAIL_THREAD_TOLD is made when that happens.
#include <atomic>
#include <cerrno>
#include <cstdlib>

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

extern thread_local int loads;

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                              void* argument) noexcept {
    static std::atomic<unsigned long> count{0};
    static const auto real = reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
    const char* const number = std::getenv("CSGRT_FAIL_THREAD");
    if (loads > 0 && !std::getenv("CSGRT_FAIL_THREAD_LOADS")) return real(thread, attributes, work, argument);
    const unsigned long failing = number ? std::strtoul(number, nullptr, 10) : 0, mine = ++count;
    const bool fails = failing > 0 && (mine == failing || (mine > failing && std::getenv("CSGRT_FAIL_THREAD_ON")));
    if (!fails) return real(thread, attributes, work, argument);
    if (const char* const told = std::getenv("CSGRT_FAIL_THREAD_TOLD"))
        close(open(told, O_CREAT | O_WRONLY | O_CLOEXEC, 0600));
    return EAGAIN;
}
