// Triangles of grids: terrain and volumes.
#include <cmath>

#include "compile/solids/meshes/triangles.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

/// Heights of a terrain, by cell and corner; beyond the border the last height is repeated.
class Terrain {
public:
    explicit Terrain(const Dsp& dsp) : dsp_(dsp) {}

    double height(std::int64_t x, std::int64_t y) const {
        const auto within = [](std::int64_t i, std::uint32_t count) {
            return static_cast<std::size_t>(i < 0 ? 0 : i < count ? i : count - 1);
        };
        return dsp_.heights[within(y, dsp_.depth) * dsp_.width + within(x, dsp_.width)];
    }

    /// Is the cell cut from its lower left to its upper right corner? The adaptive cut is along the diagonal that bends
    /// less, measured with the next corner beyond each of its ends. If the two diagonals bend alike, the cell is not
    /// cut upward.
    bool is_cut_upward(std::int64_t x, std::int64_t y) const {
        switch (dsp_.cut) {
            case Dsp::Cut::lower_left:
                return true;
            case Dsp::Cut::upper_left:
                return false;
            default:
                return bend(height(x - 1, y - 1), height(x, y), height(x + 1, y + 1), height(x + 2, y + 2)) <
                       bend(height(x + 2, y - 1), height(x + 1, y), height(x, y + 1), height(x - 1, y + 2));
        }
    }

private:
    static double bend(double before, double first, double second, double behind) {
        return std::abs(before - 2 * first + second) + std::abs(first - 2 * second + behind);
    }

    const Dsp& dsp_;
};

}  // namespace

Triangles triangles_of(const Dsp& dsp) {
    const std::uint32_t width = dsp.width, depth = dsp.depth;
    if (std::size_t{width} * depth > most_triangles / 3)
        throw Error(Status::scene,
                    "a terrain of " + std::to_string(std::size_t{width} * depth) + " heights cannot be rendered");
    const Terrain terrain(dsp);
    Triangles mesh;
    mesh.vertices.reserve(std::size_t{width} * depth + 2 * (std::size_t{width} + depth));
    for (std::uint32_t y = 0; y < depth; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            mesh.vertices.push_back({static_cast<double>(x), static_cast<double>(y), terrain.height(x, y)});
    const auto corner = [&](std::uint32_t x, std::uint32_t y) { return y * width + x; };
    mesh.faces.reserve(2 * std::size_t{width} * depth + 6 * (std::size_t{width} + depth));
    for (std::uint32_t y = 0; y + 1 < depth; ++y)
        for (std::uint32_t x = 0; x + 1 < width; ++x) {
            const std::uint32_t a = corner(x, y), b = corner(x + 1, y), c = corner(x + 1, y + 1), d = corner(x, y + 1);
            if (terrain.is_cut_upward(x, y))
                mesh.quadrangle(a, b, c, d);
            else
                mesh.quadrangle(b, c, d, a);
        }

    std::vector<std::uint32_t> border;  // counterclockwise
    for (std::uint32_t x = 0; x + 1 < width; ++x) border.push_back(corner(x, 0));
    for (std::uint32_t y = 0; y + 1 < depth; ++y) border.push_back(corner(width - 1, y));
    for (std::uint32_t x = width - 1; x > 0; --x) border.push_back(corner(x, depth - 1));
    for (std::uint32_t y = depth - 1; y > 0; --y) border.push_back(corner(0, y));
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto count = static_cast<std::uint32_t>(border.size());
    for (const std::uint32_t top : border) mesh.vertices.push_back({mesh.vertices[top].x, mesh.vertices[top].y, 0});
    const std::uint32_t middle = first + count;
    mesh.vertices.push_back({0.5 * (width - 1), 0.5 * (depth - 1), 0});
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        mesh.quadrangle(first + i, first + next, border[next], border[i]);
        mesh.triangle(middle, first + next, first + i);
    }
    return mesh;
}

namespace {

/// The cells of a vol, and the faces between solid and empty ones.
class Volume {
public:
    explicit Volume(const Vol& vol)
        : vol_(vol), size_{std::int64_t{vol.width}, std::int64_t{vol.depth}, std::int64_t{vol.height}} {}

    /// Calls `call` once for every face between a solid cell and an empty cell, with the cell on the face's far side
    /// and the axis across the face.
    template <class Call>
    void for_each_face(const Call& call) const {
        for (std::int64_t z = 0; z <= size_[2]; ++z)
            for (std::int64_t y = 0; y <= size_[1]; ++y)
                for (std::int64_t x = 0; x <= size_[0]; ++x) {
                    const bool here = solid(x, y, z);
                    if (here != solid(x - 1, y, z)) call(x, y, z, 0);
                    if (here != solid(x, y - 1, z)) call(x, y, z, 1);
                    if (here != solid(x, y, z - 1)) call(x, y, z, 2);
                }
    }
    std::size_t corner(std::int64_t x, std::int64_t y, std::int64_t z) const {
        return static_cast<std::size_t>((z * (size_[1] + 1) + y) * (size_[0] + 1) + x);
    }
    std::size_t corners() const { return corner(0, 0, size_[2] + 1); }

private:
    bool solid(std::int64_t x, std::int64_t y, std::int64_t z) const {
        if (x < 0 || y < 0 || z < 0 || x >= size_[0] || y >= size_[1] || z >= size_[2]) return false;
        const std::uint8_t value = vol_.cells[static_cast<std::size_t>((z * size_[1] + y) * size_[0] + x)];
        return vol_.low <= value && value <= vol_.high;
    }

    const Vol& vol_;
    std::array<std::int64_t, 3> size_;
};

}  // namespace

Matrix grid_matrix(const Vol& vol) {
    return compose(vol.matrix, {vol.cell.x, 0, 0, 0, 0, vol.cell.y, 0, 0, 0, 0, vol.cell.z, 0, 0, 0, 0, 1});
}

Triangles triangles_of(const Vol& vol) {
    const Volume volume(vol);
    std::size_t count = 0;
    volume.for_each_face([&](auto, auto, auto, int) { count += 2; });
    if (count > most_triangles)
        throw Error(Status::scene, "a volume with " + std::to_string(count / 2) + " faces of cells cannot be rendered");

    Triangles mesh;
    mesh.faces.reserve(count);
    constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> numbers(volume.corners(), none);
    const auto vertex = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        std::uint32_t& number = numbers[volume.corner(x, y, z)];
        if (number == none) {
            number = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
        return number;
    };
    volume.for_each_face([&](std::int64_t x, std::int64_t y, std::int64_t z, int axis) {
        const std::int64_t u[3] = {axis == 2, axis == 0, axis == 1}, v[3] = {axis == 1, axis == 2, axis == 0};
        const std::uint32_t a = vertex(x, y, z), b = vertex(x + u[0], y + u[1], z + u[2]),
                            c = vertex(x + u[0] + v[0], y + u[1] + v[1], z + u[2] + v[2]),
                            d = vertex(x + v[0], y + v[1], z + v[2]);
        mesh.quadrangle(a, b, c, d);
    });
    return mesh;
}

}  // namespace csgrt
