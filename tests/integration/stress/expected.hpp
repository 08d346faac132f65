// What a ray of a stress scene must meet: known from how the scene was made, or found by the oracle.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "integration/stress/sequence.hpp"

namespace csgrt::test {

struct Expected {
    Sequence sequence;
    std::optional<std::vector<std::vector<std::uint32_t>>> overlaps;  ///< none: not known
    bool tie = false;                                                 ///< rounding decides
};

/// Of one scene, which must outlive it.
class ExpectedAnswers {
public:
    /// `filtered`: as in SceneOracle.
    explicit ExpectedAnswers(const stress::StressScene& made, bool filtered = false) : made_(made) {
        if (made.known.empty()) truth_.emplace(made.scene, made.objects, filtered, made.air);
    }

    Expected operator()(std::size_t ray) const {
        if (!truth_) return {sequence_of(made_.known[ray], made_.rays[ray]), {}, false};
        Truth truth = truth_->shoot(made_.rays[ray]);
        if (!truth.certain) truth = TrueScene(made_.scene, made_.objects, false, made_.air).shoot(made_.rays[ray]);
        Expected expected{{}, overlaps_of(truth), truth.tie};
        expected.sequence = sequence_of(truth, expected.tie);
        return expected;
    }

private:
    const stress::StressScene& made_;
    std::optional<TrueScene> truth_;
};

/// Turns a renderer's regions into their places in `objects`: a region without solids is none of the renderer's.
class Renumbering {
public:
    Renumbering(const Renderer& renderer, const std::vector<std::string>& objects) {
        for (const RegionInfo& region : renderer.model().regions()) {
            const std::string name = region.path.substr(region.path.rfind('/') + 1);
            const auto at = std::find(objects.begin(), objects.end(), name);
            number_.push_back(static_cast<std::uint32_t>(at - objects.begin()));
        }
    }
    void apply(RayPartitions& answer) const {
        for (Partition& p : answer.partitions) p.region = number_[p.region];
        for (Overlap& o : answer.overlaps)
            for (std::uint32_t& r : o.regions) r = number_[r];
    }

private:
    std::vector<std::uint32_t> number_;
};

/// How an answer with the regions of `objects` compares with it.
struct Compared {
    bool regions = false;   ///< the right ones, gaps included
    bool overlaps = false;  ///< the right ones, where they are known
    double worst = 0;  ///< if the regions are right: an end's distance from the truth, in units of what is documented
};
/// What is left of a sequence when ends as close as that along the ray are one.
inline Sequence without_short(const Sequence& all, double apart) {
    Sequence rest;
    for (const Item& item : all) {
        if (item.region == nothing || item.out - item.in <= apart) continue;
        Item next = item;
        if (!rest.empty() && next.in - rest.back().out <= apart) next.in = rest.back().out;
        append(rest, next);
    }
    return rest;
}

/// `fused`: ends closer than that are one (Statistics::tolerance), at the distance of the first of them: what is left
/// out of a ray that meets a tip beside its very point is right.
inline Compared compare(const RayPartitions& found, const Expected& expected, const Ray& ray, double fused) {
    const Vec3& d = ray.direction;
    const Sequence sequence = sequence_of(found);
    const double apart = fused / std::hypot(d.x, d.y, d.z);
    Sequence should = expected.sequence;
    if (!same_regions(sequence, should)) should = without_short(should, apart);
    Compared compared;
    compared.regions = same_regions(sequence, should);
    compared.overlaps = !expected.overlaps || overlaps_of(found) == *expected.overlaps;
    if (compared.regions) compared.worst = worst_end(sequence, should, apart);
    return compared;
}

}  // namespace csgrt::test
