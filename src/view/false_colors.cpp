#include "false_colors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <csgrt/view.hpp>

namespace csgrt {

namespace {

constexpr std::uint32_t opaque = 0xff000000u, nothing = 0;  // where a ray hits nothing, the page's ground shows

std::uint32_t pixel(double red, double green, double blue) {
    const auto byte = [](double value) { return static_cast<std::uint32_t>(std::clamp(value, 0.0, 1.0) * 255 + 0.5); };
    return opaque | byte(blue) << 16 | byte(green) << 8 | byte(red);
}

std::uint32_t gray(double value) { return pixel(value, value, value); }

/// A bright colour by its hue: 0 and 1 are red, 1/3 is green, 2/3 is blue.
std::uint32_t of_hue(double hue, double value = 1) {
    const auto part = [&](double shift) {
        const double place = 6 * (hue + shift - std::floor(hue + shift));
        return value * std::clamp(std::abs(place - 3) - 1, 0.15, 1.0);
    };
    return pixel(part(0), part(-1.0 / 3), part(-2.0 / 3));
}

/// The colour of a region. Regions with neighbouring numbers get very different colours.
std::uint32_t of_region(std::uint32_t number) {
    if (number == 0) return nothing;
    constexpr double golden = 0.6180339887498949;
    return of_hue(golden * number, number % 3 == 0 ? 1 : number % 3 == 1 ? 0.8 : 0.62);
}

std::optional<std::pair<double, double>> paint_depth(std::span<const float> depth, std::span<std::uint32_t> pixels) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const float z : depth) {
        if (!std::isfinite(z)) continue;
        low = std::min(low, z);
        high = std::max(high, z);
    }
    const double range = high > low ? double{high} - low : 1;
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = std::isfinite(depth[i]) ? gray(1 - 0.8 * (double{depth[i]} - low) / range) : nothing;
    if (low > high) return {};
    return std::pair(double{low}, double{high});
}

void paint_normals(const Image& image, std::span<std::uint32_t> pixels) {
    const std::array<std::span<const float>, 3> n{image.channel("N.X"), image.channel("N.Y"), image.channel("N.Z")};
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const bool hit = n[0][i] != 0 || n[1][i] != 0 || n[2][i] != 0;
        pixels[i] = hit ? pixel((n[0][i] + 1) / 2, (n[1][i] + 1) / 2, (n[2][i] + 1) / 2) : nothing;
    }
}

/// Paints overlaps red, even behind other regions, and everything else grey.
void paint_overlaps(const Image& image, std::span<std::uint32_t> pixels) {
    const auto overlaps = image.channel("overlap"), partitions = image.channel("partitions");
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = overlaps[i] > 0     ? pixel(0.6 + 0.1 * overlaps[i], 0.05, 0.05)
                    : partitions[i] > 0 ? gray(0.3)
                                        : nothing;
}

std::pair<double, double> paint_segments(std::span<const float> counts, std::span<std::uint32_t> pixels) {
    const float most = std::max(1.0f, *std::max_element(counts.begin(), counts.end()));
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = counts[i] > 0 ? of_hue(2.0 / 3 * (1 - counts[i] / most)) : nothing;
    return {0, most};
}

/// Paints what is seen of selected regions red, with its outline, and hatches green what planes have cut.
void paint_marks(const Image& image, const std::vector<bool>& selected, std::span<std::uint32_t> pixels) {
    const auto regions = image.ids("region"), solids = image.ids("solid");
    const int width = image.width, height = image.height;
    const auto is_selected = [&](int x, int y) {
        const std::uint32_t region = regions[static_cast<std::size_t>(y) * width + x];
        return region > 0 && region <= selected.size() && selected[region - 1];
    };
    const auto is_border = [&](int x, int y) {
        for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
            for (int step = 1; step <= 2; ++step) {
                const int column = x + step * dx, row = y + step * dy;
                const bool is_inside = column >= 0 && column < width && row >= 0 && row < height;
                if (is_inside && !is_selected(column, row)) return true;
            }
        return false;
    };
    constexpr std::uint32_t outline = 255, tint = 40, apart = 9;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * width + x;
            const std::uint32_t red = !is_selected(x, y) ? 0 : is_border(x, y) ? outline : tint;
            const bool is_hatched = regions[i] > 0 && solids[i] == 0 && static_cast<std::uint32_t>(x + y) % apart == 0;
            pixels[i] = opaque | red | (is_hatched ? 0xff00u : 0u);
        }
}

/// Draws a light line between pixels of different ghosts.
void outline_ghosts(const Image& image, std::span<std::uint32_t> pixels) {
    const auto ghosts = image.ids("ghost");
    const auto width = static_cast<std::size_t>(image.width);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const bool differs =
            (i % width > 0 && ghosts[i] != ghosts[i - 1]) || (i >= width && ghosts[i] != ghosts[i - width]);
        if (!differs) continue;
        std::uint32_t lighter = opaque;
        for (const int shift : {0, 8, 16}) lighter |= ((pixels[i] >> shift & 0xff) + 255) / 2 << shift;
        pixels[i] = lighter;
    }
}

}  // namespace

std::uint32_t channels_for(Show show, bool has_ghosts) {
    switch (show) {
        case Show::color:
            return channel::display | (has_ghosts ? channel::ghosts : 0);
        case Show::depth:
            return channel::distance;
        case Show::normal:
            return channel::normal;
        case Show::region:
        case Show::marks:
            return channel::ids;
        case Show::overlap:
        case Show::segments:
            return channel::counts;
    }
    return channel::display;
}

std::optional<std::pair<double, double>> paint(const Image& image, Show show, const std::vector<bool>& selected,
                                               std::span<std::uint32_t> pixels) {
    if (pixels.empty()) return {};
    switch (show) {
        case Show::color:
            std::ranges::copy(image.ids("RGBA8"), pixels.begin());
            if (image.has_channel("ghost")) outline_ghosts(image, pixels);
            break;
        case Show::depth:
            return paint_depth(image.channel("Z"), pixels);
        case Show::normal:
            paint_normals(image, pixels);
            break;
        case Show::region:
            std::ranges::transform(image.ids("region"), pixels.begin(), of_region);
            break;
        case Show::overlap:
            paint_overlaps(image, pixels);
            break;
        case Show::segments:
            return paint_segments(image.channel("depth"), pixels);
        case Show::marks:
            paint_marks(image, selected, pixels);
            break;
    }
    return {};
}

}  // namespace csgrt
