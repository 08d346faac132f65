// Fatal end: libraries may end the process, such as a driver whose cache is damaged, or one that gets no thread. The
// command then prints a sentence.
#pragma once

namespace csgrt::cli {

/// Installs handlers: a signal that ends the process becomes a sentence and an exit status if libraries of others are
/// in use, and the fault is not in csgrt's own code: device_fault with an OpenCL driver, else file with libraries for
/// pictures. Call once, when the environment is as the drivers will see it.
void catch_fatal_ends();
/// Installs the handlers again, after a driver's compiler, for example PoCL's, has set its own.
void catch_fatal_ends_again() noexcept;

/// Does for a call of abort() what the signal would do.
void on_abort(void* caller) noexcept;

/// Notes that the libraries for pictures are being loaded.
void expect_picture_libraries() noexcept;

}  // namespace csgrt::cli
