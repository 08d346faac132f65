// Libraries that end the process: a driver whose cache is damaged, or one that gets no thread. The command says so.
#pragma once

namespace csgrt::cli {

/// From now on a signal that ends the process becomes a sentence and an exit status where libraries of others are in
/// use, and the fault is not in csgrt's own code: device_fault with an OpenCL driver, else file with libraries for
/// pictures. Call once, when the environment is as the drivers will see it.
void catch_fatal_ends();
/// The same after a driver's compiler, PoCL's say, has set handlers of its own.
void catch_fatal_ends_again() noexcept;

/// For a call of abort(): what the signal would do.
void on_abort(void* caller) noexcept;

/// The libraries for pictures are loaded from now on.
void expect_picture_libraries() noexcept;

}  // namespace csgrt::cli
