// Split: splits a range of boxes in two by the surface area heuristic. Cuts are tried at the borders of bins; a few
// boxes are sorted, and every cut is tried. Boxes are moved, not referred to, so that all passes run through memory in
// sequence.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace csgrt::bvh {

/// The largest number of boxes of which every cut is tried. Their order is not kept.
inline constexpr std::size_t few = 8;

/// Four floats, for which a compiler makes one instruction. The last float of `low` and of `high` is a part of the
/// box's number, which a float holds exactly; arithmetic on it has no meaning.
struct alignas(16) Quad {
    float v[4];
};

/// A box in float, rounded outward, with its number.
struct FloatBox {
    Quad low, high;
};

inline constexpr float largest = std::numeric_limits<float>::max();
inline constexpr FloatBox nothing{{{largest, largest, largest, largest}},
                                  {{-largest, -largest, -largest, -largest}}};  // around no box

inline void unite(FloatBox& to, const FloatBox& box) {
    for (int i = 0; i < 4; ++i) to.low.v[i] = box.low.v[i] < to.low.v[i] ? box.low.v[i] : to.low.v[i];
    for (int i = 0; i < 4; ++i) to.high.v[i] = box.high.v[i] > to.high.v[i] ? box.high.v[i] : to.high.v[i];
}
inline Quad middle(const FloatBox& box) {
    Quad m;
    for (int i = 0; i < 4; ++i) m.v[i] = 0.5f * box.low.v[i] + 0.5f * box.high.v[i];
    return m;
}
inline void extend(FloatBox& to, const Quad& p) { unite(to, {p, p}); }

/// A range of boxes that becomes a node of the hierarchy, with the measures by which it is cut.
struct Range {
    std::size_t first, last;
    FloatBox box, middles;  ///< around the boxes and around their middles
    std::size_t size() const { return last - first; }
};

/// Measures the boxes of a range.
void measure(const std::vector<FloatBox>& boxes, Range& range);

/// Moves the boxes of a range so that the boxes of `left` come first, and measures the two sides. Returns false if the
/// range is a leaf. `rights`: memory of this thread.
bool split(std::vector<FloatBox>& boxes, const Range& range, Range& left, Range& right, std::vector<FloatBox>& rights);

}  // namespace csgrt::bvh
