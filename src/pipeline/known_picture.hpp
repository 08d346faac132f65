// The memory of a picture that is drawn again and again, made known to the GPUs that draw it, which then copy into it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "device/buffer.hpp"
#include "pipeline/picture.hpp"

namespace csgrt {

class KnownPicture {
public:
    /// Makes `pixels` floats of each of these planes, the picture's first ones, known to the device. False: its driver refuses.
    bool add(const Device& device, std::span<const ChannelPlane> planes, std::size_t pixels);

    /// How many of the planes are known to it.
    std::size_t planes_known_to(const Device& device) const;
    /// The last of them is not any more. There must be one.
    void drop(const Device& device);

private:
    struct Entry {
        cl_context context;  ///< the memory holds on to it: no other comes to stand there
        std::vector<KnownMemory> planes;
    };
    std::size_t find(const Device& device) const;  ///< among the entries; their number if it has none

    std::vector<Entry> entries_;
};

}  // namespace csgrt
