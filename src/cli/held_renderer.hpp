// Held renderer: a command's Renderer, which does not delay the end of the process.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt::cli {

/// Owns a Renderer. If a driver is still compiling kernels for the Renderer, the destructor does not destroy it,
/// because this would wait for the driver, which nothing can stop.
class HeldRenderer {
public:
    explicit HeldRenderer(Renderer renderer) : renderer_(std::move(renderer)) {}
    ~HeldRenderer();
    HeldRenderer(const HeldRenderer&) = delete;
    HeldRenderer& operator=(const HeldRenderer&) = delete;

    Renderer& operator*() noexcept { return renderer_; }
    Renderer* operator->() noexcept { return &renderer_; }
    /// The warnings of the model and the devices, except those that an earlier call has returned.
    std::vector<Warning> new_warnings();

private:
    Renderer renderer_;
    std::size_t returned_ = 0;
};

/// Ends main(): returns `status`. If a driver is still compiling for a Renderer that was not destroyed, the output is
/// flushed and the process exits here with `status`, so that no destructor runs while the driver works.
int end_process(int status);

}  // namespace csgrt::cli
