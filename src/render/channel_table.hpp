// The channels of a picture, in the order in which kernels and images have them.
#pragma once

#include <csgrt/renderer.hpp>

#include "kernel_host/kernels.hpp"

namespace csgrt {

struct ChannelSource {
    const char* name;                      ///< in the image
    std::uint32_t group;                   ///< channel::..., which users choose
    float (*value)(const kernel::Pixel&);  ///< of a pixel as the reference has it
};

inline constexpr ChannelSource channel_table[] = {
    {"R", channel::color, [](const kernel::Pixel& p) { return p.rgba[0]; }},
    {"G", channel::color, [](const kernel::Pixel& p) { return p.rgba[1]; }},
    {"B", channel::color, [](const kernel::Pixel& p) { return p.rgba[2]; }},
    {"A", channel::color, [](const kernel::Pixel& p) { return p.rgba[3]; }},
    {"Z", channel::distance, [](const kernel::Pixel& p) { return p.z; }},
    {"N.X", channel::normal, [](const kernel::Pixel& p) { return p.normal[0]; }},
    {"N.Y", channel::normal, [](const kernel::Pixel& p) { return p.normal[1]; }},
    {"N.Z", channel::normal, [](const kernel::Pixel& p) { return p.normal[2]; }},
    {"region", channel::ids, [](const kernel::Pixel& p) { return static_cast<float>(p.region); }},
    {"solid", channel::ids, [](const kernel::Pixel& p) { return static_cast<float>(p.solid); }},
    {"depth", channel::counts, [](const kernel::Pixel& p) { return static_cast<float>(p.depth); }},
    {"partitions", channel::counts, [](const kernel::Pixel& p) { return static_cast<float>(p.partitions); }},
    {"overlap", channel::counts, [](const kernel::Pixel& p) { return static_cast<float>(p.overlap); }},
};

}  // namespace csgrt
