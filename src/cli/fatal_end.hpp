// Fatal end: a message where a library ends the process, for example a driver with a damaged cache or without a thread.
#pragma once

namespace csgrt::cli {

/// Installs handlers for signals that end the process. If libraries of others are in use and the fault is not in
/// csgrt's own code, a handler prints a message and exits: with device_fault if an OpenCL driver is loaded, else with
/// file if libraries for pictures are. Call once, when the environment is as the drivers will see it.
void catch_fatal_ends();
/// Installs the handlers again, after a driver's compiler, for example PoCL's, has set its own.
void catch_fatal_ends_again() noexcept;

/// Handles a call of abort() as the handlers handle a signal.
void on_abort(void* caller) noexcept;

/// Notes that the libraries for pictures are being loaded.
void expect_picture_libraries() noexcept;

}  // namespace csgrt::cli
