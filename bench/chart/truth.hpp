// What rays meet, from the 113-bit reference.
//
// It shares the geometry's formulas, and the compiled scene, with what it judges: it measures what arithmetic, solvers
// and tolerances do. That the formulas are right is the oracle's to say (tests/oracle, tests/stress).
//
// Ends are one where they lie on one surface or within rounding_tolerance (Tolerance::surfaces). A ray is a tie if its
// regions change when its origin moves by `shift_ulps` units in the last place of the largest coordinates that it has
// on its way through the scene, to the four corners of a tetrahedron, or when the tolerance is four times as large. It
// is a tie, too, if one of these moves takes an end of a stretch an eighth of the stretch away. Between two balls that
// touch, for example, a moved ray meets one of them, whichever way it is moved: the regions stay, but rounding decides
// where they are.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "accuracy.hpp"

namespace csgrt::bench {

inline constexpr double shift_ulps = 4;

/// Of one scene.
class Judge {
public:
    /// `threads`: as in Settings.
    Judge(const Scene& scene, const std::vector<std::string>& objects, unsigned threads = 0);
    ~Judge();
    Judge(Judge&&) noexcept;
    std::vector<TrueRay> true_rays(const std::vector<Ray>& rays);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

inline std::vector<TrueRay> true_rays(const Scene& scene, const std::vector<std::string>& objects,
                                      const std::vector<Ray>& rays) {
    return Judge(scene, objects).true_rays(rays);
}

}  // namespace csgrt::bench
