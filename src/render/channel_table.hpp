// Channel table: the channels of a picture, in the order of kernels and images.
#pragma once

#include <bit>

#include <csgrt/renderer.hpp>

#include "kernel_host/geometry.hpp"

namespace csgrt {

/// A channel of pictures: its name, its group, and its value in a pixel of the reference.
struct ChannelSource {
    const char* name;     ///< in the image
    std::uint32_t group;  ///< channel::..., which users choose
    /// The value in a pixel of the reference; for ids their bits.
    float (*value)(const kernel::Pixel&, const kernel::DisplayBytes& display);
};

inline constexpr ChannelSource channel_table[] = {
    {"R", channel::color, [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return p.rgba[0]; }},
    {"G", channel::color, [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return p.rgba[1]; }},
    {"B", channel::color, [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return p.rgba[2]; }},
    {"A", channel::color, [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return p.rgba[3]; }},
    {"Z", channel::distance, [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return p.z; }},
    {"N.X", channel::normal, [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return p.normal[0]; }},
    {"N.Y", channel::normal, [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return p.normal[1]; }},
    {"N.Z", channel::normal, [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return p.normal[2]; }},
    {"region", channel::ids,
     [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return std::bit_cast<float>(p.region); }},
    {"solid", channel::ids,
     [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return std::bit_cast<float>(p.solid); }},
    {"depth", channel::counts,
     [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return static_cast<float>(p.depth); }},
    {"partitions", channel::counts,
     [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return static_cast<float>(p.partitions); }},
    {"overlap", channel::counts,
     [](const kernel::Pixel& p, const kernel::DisplayBytes&) { return static_cast<float>(p.overlap); }},
    {"RGBA8", channel::display,
     [](const kernel::Pixel& p, const kernel::DisplayBytes& display) {
         return std::bit_cast<float>(kernel::display_word(&display, p.rgba[0], p.rgba[1], p.rgba[2], p.rgba[3]));
     }},
    {"ghost", channel::ghosts, [](const kernel::Pixel&, const kernel::DisplayBytes&) { return 0.0f; }},
};

inline bool holds_ids(const ChannelSource& source) {
    return source.group == channel::ids || source.group == channel::display || source.group == channel::ghosts;
}

}  // namespace csgrt
