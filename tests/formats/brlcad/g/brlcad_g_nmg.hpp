// The body of an nmg as binary databases have it: a tetrahedron.
#pragma once

#include <array>
#include <string>

#include "formats/brlcad/g/brlcad_g_writer.hpp"

namespace csgrt::g_test {

/// Only the records that lead from the model to the coordinates: 1 model, region, shell, 4 faceuses, 4 loopuses,
/// 12 edgeuses, 12 vertexuses, 4 vertices, 4 points. Links that nothing follows are 0.
inline std::string tetrahedron_nmg() {
    constexpr std::array<std::array<std::uint64_t, 3>, 4> faces = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    constexpr std::uint64_t end = 0xFFFFFFFF, face = 4, loop = 8, edge = 12, use = 24, vertex = 36, point = 40;
    const auto word = [](std::uint64_t value) { return number(value, 2); };
    const auto row = [&](const char* magic, std::initializer_list<std::uint64_t> values) {
        std::string out = magic;
        for (const std::uint64_t value : values) out += word(value);
        return out;
    };
    std::string out = word(1);
    std::array<std::uint64_t, 26> counts{};
    counts[0] = counts[1] = counts[3] = 1;
    counts[5] = counts[9] = counts[19] = counts[20] = 4;
    counts[12] = counts[16] = 12;
    for (const std::uint64_t count : counts) out += word(count);
    out += row("Nmod", {0, 2, 2});
    out += row("Nreg", {end, end, 1, 0, 3, 3});
    out += row("Nshl", {end, end, 2, 0, face, face + 3, end, end, end, end, 0});
    for (std::uint64_t f = 0; f < 4; ++f) {
        out += row("Nfu ", {f < 3 ? face + f + 1 : end, 0, 3, 0, 1, 0, 0, loop + f, loop + f});
    }
    for (std::uint64_t f = 0; f < 4; ++f) {
        out += row("Nlu ", {end, end, face + f, 0, 1, 0, 0, edge + 3 * f, edge + 3 * f + 2});
    }
    for (std::uint64_t e = 0; e < 12; ++e) {
        out += row("Neu ", {e % 3 < 2 ? edge + e + 1 : end, 0, end, end, loop + e / 3, 0, 0, 0, 0, 0, use + e, 0});
    }
    for (std::uint64_t e = 0; e < 12; ++e) out += row("Nvu ", {end, end, edge + e, vertex + faces[e / 3][e % 3], 0});
    for (std::uint64_t v = 0; v < 4; ++v) out += row("Nvrt", {end, end, point + v});
    const double points[4][3] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
    for (const auto& p : points) out += "Nv_g" + reals({p[0], p[1], p[2]});
    return out;
}

}  // namespace csgrt::g_test
