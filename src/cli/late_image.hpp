// The library for pictures, loaded while the scene is loaded and drawn.
#pragma once

#include "cli/commands/commands.hpp"

namespace csgrt::cli {

/// From its making on, and if `command` writes pictures and names no OpenCL device, a thread loads the libraries of
/// csgrt::image. A failure shows where the first picture is written. The end of its life stops the thread and waits for
/// the library at hand, mostly a millisecond, 40 at most: exit() must not run while constructors of libraries do. One
/// at a time; not to be copied.
class ImageLoading {
public:
    explicit ImageLoading(const Command& command);
    ~ImageLoading();
    ImageLoading(const ImageLoading&) = delete;
    ImageLoading& operator=(const ImageLoading&) = delete;
};

}  // namespace csgrt::cli
