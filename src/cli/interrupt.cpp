#include "interrupt.hpp"

#include <atomic>
#include <csignal>
#include <string_view>
#include <system_error>
#include <thread>

#include <unistd.h>

#include <csgrt/error.hpp>

namespace csgrt::cli {

namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler may use only such a flag

constexpr unsigned grace = 4;  ///< seconds: a driver, or a library that is loaded, may never return

void on_signal(int) {
    if (stop.exchange(true)) _exit(static_cast<int>(Status::interrupted));
    alarm(grace);
}

void on_alarm(int) {
    const std::string_view text =
        stop ? "csgrt: error: interrupted\n"
             : "csgrt: warning: the libraries for pictures have not come back from their start "
               "for 30 s: is the machine busy, or are there no threads to be had?\n";
    static_cast<void>(!write(STDERR_FILENO, text.data(), text.size()));
    if (stop) _exit(static_cast<int>(Status::interrupted));
}

}  // namespace

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = 0;  // no SA_RESTART: a read that waits for rays must return
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup ignores signals
    }
    action.sa_handler = on_alarm;
    action.sa_flags = SA_RESTART;  // the loading of a library goes on
    sigaction(SIGALRM, &action, nullptr);
    try {  // this thread can always take a signal; other threads block signals while a driver is loaded
        std::thread([] {
            for (;;) pause();
        }).detach();
    } catch (const std::system_error&) {
    }
}

bool interrupted() noexcept { return stop; }

LoadingNotice::LoadingNotice() noexcept { alarm(stop ? grace : 30); }
LoadingNotice::~LoadingNotice() { alarm(stop ? grace : 0); }

void check_interrupt() {
    if (stop) throw Error(Status::interrupted, "interrupted");
}

}  // namespace csgrt::cli
