// A command's Renderer, which nobody waits for at the end of the process.
#pragma once

#include <utility>

#include <csgrt/renderer.hpp>

namespace csgrt::cli {

/// Where a driver is compiling kernels yet when this goes, the Renderer is left as it is: nothing can stop the driver,
/// and nobody wants its kernels any more. Else the Renderer goes, too.
class HeldRenderer {
public:
    explicit HeldRenderer(Renderer renderer) : renderer_(std::move(renderer)) {}
    ~HeldRenderer();
    HeldRenderer(const HeldRenderer&) = delete;
    HeldRenderer& operator=(const HeldRenderer&) = delete;

    Renderer& operator*() noexcept { return renderer_; }
    Renderer* operator->() noexcept { return &renderer_; }

private:
    Renderer renderer_;
};

/// The end of main(): returns `status`; where a driver is compiling yet for a Renderer that was left, the process ends
/// here with it, all that was printed being out, and no destructor runs beside the driver.
int end_process(int status);

}  // namespace csgrt::cli
