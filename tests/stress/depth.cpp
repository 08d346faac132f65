// Depth complexity: 10 to 10^4 segments on a ray, 10^5 in the legs. Where they end is known from how the scene is made.
#include "build.hpp"

#include <algorithm>

namespace csgrt::stress {
namespace {

/// Seeds from here on make nested legs: too deep for the reference, which takes the square of their number.
constexpr std::uint64_t first_legs = 84;

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

/// Where |o + t d| = r: the middle of all chords, and how far from it.
long double middle_of(const Ray& ray) {
    const long double ox = ray.origin.x, oy = ray.origin.y, dx = ray.direction.x, dy = ray.direction.y;
    return -(ox * dx + oy * dy) / (dx * dx + dy * dy);
}
long double half_chord(const Ray& ray, long double r) {
    const long double dx = ray.direction.x, dy = ray.direction.y, t_0 = middle_of(ray), x = ray.origin.x + t_0 * dx,
                      y = ray.origin.y + t_0 * dy, z = ray.origin.z;
    return std::sqrt((r * r - (x * x + y * y + z * z)) / (dx * dx + dy * dy));
}

/// One region of nested balls or of coincident ones, or 10^5 sheets, which a ray meets all of.
StressScene legs(std::uint64_t seed, std::size_t times) {
    Builder to("depth", seed, times);
    static constexpr std::uint32_t sizes[] = {50, 400, 1250, 10'000};
    const std::uint64_t number = seed - first_legs, kind = number % 5;
    const std::uint32_t size = kind == 4 ? 100'000 : sizes[number / 5 % 4];
    const int rays = to.rays(3);
    if (kind == 4) {
        to.region(all_of(Operator::xor_, sheets(to, 0, size)));
        rays_along(to, 0.5 * size, 0.5 * size, rays, [&](const Ray& ray) {
            std::vector<Stretch> known;
            for (std::uint32_t k = 0; k < size; ++k) known.push_back(between(ray, k, k + 0.5, 0));
            return known;
        });
        return to.take();
    }
    const bool is_copied = kind == 3;
    const auto radius = [&](std::uint32_t k) { return is_copied ? 16.0 : 16.0 + 0.25 * k; };
    std::vector<std::string> names;
    for (std::uint32_t k = 0; k < size; ++k) names.push_back(to.solid(ball({0, 0, 0}, radius(k))));
    std::reverse(names.begin(), names.end());  // the largest first
    const Operator op = kind == 1 ? Operator::union_ : kind == 2 ? Operator::difference : Operator::xor_;
    if (is_copied)
        names.push_back(to.solid(ball({0, 0, 0}, 32)));  // sizes are even: what is left of the copies is nothing
    to.region(all_of(op, names));
    rays_along(to, 0, radius(size), rays, [&](const Ray& ray) {
        const auto chord = [&](double r) { return half_chord(ray, r); };
        const long double t_0 = middle_of(ray);
        std::vector<Stretch> known;
        const auto add = [&](long double a, long double b) {
            known.push_back({static_cast<double>(t_0 + a), static_cast<double>(t_0 + b), 0});
        };
        if (is_copied) {
            add(-chord(32), chord(32));
        } else if (kind == 1) {
            add(-chord(radius(size - 1)), chord(radius(size - 1)));
        } else {  // of a difference only the outermost shell; of a xor every second one
            for (std::uint32_t k = size - 1; k > 0; k -= 2) {
                add(-chord(radius(k)), -chord(radius(k - 1)));
                add(chord(radius(k - 1)), chord(radius(k)));
                if (kind == 2 || k == 1) break;
            }
        }
        std::sort(known.begin(), known.end(),
                  [&](const Stretch& a, const Stretch& b) { return ray.direction.x > 0 ? a.in < b.in : a.in > b.in; });
        return known;
    });
    return to.take();
}

}  // namespace

StressScene depth(std::uint64_t seed, std::size_t times) {
    if (seed >= first_legs) return legs(seed, times);
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
                const long double t_0 = middle_of(ray);
                const auto half = [&](std::uint32_t k) { return half_chord(ray, 16.0L + k); };
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
