// ars, nmg, vol and dsp, each against its own definition.
#include "kernels/geometry/check_meshes.hpp"
#include "oracle/mesh_solids.hpp"

using namespace csgrt;
using oracle::LocalFrame;
using oracle::QVec;
using oracle::Random;

namespace {

/// `make(i, local, random)` gives a shape and its parts.
template <class Make>
void check_shapes(std::size_t solids, std::uint64_t seed, const Make& make) {
    Random random(seed);
    MeshCampaign campaign;
    for (std::size_t i = 0; i < solids; ++i) {
        const std::size_t place = i % std::size(oracle::detail::placements);
        const double size = i % 5 == 3 ? 1e-3 : i % 5 == 4 ? 1e6 : 1;
        const LocalFrame local =
            place == 1 ? oracle::aligned_local_frame(random) : oracle::random_local_frame(random, size);
        const auto [shape, parts] = make(i, local, random);
        const Matrix matrix = oracle::detail::placement(place, local.size, random);
        campaign.shoot(oracle::detail::placements[place], shape, matrix, parts.surface(matrix), random);
    }
    campaign.check();
}

Vec3 place(const LocalFrame& s, double x, double y, double z) { return to_vec3(s.point(x, y, z)); }
const double pi = std::acos(-1.0);

/// A body of rough curves between two points.
std::pair<Shape, oracle::Parts> rough_ars(std::size_t, const LocalFrame& local, Random& random) {
    Ars ars;
    const std::size_t curves = 3 + random.below(4), points = 3 + random.below(6);
    for (std::size_t i = 0; i < curves; ++i) {
        const bool is_end = i == 0 || i + 1 == curves;
        auto& curve = ars.curves.emplace_back();
        for (std::size_t j = 0; j < points; ++j) {
            const double turn = 2 * pi * static_cast<double>(j) / static_cast<double>(points);
            const double r = is_end ? 0 : random.between(0.4, 1);
            curve.push_back(place(local, r * std::cos(turn), r * std::sin(turn), static_cast<double>(i)));
        }
    }
    return {ars, oracle::parts_of(ars)};
}

/// A star with a star cut out of it, moved along z; the two flat faces have one loop each more.
std::pair<Shape, oracle::Parts> star_nmg(std::size_t index, const LocalFrame& local, Random& random) {
    Nmg nmg;
    oracle::Parts parts;
    const auto n = static_cast<std::uint32_t>(12 + random.below(8));
    const bool has_hole = index % 3 != 0;
    for (const double z : {0, 1})
        for (const bool inner : {false, true}) {
            Random rough(index + 7 * inner);  // the same above and below
            for (std::uint32_t j = 0; j < n; ++j) {
                const double turn = 2 * pi * j / n, r = inner ? rough.between(0.4, 0.6) : rough.between(1, 1.3);
                nmg.vertices.push_back(place(local, r * std::cos(turn), r * std::sin(turn), z));
            }
        }
    const std::uint32_t middle = 4 * n;  // not in the faces
    for (const double z : {0, 1}) nmg.vertices.push_back(place(local, 0, 0, z));
    const auto at = [&](std::uint32_t level, std::uint32_t inner, std::uint32_t j) {
        return (2 * level + inner) * n + j % n;
    };
    for (std::uint32_t level = 0; level < 2; ++level) {
        auto& face = nmg.faces.emplace_back();
        for (std::uint32_t inner = 0; inner < (has_hole ? 2u : 1u); ++inner) {
            auto& loop = face.emplace_back();
            for (std::uint32_t j = 0; j < n; ++j) loop.push_back(at(level, inner, j));
            if (random.coin()) std::reverse(loop.begin(), loop.end());
            std::rotate(loop.begin(), loop.begin() + static_cast<int>(random.below(n)), loop.end());
        }
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = at(level, 0, j), b = at(level, 0, j + 1), c = at(level, 1, j + 1),
                                d = at(level, 1, j);
            const auto& v = nmg.vertices;
            if (has_hole)
                parts.quadrangle(v[a], v[b], v[c], v[d]);
            else
                parts.triangle(v[middle + level], v[a], v[b]);
        }
    }
    for (std::uint32_t inner = 0; inner < (has_hole ? 2u : 1u); ++inner)
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = at(0, inner, j), b = at(0, inner, j + 1), c = at(1, inner, j + 1),
                                d = at(1, inner, j);
            const auto& v = nmg.vertices;
            nmg.faces.push_back({{a, b, c, d}});
            parts.quadrangle(v[a], v[b], v[c], v[d]);
        }
    return {nmg, parts};
}

Matrix own_matrix(const LocalFrame& s, double x, double y, double z) {
    return oracle::detail::to_matrix({s.vector(x, 0, 0), s.vector(0, y, 0), s.vector(0, 0, z), s.at});
}

std::pair<Shape, oracle::Parts> speckled_vol(std::size_t index, const LocalFrame& local, Random& random) {
    Vol vol;
    vol.width = static_cast<std::uint32_t>(1 + random.below(5));
    vol.depth = static_cast<std::uint32_t>(1 + random.below(5));
    vol.height = static_cast<std::uint32_t>(1 + random.below(5));
    vol.cell = {random.between(0.5, 2), 1, random.between(0.5, 2)};
    vol.low = 100, vol.high = 200;
    for (std::size_t i = 0; i < std::size_t{vol.width} * vol.depth * vol.height; ++i)
        vol.cells.push_back(static_cast<std::uint8_t>(index % 4 == 0 ? 150 : 50 + random.below(200)));
    vol.cells[random.below(vol.cells.size())] = random.coin() ? 100 : 200;
    vol.matrix = own_matrix(local, 0.2, 0.2, 0.2);
    return {vol, oracle::parts_of(vol)};
}

std::pair<Shape, oracle::Parts> hilly_dsp(std::size_t index, const LocalFrame& local, Random& random) {
    Dsp dsp;
    dsp.width = static_cast<std::uint32_t>(2 + random.below(7));
    dsp.depth = static_cast<std::uint32_t>(2 + random.below(7));
    dsp.cut = static_cast<Dsp::Cut>(index % 3);
    for (std::size_t i = 0; i < std::size_t{dsp.width} * dsp.depth; ++i)
        dsp.heights.push_back(static_cast<std::uint16_t>(random.below(8) == 0 ? 0 : random.below(20)));
    dsp.heights[0] = 65535 / 1000;
    dsp.matrix = own_matrix(local, 0.2, 0.2, 0.05);
    return {dsp, oracle::parts_of(dsp)};
}

}  // namespace

TEST_CASE("geometry: ars agree with the oracle", "[geometry][promise:solids]") { check_shapes(40, 21, rough_ars); }
TEST_CASE("geometry: nmg agree with the oracle", "[geometry][promise:solids]") { check_shapes(40, 22, star_nmg); }
TEST_CASE("geometry: vol agree with the oracle", "[geometry][promise:solids]") { check_shapes(40, 23, speckled_vol); }
TEST_CASE("geometry: dsp agree with the oracle", "[geometry][promise:solids]") { check_shapes(40, 24, hilly_dsp); }

TEST_CASE("geometry: what triangles make agrees with the oracle on a million rays", "[.long]") {
    check_shapes(6'000, 31, rough_ars);
    check_shapes(6'000, 32, star_nmg);
    check_shapes(6'000, 33, speckled_vol);
    check_shapes(6'000, 34, hilly_dsp);
}
