// Table of appearances: a scene may give a region, or all regions below a path, an appearance in place of the colours
// and finish of combinations.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <csgrt/model.hpp>

namespace csgrt {

/// The table finds the appearances of regions by path. It refers to the scene's list.
class AppearanceTable {
public:
    explicit AppearanceTable(const std::vector<Look>& looks);
    /// The numbers of the entries that concern a region, ascending.
    std::vector<std::uint32_t> find(std::string_view path) const;
    /// Applies to a region, whose path is set, the entries that concern it.
    void apply(RegionInfo& region) const;

private:
    const std::vector<Look>& looks_;
    std::unordered_map<std::string_view, std::vector<std::uint32_t>> by_path_;
};

}  // namespace csgrt
