#include "geometry/check_meshes.hpp"

using namespace csgrt;

namespace {

void check_meshes(std::size_t solids, std::uint64_t seed) {
    oracle::Random random(seed);
    MeshCampaign campaign;
    for (std::size_t i = 0; i < solids; ++i) {
        const oracle::Case one = oracle::make_mesh_case(i, random);
        const Bot& bot = std::get<Bot>(one.shape);
        const oracle::MeshSurface surface(bot.vertices, bot.faces, oracle::to_affine(one.matrix));
        campaign.shoot(one.name, one.shape, one.matrix, surface, random);
    }
    campaign.check();
}

}  // namespace

TEST_CASE("geometry: meshes agree with the oracle", "[geometry]") { check_meshes(80, 11); }
TEST_CASE("geometry: meshes agree with the oracle on a million rays", "[.long]") { check_meshes(23'810, 12); }
