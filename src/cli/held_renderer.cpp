#include "held_renderer.hpp"

#include <cstdio>
#include <cstdlib>
#include <new>
#include <vector>

namespace csgrt::cli {

namespace {

bool is_busy(const Renderer& renderer) { return !renderer.statistics().awaited_device.empty(); }

/// Renderers that were not destroyed. end_process() empties the list or exits, so the list's own destructor never
/// destroys a Renderer.
std::vector<Renderer> held;

}  // namespace

HeldRenderer::~HeldRenderer() {
    try {
        if (is_busy(renderer_)) held.push_back(std::move(renderer_));
    } catch (const std::bad_alloc&) {  // no memory: the destructor waits for the driver
    }
}

std::vector<Warning> HeldRenderer::new_warnings() {
    std::vector<Warning> all = renderer_.model().warnings();
    all.insert(all.end(), renderer_.device_warnings().begin(), renderer_.device_warnings().end());
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::exchange(returned_, all.size())));
    return all;
}

int end_process(int status) {
    while (!held.empty()) {
        if (is_busy(held.back())) {
            std::fflush(nullptr);
            std::quick_exit(status);
        }
        held.pop_back();
    }
    return status;
}

}  // namespace csgrt::cli
