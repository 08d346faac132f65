#include "render/edges.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "base/parallel.hpp"
#include "kernel_host/geometry.hpp"

namespace csgrt {
namespace {

using kernel::edge_pixel;

/// The pixels of a row, member by member, so that a compiler takes several pixels at a time.
class Row {
public:
    explicit Row(std::size_t columns) : marks(columns) {
        for (std::vector<float>* values : {&s_, &m_, &along_, &right_, &down_}) values->resize(columns);
    }
    std::vector<std::uint32_t> marks;  ///< the pixels' edges, of the bits below

    std::size_t columns() const { return marks.size(); }

    /// Reads a line of the screen. `first`: its first pixel's index in the channels.
    void read(const Image& image, const kernel::edge_camera& camera, std::size_t line, std::size_t first) {
        distance_ = image.channel("Z").data() + first;
        region_ = image.ids("region").data() + first;
        constexpr const char* names[] = {"N.X", "N.Y", "N.Z"};
        for (std::size_t i = 0; i < 3; ++i) normal_[i] = image.channel(names[i]).data() + first;
        for (std::size_t i = 0; i < columns(); ++i) {
            const edge_pixel pixel = kernel::edge_pixel_at(camera, static_cast<float>(static_cast<std::int32_t>(i)),
                                                           static_cast<float>(line), values(i));
            s_[i] = pixel.s;
            m_[i] = pixel.m;
            along_[i] = pixel.along;
            right_[i] = pixel.right;
            down_[i] = pixel.down;
        }
        std::ranges::fill(marks, 0u);
    }

    edge_pixel operator[](std::size_t i) const {
        edge_pixel pixel = values(i);
        pixel.s = s_[i];
        pixel.m = m_[i];
        pixel.along = along_[i];
        pixel.right = right_[i];
        pixel.down = down_[i];
        return pixel;
    }

private:
    edge_pixel values(std::size_t i) const {
        edge_pixel pixel{};
        pixel.distance = distance_[i];
        pixel.nx = normal_[0][i];
        pixel.ny = normal_[1][i];
        pixel.nz = normal_[2][i];
        pixel.region = region_[i];
        return pixel;
    }

    std::vector<float> s_, m_, along_, right_, down_;
    std::array<const float*, 3> normal_{};
    const float* distance_ = nullptr;
    const std::uint32_t* region_ = nullptr;
};

/// A pixel's edges to its neighbours.
constexpr std::uint32_t to_left = 1, to_right = 2, to_above = 4, to_below = 8;

/// Marks the edges between a[i] and b[i + shift]. `side`: the member with the normal's product with the way from a's
/// pixel to b's. `bit_a` and `bit_b`: their bits in the marks.
template <float edge_pixel::*side, std::uint32_t bit_a, std::uint32_t bit_b>
void mark(Row& a, Row& b, std::size_t shift, float slack) {
    std::uint32_t *const of_a = a.marks.data(), *const of_b = b.marks.data() + shift;
    const std::size_t count = a.columns() - shift;
    for (std::size_t i = 0; i < count; ++i) {
        const edge_pixel one = a[i], other = b[i + shift];
        const std::uint32_t black = kernel::edge_between(one, one.*side, other, other.*side, slack);
        of_a[i] |= (black & 1u) * bit_a;
        of_b[i] |= (black >> 1) * bit_b;
    }
}

}  // namespace

void draw_edges(const PreparedFrame& prepared, const Image& surfaces, Image& picture) {
    const kernel::ScreenBounds screen = prepared.frame.screen;
    if (screen.right <= screen.left || screen.bottom <= screen.top) return;
    const kernel::edge_camera camera = kernel::edge_camera_of(&prepared.frame);
    const std::size_t columns = kernel::width_of(screen), lines = screen.bottom - screen.top;
    const auto index = [&](std::size_t line) { return (screen.top + line) * prepared.frame.width + screen.left; };
    std::vector<std::span<float>> colors;
    std::span<std::uint32_t> display;
    for (std::size_t c = 0; c < picture.names.size(); ++c) {
        const std::string& name = picture.names[c];
        if (name == "R" || name == "G" || name == "B") colors.push_back(picture.channels[c]);
        if (name == "RGBA8") display = picture.channels.ids(c);
    }
    // A border of pixels without edges is around the marks.
    const std::size_t pitch = columns + 2;
    std::vector<std::uint8_t> marks(pitch * (lines + 2));
    const auto marks_of = [&](std::size_t line) { return marks.data() + (line + 1) * pitch + 1; };
    for_chunks(lines, 32, 0, [&](std::size_t first, std::size_t end, std::size_t) {
        Row above(columns), row(columns);
        const auto keep = [&](const Row& of, std::size_t line) {
            std::ranges::transform(of.marks, marks_of(line), [](std::uint32_t m) { return std::uint8_t(m); });
        };
        const std::size_t begin = first ? first - 1 : 0, stop = std::min(end + 1, lines);
        for (std::size_t line = begin; line < stop; ++line) {
            row.read(surfaces, camera, line, index(line));
            mark<&edge_pixel::right, to_right, to_left>(row, row, 1, camera.slack);
            if (line > begin) mark<&edge_pixel::down, to_below, to_above>(above, row, 0, camera.slack);
            if (line > first) keep(above, line - 1);
            std::swap(above, row);
        }
        if (stop == end) keep(above, end - 1);
    });
    for_chunks(lines, 32, 0, [&](std::size_t line, std::size_t end, std::size_t) {
        for (; line < end; ++line) {
            const std::uint8_t* own = marks_of(line);
            for (std::size_t i = 0; i < columns; ++i, ++own) {
                const std::uint32_t m = *own;
                if (!m) continue;
                if (kernel::edge_is_thin(m & to_left, m & to_right, own[1] & to_right, own[-1] & to_left) ||
                    kernel::edge_is_thin(m & to_above, m & to_below, own[pitch] & to_below, *(own - pitch) & to_above))
                    continue;
                for (const std::span<float> channel : colors) channel[index(line) + i] = 0;
                if (!display.empty()) display[index(line) + i] = EDGE_WORD;
            }
        }
    });
}

}  // namespace csgrt
