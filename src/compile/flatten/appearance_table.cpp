#include "compile/flatten/appearance_table.hpp"

#include <algorithm>

namespace csgrt {

AppearanceTable::AppearanceTable(const std::vector<Look>& looks) : looks_(looks) {
    for (std::uint32_t i = 0; i < looks.size(); ++i) by_path_[looks[i].path].push_back(i);
}

std::vector<std::uint32_t> AppearanceTable::find(std::string_view path) const {
    std::vector<std::uint32_t> all;
    if (by_path_.empty()) return all;
    for (std::size_t end = 1; end <= path.size(); ++end) {  // from "/" on, which is all
        if (end > 1 && end < path.size() && path[end] != '/') continue;
        const auto found = by_path_.find(path.substr(0, end));
        if (found != by_path_.end()) all.insert(all.end(), found->second.begin(), found->second.end());
    }
    std::sort(all.begin(), all.end());
    return all;
}

void AppearanceTable::apply(RegionInfo& region) const {
    for (const std::uint32_t i : find(region.path)) {
        const Look& look = looks_[i];
        if (look.color) region.color = *look.color;
        if (look.finish) region.finish = *look.finish;
        if (look.state) region.state = *look.state;
    }
}

}  // namespace csgrt
