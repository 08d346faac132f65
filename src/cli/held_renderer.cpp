#include "held_renderer.hpp"

#include <cstdio>
#include <cstdlib>
#include <new>
#include <vector>

namespace csgrt::cli {

namespace {

bool is_busy(const Renderer& renderer) { return !renderer.statistics().awaited_device.empty(); }

/// Empty, or not destroyed: end_process() sees to it.
std::vector<Renderer> left_busy;

}  // namespace

HeldRenderer::~HeldRenderer() {
    if (!is_busy(renderer_)) return;
    try {
        left_busy.push_back(std::move(renderer_));
    } catch (const std::bad_alloc&) {  // then it is waited for
    }
}

int end_process(int status) {
    while (!left_busy.empty()) {
        if (is_busy(left_busy.back())) {
            std::fflush(nullptr);
            std::quick_exit(status);
        }
        left_busy.pop_back();
    }
    return status;
}

}  // namespace csgrt::cli
