#include "compile/solids/cell_outline.hpp"

namespace csgrt {

std::vector<StraightLine> cell_outline(const Ebm& ebm) {
    const std::int64_t width = ebm.width, depth = ebm.depth;
    const auto solid = [&](std::int64_t x, std::int64_t y) {
        return x >= 0 && y >= 0 && x < width && y < depth && ebm.cells[static_cast<std::size_t>(y * width + x)] != 0;
    };
    std::vector<StraightLine> lines;
    // Finds the runs along one line of the grid. `differ(i)`: whether the cells on the two sides of part i differ.
    const auto runs = [](std::int64_t count, const auto& differ, const auto& add) {
        std::int64_t start = -1;
        for (std::int64_t i = 0; i <= count; ++i) {
            const bool edge = i < count && differ(i);
            if (edge && start < 0) start = i;
            if (!edge && start >= 0) {
                add(static_cast<long double>(start), static_cast<long double>(i));
                start = -1;
            }
        }
    };
    for (std::int64_t y = 0; y <= depth; ++y)
        runs(
            width, [&](std::int64_t x) { return solid(x, y - 1) != solid(x, y); },
            [&](long double from, long double to) {
                const auto v = static_cast<long double>(y);
                lines.push_back({from, v, to, v});
            });
    for (std::int64_t x = 0; x <= width; ++x)
        runs(
            depth, [&](std::int64_t y) { return solid(x - 1, y) != solid(x, y); },
            [&](long double from, long double to) {
                const auto u = static_cast<long double>(x);
                lines.push_back({u, from, u, to});
            });
    return lines;
}

}  // namespace csgrt
