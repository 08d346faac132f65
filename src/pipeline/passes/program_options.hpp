// Program options: how the pipeline's programs are compiled and launched.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "device/device.hpp"

namespace csgrt {

/// Work-items of a group, for kernels whose work-items take about equally long.
inline constexpr std::size_t work_group = 64;
/// Work-items of a group for first hits and culling, whose work-items take different times. A processor's thread runs
/// whole groups. With 64 work-items, one slow work-item would keep a thread busy after all other threads have ended,
/// and the thread would need the private memory of 64 work-items.
std::size_t divergent_group(const Device& device);

/// Are a picture's rays traced side by side in a processor's vectors, `packet_rays` a work-item?
bool traces_packets(const Device& device, const Settings& settings);
inline constexpr std::uint32_t packet_rays = 8;  // PACKET of kernels/packet/packet.h

/// The features that a scene needs of its programs. A program with more features gives the same bits.
struct ProgramNeeds {
    std::uint32_t solid_types;
    bool large_terms, shaped_lights;

    explicit ProgramNeeds(const CompiledScene& scene);
    bool covers(const ProgramNeeds& other) const {
        return (other.solid_types & ~solid_types) == 0 && large_terms >= other.large_terms &&
               shaped_lights >= other.shaped_lights;
    }
};

/// Can a program of this device that was made for `one` draw `other`? The native device's programs can draw all scenes.
bool draws(const Device& device, const ProgramNeeds& one, const ProgramNeeds& other);

/// The options (-D) that a program for such scenes is compiled with.
std::vector<std::string> program_options(const Device& device, const ProgramNeeds& needs, const Settings& settings);

}  // namespace csgrt
