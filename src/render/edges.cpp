#include "render/edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"
#include "kernel_host/geometry.hpp"

namespace csgrt {
namespace {

constexpr float least_cosine = 0.8660254f;  // of 30 degrees
constexpr float pixels_off = 2;             // the tangent plane
constexpr float rounding = 0x1p-21f;        // of distances, which are floats

/// The surfaces that a row of pixels shows, member by member, so that a compiler takes several pixels at a time.
///
/// The point of a pixel is eye + s D with the pixel's direction D, and in a parallel view base + s w. So from a pixel p
/// to its neighbour q, whose direction is D + u or base is base + u, it is (s_q - s_p) D_p + m_q u, where m is s, and
/// in a parallel view 1.
struct Row {
    explicit Row(std::size_t columns) {
        for (std::vector<float>* values : {&s, &m, &along, &right, &up}) values->resize(columns);
        marks.resize(columns);
    }
    std::vector<float> s, m;
    std::vector<float> along, right, up;  ///< the normal's products with D, u and v
    std::vector<std::int32_t> marks;      ///< 1: the pixel is an edge
    std::array<const float*, 3> normal{};
    const float* distance = nullptr;
    const std::uint32_t* region = nullptr;
};

struct Direction {
    explicit Direction(const double (&of)[3])
        : x(static_cast<float>(of[0])), y(static_cast<float>(of[1])), z(static_cast<float>(of[2])) {}
    float x, y, z;
};

/// A picture's surfaces, row by row within the screen.
class Surfaces {
public:
    Surfaces(const kernel::Frame& frame, const Image& image)
        : frame_(frame),
          u_(frame.u),
          v_(frame.v),
          w_(frame.w),
          distance_(image.channel("Z")),
          normal_{image.channel("N.X"), image.channel("N.Y"), image.channel("N.Z")},
          region_(image.ids("region")) {}

    void read(std::size_t line, Row& row) const {
        const std::size_t first = line * frame_.width + frame_.screen.left;
        row.distance = distance_.data() + first;
        row.region = region_.data() + first;
        for (std::size_t i = 0; i < 3; ++i) row.normal[i] = normal_[i].data() + first;
        const auto y = static_cast<float>(frame_.first_y - static_cast<double>(line));
        const auto left = static_cast<float>(frame_.first_x + static_cast<double>(frame_.screen.left));
        for (std::size_t i = 0; i < row.s.size(); ++i) {
            const float x = frame_.perspective ? left + static_cast<float>(i) : 0, up = frame_.perspective ? y : 0;
            const float dx = w_.x + x * u_.x + up * v_.x, dy = w_.y + x * u_.y + up * v_.y,
                        dz = w_.z + x * u_.z + up * v_.z;
            row.s[i] = row.distance[i] / std::sqrt(dx * dx + dy * dy + dz * dz);
            row.m[i] = frame_.perspective ? row.s[i] : 1;
            const float nx = row.normal[0][i], ny = row.normal[1][i], nz = row.normal[2][i];
            row.along[i] = nx * dx + ny * dy + nz * dz;
            row.right[i] = nx * u_.x + ny * u_.y + nz * u_.z;
            row.up[i] = nx * v_.x + ny * v_.y + nz * v_.z;
        }
        std::ranges::fill(row.marks, 0);
    }

    float pixel() const { return std::sqrt(u_.x * u_.x + u_.y * u_.y + u_.z * u_.z); }

private:
    const kernel::Frame& frame_;
    Direction u_, v_, w_;
    std::span<const float> distance_;
    std::array<std::span<const float>, 3> normal_;
    std::span<const std::uint32_t> region_;
};

/// Marks the nearer pixel of each pair (a[i], b[i + shift]) with an edge between them. `a_side` and `b_side`: the
/// products of the normals with the way from a's pixel to b's.
void mark(Row& a, Row& b, std::size_t shift, const std::vector<float>& a_side, const std::vector<float>& b_side,
          float sign, float slack) {
    const std::size_t count = a.s.size() - shift;
    const float *const as = a.s.data(), *const am = a.m.data(), *const along_a = a.along.data(),
                       *const side_a = a_side.data();
    const float *const bs = b.s.data() + shift, *const bm = b.m.data() + shift, *const along_b = b.along.data() + shift,
                       *const side_b = b_side.data() + shift;
    const float *const ax = a.normal[0], *const ay = a.normal[1], *const az = a.normal[2];
    const float *const bx = b.normal[0] + shift, *const by = b.normal[1] + shift, *const bz = b.normal[2] + shift;
    const float *const at = a.distance, *const bt = b.distance + shift;
    const std::uint32_t *const in_a = a.region, *const in_b = b.region + shift;
    std::int32_t *const marks_a = a.marks.data(), *const marks_b = b.marks.data() + shift;
    for (std::size_t i = 0; i < count; ++i) {
        const float deeper = bs[i] - as[i];
        const float off_a = std::abs(deeper * along_a[i] + sign * bm[i] * side_a[i]);
        const float off_b = std::abs(deeper * along_b[i] + sign * am[i] * side_b[i]);
        const float allowed = slack * std::max(am[i], bm[i]) + rounding * std::max(at[i], bt[i]);
        const float cosine = ax[i] * bx[i] + ay[i] * by[i] + az[i] * bz[i], off = std::min(off_a, off_b);
        const std::int32_t is_seen = (in_a[i] | in_b[i]) != 0, differs = in_a[i] != in_b[i];
        const std::int32_t bends = cosine < least_cosine;
        const std::int32_t jumps = allowed < off, is_first = at[i] <= bt[i];
        const std::int32_t is_edge = differs | (is_seen & (bends | jumps));
        marks_a[i] |= is_edge & is_first;
        marks_b[i] |= is_edge & ~is_first;
    }
}

}  // namespace

void draw_edges(const PreparedFrame& prepared, const Image& surfaces, Image& picture) {
    const kernel::ScreenBounds screen = prepared.frame.screen;
    if (screen.right <= screen.left || screen.bottom <= screen.top) return;
    const Surfaces rows(prepared.frame, surfaces);
    const float slack = pixels_off * rows.pixel();
    const std::size_t columns = screen.right - screen.left, lines = screen.bottom - screen.top;
    std::vector<std::span<float>> colors;
    std::span<std::uint32_t> display;
    for (std::size_t c = 0; c < picture.names.size(); ++c) {
        const std::string& name = picture.names[c];
        if (name == "R" || name == "G" || name == "B") colors.push_back(picture.channels[c]);
        if (name == "RGBA8") display = picture.channels.ids(c);
    }
    for_chunks(lines, 32, 0, [&](std::size_t first, std::size_t end, std::size_t) {
        Row above(columns), row(columns);
        const auto blacken = [&](const Row& of, std::size_t line) {
            for (std::size_t i = 0; i < columns; ++i) {
                if (!of.marks[i]) continue;
                const std::size_t at = (screen.top + line) * prepared.frame.width + screen.left + i;
                for (const std::span<float> channel : colors) channel[at] = 0;
                if (!display.empty()) display[at] = 0xff000000u;
            }
        };
        const std::size_t begin = first ? first - 1 : 0, stop = std::min(end + 1, lines);
        for (std::size_t line = begin; line < stop; ++line) {
            rows.read(screen.top + line, row);
            mark(row, row, 1, row.right, row.right, 1, slack);
            if (line > begin) mark(above, row, 0, above.up, row.up, -1, slack);
            if (line > first) blacken(above, line - 1);
            std::swap(above, row);
        }
        if (stop == end) blacken(above, end - 1);
    });
}

}  // namespace csgrt
