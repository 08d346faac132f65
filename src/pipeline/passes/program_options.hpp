// How the pipeline's programs are compiled and launched.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compile/compiled_scene.hpp"
#include "device/device.hpp"

namespace csgrt {

/// Work-items of a group, for kernels whose items take about equally long.
inline constexpr std::size_t work_group = 64;
/// The same for first hits and culling. A processor's thread takes whole groups: 64 items of which one takes long would
/// keep it busy after all others have ended, and a loop over items keeps the private memory of each.
std::size_t divergent_group(const Device& device);

/// Do a picture's rays go side by side in a processor's vectors, `packet_rays` a work-item?
bool traces_packets(const Device& device, const Settings& settings);
inline constexpr std::uint32_t packet_rays = 8;  // PACKET of kernels/packet/packet.h

/// The options (-D) that a program for this scene is compiled with.
std::vector<std::string> program_options(const Device& device, const CompiledScene& scene, const Settings& settings);

}  // namespace csgrt
