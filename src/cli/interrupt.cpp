#include "interrupt.hpp"

#include <atomic>
#include <csignal>

#include <unistd.h>

#include <csgrt/error.hpp>

namespace csgrt::cli {

namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler may touch nothing else

void on_signal(int) {
    if (stop.exchange(true)) _exit(static_cast<int>(Status::interrupted));
}

}  // namespace

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = 0;  // no SA_RESTART: a read that waits for rays must come back
    for (int signal : {SIGINT, SIGTERM}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // ignored as in a script's background
    }
}

bool interrupted() noexcept { return stop; }

void check_interrupt() {
    if (stop) throw Error(Status::interrupted, "interrupted");
}

}  // namespace csgrt::cli
