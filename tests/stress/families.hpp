// The stress suite: scenes and rays that go where methods of ray tracing fail.
//
// A family is one such place. It makes any number of scenes, one a seed, each with the rays that provoke it; the same
// on every platform, to the last bit. Every object named in `objects` is one region.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt::stress {

/// A stretch of a ray that belongs to one region.
struct Stretch {
    double in = 0, out = 0;    ///< along the ray, in units of its direction
    std::uint32_t region = 0;  ///< index into StressScene::objects
};

struct StressScene {
    std::string family;
    std::uint64_t seed = 0;
    Scene scene;
    std::vector<std::string> objects;
    bool air = false;  ///< air regions are kept
    std::vector<Ray> rays;
    /// One entry a ray: the whole line's stretches in order, those behind the ray's start too, known from how the scene
    /// was made. Empty: not known.
    std::vector<std::vector<Stretch>> known;
};

/// Their names, in the order in which they are described in tests/stress/README.md.
std::vector<std::string> families();

/// `times`: as many times as many rays, of which the first are the usual ones.
/// Throws Error (usage) if there is no such family.
StressScene make(const std::string& family, std::uint64_t seed, std::size_t times = 1);

}  // namespace csgrt::stress
