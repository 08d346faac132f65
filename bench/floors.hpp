// What a frame of every partition must do at least, and the time that this takes at the limits of an NVIDIA H200.
#pragma once

#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt::bench {

/// Counted along the rays of a frame by the kernels themselves, run on the host; per pixel of the picture.
struct Floor {
    std::string workload;
    double boxes = 0, solids = 0;  ///< tests, of one walk
    double words = 0;              ///< of Boolean trees
    double segments = 0, partitions = 0;
    double bytes = 0;  ///< that kernels hand on: written once, read once

    /// Milliseconds of a frame of size x size at what was measured on an H200 through OpenCL: 820 billion box tests in
    /// float, 394 billion ray-ellipsoid tests in double a second, 4,259 GB/s copied; and ten operations a word of 61/2
    /// trillion a second.
    double milliseconds(int size) const;
};

/// With the view of a picture, but of 256 x 256 pixels.
Floor count_floor(const std::string& workload, const Scene& scene, const std::vector<std::string>& objects);

/// Beside the measured device time of each workload: milliseconds, negative for none.
void print_floors(const std::vector<Floor>& floors, const std::vector<double>& measured, int size);

}  // namespace csgrt::bench
