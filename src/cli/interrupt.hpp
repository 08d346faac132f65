// SIGINT, SIGTERM and SIGHUP: the first one asks csgrt to stop where it can tidy up, and ends it where that takes
// seconds. The second one ends it at once. Then a file that was being written may be left, *.part (base/new_file.hpp).
#pragma once

namespace csgrt::cli {

/// Call once, before any other thread starts.
void catch_interrupts();

bool interrupted() noexcept;

/// While it lives, the libraries for pictures are waited for, and after 30 s the user is told: a cold disk takes a few
/// seconds, a busy machine any time, and one of 260 libraries may wait for ever, such as liblog4cplus for a thread that
/// it does not get.
class LoadingNotice {
public:
    LoadingNotice() noexcept;
    ~LoadingNotice();
    LoadingNotice(const LoadingNotice&) = delete;
    LoadingNotice& operator=(const LoadingNotice&) = delete;
};

/// Throws Error (interrupted) if the user asked to stop.
void check_interrupt();

}  // namespace csgrt::cli
