// An OpenCL driver that ends the process that loads it, or never comes back, as CSGRT_BAD_DRIVER_DOES says.
#include <csignal>
#include <cstdlib>
#include <string>

#include <unistd.h>

[[gnu::constructor]] static void when_loaded() {
    const char* const does = std::getenv("CSGRT_BAD_DRIVER_DOES");
    const std::string what = does ? does : "";
    if (what == "abort") std::abort();
    if (what == "crash") std::raise(SIGSEGV);
    while (what == "hang") pause();
}
