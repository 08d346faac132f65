// Whole scenes through the floating-point filter and in 113 bits throughout: the same answers, ties included.
#include "catch.hpp"

#include <cstdlib>
#include <filesystem>

#include <csgrt/scene_io.hpp>

#include "oracle/random.hpp"
#include "oracle/scene_oracle.hpp"

using namespace csgrt;
using namespace csgrt::oracle;

namespace {

bool same(double a, double b) { return a == b || std::abs(a - b) <= 1e-14 * std::abs(b); }

std::string contradiction(const SceneAnswer& filtered, const SceneAnswer& full) {
    if (filtered.tie != full.tie || filtered.solid_tie != full.solid_tie) return "a tie or none";
    for (std::size_t r = 0; r < full.regions.size(); ++r) {
        const Spans &a = filtered.regions[r], &b = full.regions[r];
        if (a.size() != b.size() && !full.tie) return "other spans";
        for (std::size_t i = 0; i < std::min(a.size(), b.size()) && !full.tie; ++i)
            if (!same(to_double(a[i].in.at), to_double(b[i].in.at)) ||
                !same(to_double(a[i].out.at), to_double(b[i].out.at)))
                return "other ends";
    }
    // What is claimed for certain, and what may be claimed, on pieces that are no mere rounding.
    std::size_t at = 0;
    for (const Piece& piece : full.pieces) {
        if (!(piece.out - piece.in > 1e-9 * (1 + std::abs(piece.in)))) continue;
        while (at < filtered.pieces.size() && filtered.pieces[at].out <= piece.in + 1e-10 * (1 + std::abs(piece.in)))
            ++at;
        if (at == filtered.pieces.size()) return "fewer pieces";
        const auto equal = [](const Piece::Claim& a, const Piece::Claim& b) {
            return a.region == b.region && a.certain == b.certain;
        };
        const auto &a = filtered.pieces[at].claims, &b = piece.claims;
        if (!std::equal(a.begin(), a.end(), b.begin(), b.end(), equal)) return "other claims";
    }
    return {};
}

}  // namespace

TEST_CASE("scenes give the same with the filter and in 113 bits", "[oracle]") {
    const char* folder = std::getenv("CSGRT_SCENES");
    REQUIRE(folder != nullptr);
    std::size_t scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        // The filter cannot treat blobs and sketches, which are slow in 113 bits.
        if (entry.path().extension() != ".json" || name.ends_with(".schema.json") || name == "blobs.json" ||
            name == "sketches.json")
            continue;
        const Scene scene = load_scene(entry.path().string());
        const SceneOracle filtered(scene, {}, true, true), full(scene, {}, true);
        Settings settings{.reference = true, .skip_unsupported = true};
        const Box box = Renderer(scene, {}, settings).model().bounds();
        const bool bounded = std::isfinite(box.high.x - box.low.x);
        const Vec3 low = bounded ? box.low : Vec3{-9, -9, -9}, high = bounded ? box.high : Vec3{9, 9, 9};
        const double size = to_double(length(QVec(high) - QVec(low)));
        Random random(5);
        std::size_t wrong = 0, hits = 0;
        for (int i = 0; i < 60; ++i) {
            const QVec d = i % 3 == 0 ? random.axis() : random.direction();
            Vec3 through{random.between(low.x, high.x), random.between(low.y, high.y), random.between(low.z, high.z)};
            if (i % 4 == 0) through = {std::round(through.x), std::round(through.y), std::round(through.z)};
            const Ray ray{to_vec3(QVec(through) - quad(2 * size) * d), to_vec3(d)};
            for (const double slack : {0.0, 5e-4}) {
                const SceneAnswer answer = full.shoot(ray, slack);
                hits += !answer.events.empty();
                const std::string what = contradiction(filtered.shoot(ray, slack), answer);
                if (!what.empty() && ++wrong < 4) FAIL_CHECK(name << ", ray " << i << ": " << what);
            }
        }
        CHECK(wrong == 0);
        CHECK(hits > 20);
        ++scenes;
    }
    CHECK(scenes > 10);
}
