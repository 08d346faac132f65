// SIGINT and SIGTERM: the first one asks csgrt to stop where it can tidy up, the second one ends it at once.
#pragma once

namespace csgrt::cli {

/// Call once, before any other thread starts.
void catch_interrupts();

bool interrupted() noexcept;

/// Throws Error (interrupted) if the user asked to stop.
void check_interrupt();

}  // namespace csgrt::cli
