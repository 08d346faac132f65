// Walls: candidates among the chords of rays, and the smallest wall among them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include <csgrt/measure.hpp>

#include "analysis/vector.hpp"

namespace csgrt::analysis {

inline constexpr double cos_of_walls = 0.86602540378443865;  ///< of 30 degrees

/// A part of a ray between two faces that look away from each other, and are within 30 degrees across it.
struct Chord {
    double size = 0;  ///< millimetres along a normal, if the faces are plane
    Vec3 in = {}, out = {};
    Vec3 in_normal = {}, out_normal = {};
    std::pair<std::int32_t, std::int32_t> solids = {};  ///< of the faces, the smaller number first
};

/// The smallest chords of a region, and how large a boundary has which walls. Of two solids only few chords are kept,
/// because chords between round faces look smaller than their wall is, and would displace those of smaller walls.
struct Chords {
    static constexpr std::size_t most = 24, most_of_solids = 3;
    std::vector<Chord> smallest = {};  ///< ascending
    std::array<double, std::tuple_size_v<decltype(Wall::shares)>> areas = {};

    void add(const Chord& chord) {
        if (smallest.size() == most && !(chord.size < smallest.back().size)) return;
        std::size_t alike = 0, last = smallest.size();
        for (std::size_t i = 0; i < smallest.size(); ++i) {
            if (smallest[i].solids != chord.solids) continue;
            ++alike;
            last = i;
        }
        if (alike == most_of_solids) {
            if (!(chord.size < smallest[last].size)) return;
            smallest.erase(smallest.begin() + static_cast<std::ptrdiff_t>(last));
        }
        const auto at = std::upper_bound(smallest.begin(), smallest.end(), chord,
                                         [](const Chord& a, const Chord& b) { return a.size < b.size; });
        smallest.insert(at, chord);
        if (smallest.size() > most) smallest.pop_back();
    }
    void add_area(double size, double area) {
        const int bin = std::clamp(std::ilogb(size) - Wall::first_exponent, 0, static_cast<int>(areas.size()) - 1);
        areas[static_cast<std::size_t>(bin)] += area;
    }
    void add(const Chords& others, double by) {
        for (const Chord& chord : others.smallest) add(chord);
        for (std::size_t i = 0; i < areas.size(); ++i) areas[i] += by * others.areas[i];
    }
};

/// The walls of regions: shoots along the normals at the ends of their chords.
std::vector<Wall> walls_of(const std::vector<Chords>& chords, Renderer& renderer);

}  // namespace csgrt::analysis
