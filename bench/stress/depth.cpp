// Depth complexity: 10 to 10^4 segments on a ray. Where they end is known from how the scene is made.
#include "build.hpp"

#include <algorithm>

namespace csgrt::stress {
namespace {

/// The solids joined by one operator.
Tree all_of(Operator op, const std::vector<std::string>& solids) {
    Tree tree;
    for (const std::string& solid : solids) tree.nodes.push_back({Operator::leaf, 0, solid, identity, {}});
    if (solids.size() > 1) tree.nodes.push_back({op, static_cast<std::uint32_t>(solids.size()), {}, identity, {}});
    return tree;
}

/// Sheets across x at low + k, half as thick as they are apart.
std::vector<std::string> sheets(Builder& to, double low, std::uint32_t count) {
    std::vector<std::string> names;
    for (std::uint32_t k = 0; k < count; ++k)
        names.push_back(to.solid(box({low + k, -16, -16}, {low + k + 0.5, 16, 16})));
    return names;
}

/// Rays through everything, along x or nearly so. Calls with each ray and its way in x.
template <class Known>
void rays_along(Builder& to, double middle, double half, int count, const Known& known) {
    Random& random = to.random();
    for (int i = 0; i < count; ++i) {
        const double way = i % 2 == 0 ? 1 : -1;
        const double y = random.between(-8, 8), z = random.between(-8, 8);
        // Slanted ones stay within the sheets.
        const double slant = i % 3 == 2 ? 4 / (half + 16) : 0;
        const Ray ray{{middle - way * (half + 4), y, z}, {way, slant, 0}};
        to.ray(ray.origin, ray.direction);
        std::vector<Stretch> stretches = known(ray);
        if (way < 0) std::reverse(stretches.begin(), stretches.end());
        to.known(std::move(stretches));
    }
}

/// Between two places of x, in either order.
Stretch between(const Ray& ray, double a, double b, std::uint32_t region) {
    const double s = (a - ray.origin.x) / ray.direction.x, t = (b - ray.origin.x) / ray.direction.x;
    return {std::min(s, t), std::max(s, t), region};
}

}  // namespace

StressScene depth(std::uint64_t seed, std::size_t times) {
    Builder to("depth", seed, times);
    static constexpr std::uint32_t sizes[] = {10, 100, 1000, 3000, 10000};
    const std::uint32_t kind = static_cast<std::uint32_t>(seed % 6), size = sizes[seed / 6 % 5];
    const int rays = to.rays(size >= 1000 ? 3 : 12);
    switch (kind) {
        case 0:    // sheets, all one region
        case 1: {  // each its own
            const std::vector<std::string> names = sheets(to, 0, size);
            if (kind == 0) to.region(all_of(Operator::union_, names));
            for (const std::string& name : names)
                if (kind == 1) to.region(leaf(name));
            rays_along(to, 0.5 * size, 0.5 * size, rays, [&](const Ray& ray) {
                std::vector<Stretch> known;
                for (std::uint32_t k = 0; k < size; ++k) known.push_back(between(ray, k, k + 0.5, kind == 0 ? 0 : k));
                return known;
            });
            break;
        }
        case 2:    // an onion: what is in an odd number of balls
        case 3: {  // each of its layers its own region. All balls are open at once: fewer, for that costs the square
            const std::uint32_t balls = std::min(size, kind == 2 ? 2000u : 1000u) / 2 * 2;
            std::vector<std::string> names;
            for (std::uint32_t k = 0; k < balls; ++k) names.push_back(to.solid(ball({0, 0, 0}, 16.0 + k)));
            if (kind == 2) to.region(all_of(Operator::xor_, names));
            for (std::uint32_t k = 1; k < balls; k += 2)
                if (kind == 3) to.region(operate(Operator::difference, {leaf(names[k]), leaf(names[k - 1])}));
            rays_along(to, 0, 16 + balls, rays, [&](const Ray& ray) {
                // Where |o + t d| = r, from the middle t_0 of all chords.
                const long double ox = ray.origin.x, oy = ray.origin.y, oz = ray.origin.z, dx = ray.direction.x,
                                  dy = ray.direction.y, dd = dx * dx + dy * dy, t_0 = -(ox * dx + oy * dy) / dd;
                const long double x = ox + t_0 * dx, y = oy + t_0 * dy, off = x * x + y * y + oz * oz;
                const auto half = [&](std::uint32_t k) { return std::sqrt(((16.0L + k) * (16.0L + k) - off) / dd); };
                std::vector<Stretch> known;
                for (std::uint32_t k = 1; k < balls; k += 2) {
                    const std::uint32_t region = kind == 2 ? 0 : (k - 1) / 2;
                    known.push_back(
                        {static_cast<double>(t_0 + half(k - 1)), static_cast<double>(t_0 + half(k)), region});
                    known.push_back(
                        {static_cast<double>(t_0 - half(k)), static_cast<double>(t_0 - half(k - 1)), region});
                }
                std::sort(known.begin(), known.end(), [&](const Stretch& a, const Stretch& b) {
                    return ray.direction.x > 0 ? a.in < b.in : a.in > b.in;
                });
                return known;
            });
            break;
        }
        case 4: {  // a comb: one solid with that many segments
            Ebm comb;
            comb.width = 2 * size;
            comb.depth = 1;
            comb.height = 32;
            comb.matrix = {1, 0, 0, 0, 0, 32, 0, -16, 0, 0, 1, -16, 0, 0, 0, 1};
            for (std::uint32_t k = 0; k < size; ++k) {
                comb.cells.push_back(1);
                comb.cells.push_back(0);
            }
            to.region(leaf(to.solid(comb)));
            rays_along(to, size, size, rays, [&](const Ray& ray) {
                std::vector<Stretch> known;
                for (std::uint32_t k = 0; k < size; ++k) known.push_back(between(ray, 2.0 * k, 2.0 * k + 1, 0));
                return known;
            });
            break;
        }
        default: {  // two regions of sheets that overlap by half their thickness: the first keeps it
            const std::uint32_t half = size / 2;
            const std::vector<std::string> first = sheets(to, 0, half), second = sheets(to, 0.25, half);
            to.region(all_of(Operator::union_, first));
            to.region(all_of(Operator::union_, second));
            rays_along(to, 0.5 * half, 0.5 * half, rays, [&](const Ray& ray) {
                std::vector<Stretch> known;
                for (std::uint32_t k = 0; k < half; ++k) {
                    known.push_back(between(ray, k, k + 0.5, 0));
                    known.push_back(between(ray, k + 0.5, k + 0.75, 1));
                }
                return known;
            });
            break;
        }
    }
    return to.take();
}

}  // namespace csgrt::stress
