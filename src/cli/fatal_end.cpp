#include "fatal_end.hpp"

#if defined(__linux__) && !defined(CSGRT_HAS_OWN_HANDLERS)

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <ucontext.h>
#include <unistd.h>

#include <csgrt/error.hpp>

namespace csgrt::cli {
namespace {

std::atomic<bool> loads_pictures{false};
const std::string* driver_advice = nullptr;

struct Mapped {
    bool is_own = false;      ///< the address is in csgrt's own code
    bool has_driver = false;  ///< an OpenCL driver is in the process
};

void look_at(const char* line, unsigned long place, Mapped& mapped) {
    char* end = nullptr;
    const unsigned long first = std::strtoul(line, &end, 16), last = std::strtoul(end + 1, nullptr, 16);
    const char* const name = std::strrchr(line, '/');
    if (name == nullptr) return;
    // The drivers are libpocl, libintelocl, libigdrcl, libamdocl64, libnvidia-opencl and libMesaOpenCL. libOpenCL is
    // only the loader, and OpenImageIO loads it.
    for (const char* part : {"ocl", "igdrcl", "opencl", "OpenCL"})
        if (std::strstr(name, part) != nullptr && std::strncmp(name, "/libOpenCL", 10) != 0) mapped.has_driver = true;
    const bool is_csgrt = std::strncmp(name, "/csgrt", 6) == 0 || std::strncmp(name, "/libcsgrt", 9) == 0;
    if (is_csgrt && first <= place && place < last) mapped.is_own = true;
}

/// Finds the library at an address by the system's list of mappings, because a signal handler must not take the dynamic
/// loader's lock.
Mapped look_for(unsigned long place) {
    Mapped mapped;
    char block[4096], line[512];
    std::size_t length = 0;
    const int file = open("/proc/self/maps", O_RDONLY | O_CLOEXEC);
    for (ssize_t count; (count = read(file, block, sizeof block)) > 0;)
        for (ssize_t i = 0; i < count; ++i) {
            if (block[i] != '\n') {
                if (length + 1 < sizeof line) line[length++] = block[i];
                continue;
            }
            line[std::exchange(length, 0)] = '\0';
            look_at(line, place, mapped);
        }
    close(file);
    return mapped;
}

unsigned long place_of([[maybe_unused]] const void* context) {
#if defined(__x86_64__)
    return static_cast<unsigned long>(static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
    return static_cast<const ucontext_t*>(context)->uc_mcontext.pc;
#else
    return 0;
#endif
}

void say(const char* text) { static_cast<void>(!write(STDERR_FILENO, text, std::strlen(text))); }

/// Prints a message and ends the process, if the fault is in libraries of others. Else returns, and the signal has its
/// default effect.
void end(int signal, unsigned long place) {
    if (driver_advice == nullptr) return;
    const Mapped mapped = look_for(place);
    if (mapped.is_own || (!mapped.has_driver && !loads_pictures)) return;
    say("csgrt: error: ended by ");
    say(signal == SIGABRT ? "SIGABRT" : signal == SIGBUS ? "SIGBUS" : "SIGSEGV");
    if (mapped.has_driver) {
        say(driver_advice->c_str());
        _exit(static_cast<int>(Status::device_fault));
    }
    say(" while the libraries for pictures were in use: is there enough memory, and are there threads to be had?\n");
    _exit(static_cast<int>(Status::file));
}

void on_fatal(int signal, siginfo_t*, void* context) { end(signal, place_of(context)); }

}  // namespace

void catch_fatal_ends() {
    const char* const cache = std::getenv("POCL_CACHE_DIR");
    driver_advice = new std::string(std::string(" while an OpenCL driver was in use. If that is PoCL, its cache may be "
                                                "damaged: remove the folder ") +
                                    (cache ? cache : "~/.cache/pocl") + ". --device native needs no driver\n");
    catch_fatal_ends_again();
}

void catch_fatal_ends_again() noexcept {
    struct sigaction action {};
    action.sa_sigaction = on_fatal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = static_cast<int>(SA_SIGINFO | SA_RESETHAND);
    for (const int signal : {SIGABRT, SIGBUS, SIGSEGV}) sigaction(signal, &action, nullptr);
}

void expect_picture_libraries() noexcept { loads_pictures = true; }

void on_abort(void* caller) noexcept { end(SIGABRT, reinterpret_cast<unsigned long>(caller)); }

}  // namespace csgrt::cli

#else

namespace csgrt::cli {

void catch_fatal_ends() {}
void catch_fatal_ends_again() noexcept {}
void expect_picture_libraries() noexcept {}
void on_abort(void*) noexcept {}

}  // namespace csgrt::cli

#endif
