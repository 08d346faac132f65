// The words by which a scene file chooses: as they stand in the model's enumerations, in the same order.
#pragma once

#include <string_view>
#include <vector>

namespace csgrt {

inline const std::vector<std::string_view> json_metaball_methods = {"metaball", "isopotential", "blob"};
inline const std::vector<std::string_view> json_bot_modes = {"surface", "volume", "plate", "plate_nocos"};
inline const std::vector<std::string_view> json_bot_orientations = {"unoriented", "counterclockwise", "clockwise"};
inline const std::vector<std::string_view> json_dsp_cuts = {"adaptive", "lower_left", "upper_left"};

}  // namespace csgrt
