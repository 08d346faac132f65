#include "compile/solids/surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace csgrt {

namespace {

constexpr std::uint32_t none = CellTable::none;
constexpr double point_cell = 1e-7;  // of the scene's radius
constexpr double size_cell = 1e-7;   // of the size itself, which is looked up by its logarithm
constexpr double reach = 1e-9;       // far above `gap`, far below a cell

// Indices of parameters, as in geometry/{affine,ell,tgc,tor}.h.
constexpr std::size_t taper0 = 12, taper1 = 13, tapers_differ = 16, tube = 12;

bool has_apex_origin(std::uint32_t type, const double* reals) {
    return type == SOLID_TGC && reals[taper1] != 0 && reals[taper0] == 0;
}

Wide local_of(const double* reals, const Wide& p) {
    const Wide o = p - Wide(reals[0], reals[1], reals[2]);
    Wide q(0);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            q[row] += static_cast<long double>(reals[3 + 3 * row + column]) * o[column];
    return q;
}

/// The approximate distance of a point of the world outside the surface: f / |gradient of f|.
long double distance(std::uint32_t type, const double* reals, const Wide& p) {
    const Wide q = local_of(reals, p);
    long double f = 0;
    Wide gradient(0);
    if (type == SOLID_ELL) {
        const long double r = glm::length(q);
        f = r - 1;
        gradient = q / r;
    } else {
        const long double r = std::hypot(q.x, q.y);
        if (type == SOLID_TGC) {
            const long double m = reals[taper0] + reals[taper1] * q.z;
            f = r - m;  // beyond the apex there is the other nappe
            gradient = r > 0 ? Wide(q.x / r, q.y / r, -reals[taper1]) : Wide(0, 0, 1);
        } else {
            const long double out = r - 1, around = std::hypot(out, q.z);
            f = around - reals[tube];
            gradient = around > 0 && r > 0 ? Wide(out * q.x / r, out * q.y / r, q.z) / around : Wide(0, 0, 1);
        }
    }
    Wide in_world(0);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            in_world[column] += static_cast<long double>(reals[3 + 3 * row + column]) * gradient[row];
    return f / glm::length(in_world);
}

/// Points all over a surface. They are more than the degrees of freedom of a quadric or a torus.
std::vector<Wide> points_on(std::uint32_t type, const double* reals, const WideMatrix& axes) {
    constexpr int around = 8;
    const long double pi = std::acos(-1.0L);
    const Wide center(reals[0], reals[1], reals[2]);
    std::vector<Wide> points;
    const auto add = [&](long double x, long double y, long double z) {
        points.push_back(center + x * axes[0] + y * axes[1] + z * axes[2]);
    };
    for (int i = 0; i < around; ++i) {
        const long double turn = 2 * pi * i / around, c = std::cos(turn), s = std::sin(turn);
        if (type == SOLID_ELL) {
            add(c, s, 0), add(0.6L * c, 0.6L * s, 0.8L), add(0.8L * c, 0.8L * s, -0.6L);
        } else if (type == SOLID_TGC) {
            for (const long double at : {-1.0L, 0.25L, 1.0L}) {
                const long double z = has_apex_origin(type, reals) ? (reals[taper1] > 0 ? 1 + at : -1 - at) : at;
                const long double m = reals[taper0] + reals[taper1] * z;
                add(m * c, m * s, z);
            }
        } else {
            for (const long double at : {0.3L, 2.4L, 4.5L}) {
                const long double r = 1 + reals[tube] * std::cos(at);
                add(r * c, r * s, reals[tube] * std::sin(at));
            }
        }
    }
    return points;
}

/// The key by which equal surfaces are found. The point is the centre of a ball or torus, the apex of a cone, or the
/// point of a cylinder's axis that is nearest to the scene's middle. The size grows with the radius: of a
/// cone, at distance 1 from the apex.
struct Key {
    Wide point;
    long double size;
};
Key key_of(std::uint32_t type, const double* reals, const WideMatrix& axes, const Vec3& scene_center) {
    const Wide center(reals[0], reals[1], reals[2]);
    if (type == SOLID_ELL) return {center, std::fabs(glm::determinant(axes))};
    if (type == SOLID_TOR) return {center, glm::length(axes[0])};
    const long double p0 = reals[taper0], p1 = reals[taper1];
    const long double across = glm::length(glm::cross(axes[0], axes[1])), height = glm::length(axes[2]);
    if (p1 != 0)
        return {center - (p0 / p1) * axes[2], across * p1 * p1 / (height * height)};  // a cone: its apex, and its width
    const Wide u = axes[2] / height;  // a cylinder: the point of its axis nearest to the middle of the scene
    return {center + glm::dot(wide(scene_center) - center, u) * u, across * p0 * p0};
}

}  // namespace

