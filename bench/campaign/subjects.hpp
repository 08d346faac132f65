// The subjects of a campaign: every scene of the stress suite, our own scenes, BRL-CAD's models. Each has any number of
// rays, and its judge.
//
// The judges are those of the tests: tests/integration/stress/expected.hpp for the stress suite,
// tests/oracle/scene_judge.hpp for the others. They know a scene by its implicit functions, sort all ends of all solids
// on a ray, and evaluate the trees between them. They share nothing with the kernels, nor with the code that compiles,
// packs and traverses a scene. They judge every ray, and all of it. Three things make that affordable. A floating-point
// filter (oracle/filtered_solid.hpp) answers for most solids; 113-bit arithmetic answers where the filter is not
// certain, and again, without the filter, for every ray that seems wrong. Bounding spheres (oracle/bounding_sphere.hpp)
// spare rays the solids that they miss for certain. A region is evaluated only if the ray meets one of its solids.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

namespace csgrt::campaign {

struct Verdict {
    bool tie = false;   ///< rounding decides something on this ray
    std::string wrong;  ///< what is wrong; empty: nothing
    double worst = 0;   ///< stress suite: the farthest end, in units of what may be
};

/// One scene, its rays and its judge. One thread at a time.
class Subject {
public:
    virtual ~Subject() = default;
    virtual const Scene& scene() const = 0;
    virtual const std::vector<std::string>& objects() const = 0;
    /// Called once, before the rest. The renderer must outlive it. `count`: about so many rays will be asked for.
    virtual void prepare(const Renderer& renderer, std::size_t count) = 0;
    /// The next rays, at most `count`; none: there are no more.
    virtual std::vector<Ray> rays(std::size_t count) = 0;
    /// Of ray `i` of those. Changes the answer.
    virtual Verdict judge(std::size_t i, RayPartitions& found) = 0;
};

/// One piece of work.
struct Item {
    std::string family;  ///< of the stress suite, "scenes" or "models"
    std::string name;    ///< "slivers 25", "truck.asc"
    std::string path;    ///< of a file; empty: the stress suite's
    std::uint64_t seed = 0;
    double share = 1;  ///< of an item's usual count of rays
    double cost = 1;   ///< how much longer a ray takes than most of the stress suite's, about

    double work() const { return share * cost + 0.02; }  ///< building it, too

    std::unique_ptr<Subject> make() const;
};

struct Choice {
    std::string scenes, models;     ///< folders; models that are not there are left out
    std::vector<std::string> only;  ///< families; empty: all
    unsigned threads = 1;
};
/// The slowest first.
std::vector<Item> items(const Choice& choice);

}  // namespace csgrt::campaign
