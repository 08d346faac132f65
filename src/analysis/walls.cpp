#include "analysis/walls.hpp"

#include <cmath>
#include <limits>
#include <numeric>

namespace csgrt::analysis {

namespace {

constexpr double parallel = 1 - 1e-9;      ///< the cosine of faces that count as parallel
constexpr std::size_t at_once = 1u << 17;  ///< shots
constexpr double begins = 1e-6;            ///< of the chord: how near a shot's wall begins to where it starts

}  // namespace

std::vector<Wall> walls_of(const std::vector<Chords>& chords, Renderer& renderer) {
    std::vector<Wall> walls(chords.size());
    Partitions rows;
    for (std::size_t region = 0; region < chords.size();) {
        std::vector<Ray> shots;
        std::vector<std::size_t> of;  // the region of each shot
        for (; region < chords.size() && shots.size() < at_once; ++region) {
            for (const Chord& chord : chords[region].smallest) {
                shots.push_back({chord.in, -1.0 * chord.in_normal});
                shots.push_back({chord.out, -1.0 * chord.out_normal});
                of.insert(of.end(), 2, region);
            }
        }
        constexpr double endless = std::numeric_limits<double>::infinity();
        renderer.partitions(shots, rows, {.normals = true}, {.all = {-endless, endless}});
        for (std::size_t i = 0; i < shots.size(); ++i) {
            const auto [origin, d] = shots[i];
            Wall& wall = walls[of[i]];
            for (auto row = static_cast<std::size_t>(rows.ray_splits[i]);
                 row < static_cast<std::size_t>(rows.ray_splits[i + 1]); ++row) {
                if (rows.region_ids[row] != static_cast<std::int32_t>(of[i])) continue;
                const double in = rows.t_in[row], thickness = rows.t_out[row] - in,
                             cosine = dot(rows.out_normals[row], d);
                const bool is_wall = std::abs(in) < begins * thickness && cosine >= cos_of_walls;
                if (!is_wall || (wall.thickness > 0 && thickness >= wall.thickness)) continue;
                wall.thickness = thickness;
                wall.from = origin + in * d;
                wall.to = origin + rows.t_out[row] * d;
                wall.is_tapered = cosine < parallel;
            }
        }
    }
    for (std::size_t r = 0; r < chords.size(); ++r) {
        const auto& areas = chords[r].areas;
        const double sum = std::accumulate(areas.begin(), areas.end(), 0.0);
        for (std::size_t i = 0; sum > 0 && i < areas.size(); ++i) walls[r].shares[i] = areas[i] / sum;
    }
    return walls;
}

}  // namespace csgrt::analysis
