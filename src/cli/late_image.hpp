// Late image: loads the library for pictures while the scene is loaded and drawn.
#pragma once

#include "cli/commands/commands.hpp"

namespace csgrt::cli {

/// Loads the libraries of csgrt::image on a thread, if `command` writes pictures and names no OpenCL device. If there
/// are several frames, whose time is measured, the constructor waits until they are loaded. A failure is reported when
/// the first picture is written. The destructor stops the thread and waits until it has loaded the current library
/// (about a millisecond, 40 at most): exit() must not run while constructors of libraries do. At most one object at a
/// time.
class ImageLoading {
public:
    explicit ImageLoading(const Command& command);
    ~ImageLoading();
    ImageLoading(const ImageLoading&) = delete;
    ImageLoading& operator=(const ImageLoading&) = delete;
};

}  // namespace csgrt::cli
