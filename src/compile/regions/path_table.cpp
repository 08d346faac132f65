#include "compile/regions/path_table.hpp"

#include <algorithm>
#include <numeric>
#include <string>

namespace csgrt {

std::vector<std::uint32_t> LatePathTable::find(const CompiledScene& scene, std::string_view path) {
    LatePathTable& table = *scene.paths;
    std::vector<std::uint32_t>& sorted = table.sorted_;
    const auto path_of = [&](std::uint32_t region) -> const std::string& { return scene.region_info[region].path; };
    std::call_once(table.is_made_, [&] {
        sorted.resize(scene.region_info.size());
        std::iota(sorted.begin(), sorted.end(), 0u);
        std::ranges::sort(sorted, {}, path_of);
    });
    if (path == "/") return sorted;
    // Names may have characters that come before '/', so there may be other paths between a path and those below it.
    auto next = std::ranges::lower_bound(sorted, path, {}, path_of);
    std::vector<std::uint32_t> found;
    if (next != sorted.end() && path_of(*next) == path) found.push_back(*next++);
    if (next == sorted.end() || !path_of(*next).starts_with(path)) return found;
    const auto first_from = [&](char last) {
        return std::ranges::lower_bound(sorted, std::string(path) + last, {}, path_of);
    };
    found.insert(found.end(), first_from('/'), first_from('/' + 1));
    return found;
}

}  // namespace csgrt
