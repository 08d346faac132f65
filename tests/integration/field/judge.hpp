// Scenes as others make them, before the oracle: a generator makes a scene and rays from a seed, the device and the
// reference answer them to the same bits, and the oracle decides which answers are right.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "catch.hpp"
#include "oracle/print.hpp"
#include "integration/same_answers.hpp"
#include "integration/stress/check.hpp"

namespace csgrt::test {

/// Sums over the scenes of one generator.
struct FieldTally {
    std::size_t scenes = 0, rays = 0;
    std::size_t ties = 0;      ///< rays that rounding of their own numbers decides: not judged
    std::size_t wrong = 0;     ///< decided rays with other regions, gaps included
    std::size_t overlaps = 0;  ///< decided rays with the right regions and other overlaps
    double worst = 0;          ///< an end's distance from the truth, in units of the documented accuracy
    std::string first;         ///< the first wrong ray
};

/// Has the truth a stretch, or a gap, that may be no longer than ends may be apart that are one? `fused`: by how much,
/// along the ray. The oracle knows no such rule.
inline bool may_fuse(const Sequence& sequence, double fused) {
    return std::any_of(sequence.begin(), sequence.end(), [&](const Item& item) {
        return item.out - item.in <= fused + item.in_tolerance + item.out_tolerance;
    });
}

/// Shoots the rays of a scene on the device and on the reference, requires the same bits, and adds what the oracle
/// says to `tally`. `truth`: what the scene means, where the oracle is not to be asked of its own words; of the same
/// rays. `tie(ray, answer)` is called where rounding decides.
template <class Tie>
void judge_field(const stress::StressScene& made, const stress::StressScene& truth, FieldTally& tally, const Tie& tie) {
    Settings settings = on_reference(), device_settings = on_device();
    settings.air = device_settings.air = made.air;
    Renderer reference(made.scene, made.objects, settings);
    Renderer device(made.scene, made.objects, device_settings);
    std::vector<RayPartitions> found = reference.shoot(made.rays);
    {
        INFO("seed " << made.seed);
        require_same(device.shoot(made.rays), found);
    }
    const Renumbering renumbering(reference, made.objects);
    const ExpectedAnswers answers(truth);
    ++tally.scenes;
    tally.rays += made.rays.size();
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Expected expected = answers(i);
        renumbering.apply(found[i]);
        const Vec3& d = made.rays[i].direction;
        if (expected.tie || may_fuse(expected.sequence, reference.statistics().tolerance / std::hypot(d.x, d.y, d.z))) {
            ++tally.ties;
            tie(made.rays[i], found[i]);
            continue;
        }
        const Compared compared = compare(found[i], expected, made.rays[i], reference.statistics().tolerance);
        if (compared.regions) tally.worst = std::max(tally.worst, compared.worst);
        if (compared.regions && !compared.overlaps) ++tally.overlaps;
        if (!compared.regions && tally.wrong++ == 0) {
            keep_finding("wrong", made, made.scene, made.rays[i]);
            tally.first = "seed " + std::to_string(made.seed) + ", ray " + std::to_string(i) + ": " +
                          oracle::describe(made.rays[i]);
        }
    }
}

inline void judge_field(const stress::StressScene& made, FieldTally& tally) {
    judge_field(made, made, tally, [](const Ray&, const RayPartitions&) {});
}

/// Nothing decided is wrong; and, so that a generator cannot go blind, at least one ray in `one_in` is decided.
inline void require_all_right(const FieldTally& tally, std::size_t one_in = 2) {
    INFO(tally.scenes << " scenes, " << tally.rays << " rays, " << tally.ties << " ties, worst end " << tally.worst
                      << "; first wrong: " << tally.first);
    CHECK(tally.wrong == 0);
    CHECK(tally.overlaps == 0);
    CHECK(tally.worst <= 1);
    CHECK((tally.rays - tally.ties) * one_in >= tally.rays);
}

/// Everything decided is right in the scenes make(seed, times) of `count` seeds, from `first` on.
inline void judge_seeds(stress::StressScene (*make)(std::uint64_t, std::size_t), std::uint64_t first,
                        std::uint64_t count, std::size_t times) {
    FieldTally tally;
    for (std::uint64_t seed = first; seed < first + count; ++seed) judge_field(make(seed, times), tally);
    require_all_right(tally);
}

}  // namespace csgrt::test
