// The memory of a picture that is drawn again and again, made known to the GPUs that draw it, which then copy into it.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "device/buffer.hpp"

namespace csgrt {

class KnownPicture {
public:
    /// Of `pixels` floats a plane, the first of which is this; the others follow each other.
    KnownPicture(float* first_plane, std::size_t pixels) : first_plane_(first_plane), pixels_(pixels) {}

    /// How many planes of the picture, its first ones, a device is to know.
    struct Wanted {
        const Device* device;
        std::size_t planes;
    };
    /// Makes them known to these devices, and to no other any more: fewer, where a driver refuses. Takes a tenth of a second a gigabyte.
    void make_known(std::span<const Wanted> wanted);
    std::size_t planes_known_to(const Device& device) const;
    std::size_t pixels() const { return pixels_; }
    /// Planes are known in pieces, which a copy must not cross: after how many each one ends, ascending.
    std::span<const std::size_t> piece_ends() const { return piece_ends_; }

private:
    struct Known {
        std::size_t planes = 0;
        std::vector<KnownMemory> pieces;
    };

    float* first_plane_;
    std::size_t pixels_;
    std::vector<std::size_t> piece_ends_;
    std::map<cl_context, Known> known_;  ///< what is known holds on to its context: no other comes to stand there
};

}  // namespace csgrt
