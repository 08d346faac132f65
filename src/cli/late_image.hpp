// Late image: loads the library for pictures while the scene is loaded and drawn.
#pragma once

#include "cli/commands/commands.hpp"

namespace csgrt::cli {

/// Loads the libraries of csgrt::image on a thread, if `command` writes pictures and names no OpenCL device. If the
/// command measures the time of several frames, the constructor waits for the thread. A failure is reported when the
/// first picture is written. The destructor stops the thread after its current library (about 1 ms, at most 40 ms),
/// because exit() must not run while a library's constructors do. At most one object at a time.
class ImageLoading {
public:
    explicit ImageLoading(const Command& command);
    ~ImageLoading();
    ImageLoading(const ImageLoading&) = delete;
    ImageLoading& operator=(const ImageLoading&) = delete;
};

}  // namespace csgrt::cli
