// Interrupts: SIGINT, SIGTERM and SIGHUP. After the first signal csgrt stops where it can tidy up; if this takes 4 s,
// it ends at once. A second signal ends it at once, too. An end at once may leave an unfinished file, *.part
// (base/new_file.hpp).
#pragma once

namespace csgrt::cli {

/// Installs the handlers. Call once, before any other thread starts.
void catch_interrupts();

bool interrupted() noexcept;

/// Warns the user if the libraries for pictures are still being loaded 30 s after its construction. A slow disk takes a
/// few seconds, a busy machine takes longer, and a library may wait for ever: liblog4cplus does if it gets no thread.
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