std::optional<SurfaceTable::Surface> SurfaceTable::surface_of(std::uint32_t type, const double* reals,
                                                              const WideMatrix& axes, const Box& box) const {
    if (type != SOLID_ELL && type != SOLID_TGC && type != SOLID_TOR) return std::nullopt;
    if (type == SOLID_TGC && reals[tapers_differ] != 0) return std::nullopt;
    const Key key = key_of(type, reals, axes, center_);
    if (!(key.size > 0) || !(radius_ > 0)) return std::nullopt;
    const Wide from_center = key.point - wide(center_);
    return Surface{type,
                   {static_cast<double>(from_center.x), static_cast<double>(from_center.y),
                    static_cast<double>(from_center.z), static_cast<double>(std::log(key.size))},
                   std::max(gap * diagonal(box), coordinate_rounding * largest_coordinate(box))};
}

std::array<Shards::Chunk::Dimension, 5> SurfaceTable::coarse_cells(const Surface& surface) const {
    // A result may lie anywhere in its fine cell.
    constexpr double of_point = 2 * (reach + point_cell), of_size = 2 * (reach + size_cell);
    const auto along = [&](int i) {
        return Shards::Chunk::Dimension{surface.at[i], of_point * radius_ + 10 * rounding_,
                                        0.25 * radius_ + 640 * rounding_};
    };
    return {{along(0), along(1), along(2), {surface.at[3], of_size, 0.25}, {double(surface.type), 0, 1}}};
}

SurfaceTable::Found SurfaceTable::add(const Surface& surface, std::uint32_t number, const RealsOf& reals_of,
                                      const AxesOf& axes_of) {
    const double cell = point_cell * radius_ + 4 * rounding_;
    const auto cells = [&](int i, double tolerance) {
        return i < 3 ? cells_of(surface.at[i], tolerance > 0 ? tolerance * radius_ + rounding_ : 0, cell)
                     : cells_of(surface.at[i], tolerance, size_cell);
    };
    const CellRange ranges[4] = {cells(0, reach), cells(1, reach), cells(2, reach), cells(3, reach)};
    const std::span<const double> mine = reals_of(number);

    std::uint32_t found = none;
    long double out = 0;
    std::vector<Wide> points;
    for (std::int64_t x = ranges[0].first; x <= ranges[0].last; ++x)
        for (std::int64_t y = ranges[1].first; y <= ranges[1].last; ++y)
            for (std::int64_t z = ranges[2].first; z <= ranges[2].last; ++z)
                for (std::int64_t size = ranges[3].first; size <= ranges[3].last; ++size) {
                    const std::uint32_t last = cells_.find(cell_hash({surface.type, x, y, z, size}));
                    if (last == none) continue;
                    if (points.empty()) points = points_on(surface.type, mine.data(), axes_of(number));
                    for (std::uint32_t i = last; i != none; i = entries_[i].next) {
                        const double* other = reals_of(entries_[i].number).data();
                        long double farthest = 0;
                        const bool same = std::all_of(points.begin(), points.end(), [&](const Wide& p) {
                            const long double d = distance(surface.type, other, p);
                            if (std::fabs(d) > std::fabs(farthest)) farthest = d;
                            return std::fabs(d) <= surface.limit;
                        });
                        if (!same || i >= found) continue;
                        found = i;
                        out = farthest;
                    }
                }
    if (found != none) {
        const std::span<const double> first = reals_of(entries_[found].number);
        // A cone with its apex as origin keeps its digits at the apex; a cone whose apex is cut off loses no digits.
        const bool gives = has_apex_origin(surface.type, mine.data()) && !has_apex_origin(surface.type, first.data());
        return {entries_[found].number, static_cast<double>(-out), gives};
    }
    const std::uint64_t hash =
        cell_hash({surface.type, cells(0, 0).first, cells(1, 0).first, cells(2, 0).first, cells(3, 0).first});
    const auto next = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back({number, cells_.exchange(hash, next)});
    return {number, 0, false};
}

}  // namespace csgrt
