// Interrupts: SIGINT, SIGTERM and SIGHUP. The first signal makes csgrt stop at a point where it can tidy up, and ends
// it if this takes seconds. The second signal ends it at once. Then a file that was being written may be left, *.part
// (base/new_file.hpp).
#pragma once

namespace csgrt::cli {

/// Installs the handlers. Call once, before any other thread starts.
void catch_interrupts();

bool interrupted() noexcept;

/// Tells the user after 30 s that the libraries for pictures are being loaded, while it lives. A cold disk takes a few
/// seconds, a busy machine any time, and one of 260 libraries may wait for ever, such as liblog4cplus for a thread that
/// it does not get.
class LoadingNotice {
public:
    LoadingNotice() noexcept;
    ~LoadingNotice();
    LoadingNotice(const LoadingNotice&) = delete;
    LoadingNotice& operator=(const LoadingNotice&) = delete;
};

/// Throws Error (interrupted) if the user interrupted.
void check_interrupt();

}  // namespace csgrt::cli
