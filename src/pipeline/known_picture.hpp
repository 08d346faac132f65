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
    /// Makes `pixels` floats of each plane known to the device, unless its driver refuses. For several devices on several
    /// threads: each has an `entry` of its own below `devices`.
    explicit KnownPicture(std::size_t devices) : entries_(devices) {}
    void add(std::size_t entry, const Device& device, std::span<const ChannelPlane> planes, std::size_t pixels);

    bool is_known_to(const Device& device) const;

private:
    struct Entry {
        cl_context context = nullptr;  ///< the memory holds on to it: no other comes to stand there
        std::vector<KnownMemory> planes;
    };
    std::vector<Entry> entries_;
};

}  // namespace csgrt
