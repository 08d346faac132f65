#include "kernels/geometry/check_meshes.hpp"
#include "oracle/mesh_answer.hpp"

using namespace csgrt;

namespace {

void check_meshes(std::size_t solids, std::uint64_t seed) {
    oracle::Random random(seed);
    MeshCampaign campaign;
    for (std::size_t i = 0; i < solids; ++i) {
        const oracle::Case one = oracle::make_mesh_case(i, random);
        // Where faces are given more than once: what they make as a set, without seams of no thickness.
        const oracle::MeshSurface surface = oracle::parts_of(std::get<Bot>(one.shape)).surface(one.matrix);
        campaign.shoot(one.name, one.shape, one.matrix, surface, random);
    }
    campaign.check();
}

}  // namespace

TEST_CASE("geometry: meshes (bot) agree with the oracle", "[geometry][promise:solids]") { check_meshes(80, 11); }
TEST_CASE("geometry: meshes (bot) agree with the oracle on a million rays", "[.long][promise:solids]") {
    check_meshes(23'810, 12);
}
