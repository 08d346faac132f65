// The words by which a scene file chooses: as they stand in the model's enumerations, in the same order.
#pragma once

#include <array>
#include <string_view>

namespace csgrt {

inline constexpr std::array<std::string_view, 3> json_metaball_methods = {"metaball", "isopotential", "blob"};
inline constexpr std::array<std::string_view, 4> json_bot_modes = {"surface", "volume", "plate", "plate_nocos"};
inline constexpr std::array<std::string_view, 3> json_bot_orientations = {"unoriented", "counterclockwise",
                                                                          "clockwise"};
inline constexpr std::array<std::string_view, 2> json_fastgen_kinds = {"plate", "volume"};
inline constexpr std::array<std::string_view, 3> json_dsp_cuts = {"adaptive", "lower_left", "upper_left"};

}  // namespace csgrt
