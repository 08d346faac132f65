// Very deep trees. The solids are boxes whose ends on the rays are known, so what is inside follows from the chain that
// the tree was made of, without walking it.
#include "build.hpp"

#include <algorithm>

namespace csgrt::stress {
namespace {

struct Slab {
    double low = 0, high = 0;  ///< of x
    std::uint32_t column = 0;  ///< of y, 4 wide
};

/// Cuts a ray along x through a column into stretches between ends of its slabs; `inside` tells by the middle.
template <class Inside>
std::vector<Stretch> stretches(const Ray& ray, const std::vector<Slab>& slabs, std::uint32_t column,
                               const Inside& inside) {
    std::vector<double> ends;
    for (const Slab& slab : slabs) {
        if (slab.column != column) continue;
        ends.push_back(slab.low);
        ends.push_back(slab.high);
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<Stretch> found;
    double last = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        if (!inside(0.5 * (ends[i] + ends[i + 1]))) continue;
        if (found.empty() || last != ends[i]) found.push_back({ends[i], 0, 0});
        found.back().out = last = ends[i + 1];
    }
    // From places to distances.
    for (Stretch& s : found) {
        s.in = (s.in - ray.origin.x) / ray.direction.x;
        s.out = (s.out - ray.origin.x) / ray.direction.x;
        if (s.out < s.in) std::swap(s.in, s.out);
    }
    if (ray.direction.x < 0) std::reverse(found.begin(), found.end());
    return found;
}

enum class Form { left, right, both, combinations };

/// value = value op leaf, from the first leaf of a chain to the last; or value = leaf op value.
struct Link {
    Operator op = Operator::union_;
    std::uint32_t slab = 0;
    bool on_the_left = false;  ///< the leaf stands on the left: leaf op value
};

bool joined(Operator op, bool a, bool b) {
    switch (op) {
        case Operator::union_:
            return a || b;
        case Operator::intersection:
            return a && b;
        case Operator::difference:
            return a && !b;
        default:
            return a != b;
    }
}

/// The chain as a tree. Leaves on the left come before all that they are joined with: written as they are met going
/// back, then the operators going forth. `name_of(slab)`; `complements`: a - b as what is in a and not in b.
template <class Name>
Tree tree_of(const std::vector<Link>& chain, const Name& name_of, bool complements) {
    Tree tree;
    const auto add_leaf = [&](const Link& link) {
        tree.nodes.push_back({Operator::leaf, 0, name_of(link.slab), identity, {}});
    };
    for (std::size_t i = chain.size() - 1; i > 0; --i)
        if (chain[i].on_the_left) add_leaf(chain[i]);
    add_leaf(chain[0]);
    for (std::size_t i = 1; i < chain.size(); ++i) {
        if (!chain[i].on_the_left) add_leaf(chain[i]);
        if (complements && chain[i].op == Operator::difference) {
            tree.nodes.push_back({Operator::not_, 1, {}, identity, {}});
            tree.nodes.push_back({Operator::intersection, 2, {}, identity, {}});
        } else {
            tree.nodes.push_back({chain[i].op, 2, {}, identity, {}});
        }
    }
    return tree;
}

}  // namespace

/// Chains of 10^2 to 10^5 nodes: to the left, to the right, to both in turn, and as combinations in combinations. The
/// leaves are few solids again and again, or each one of its own.
StressScene deep_trees(std::uint64_t seed, std::size_t times) {
    Builder to("deep_trees", seed, times);
    Random& random = to.random();
    static constexpr std::uint32_t sizes[] = {100, 300, 1000, 3000, 10000, 30000, 100000};
    const std::uint32_t leaves = sizes[seed % 7] / 2;
    const Form form = static_cast<Form>(seed / 7 % 4);
    const bool own = seed / 28 % 2 == 1;  // each leaf its own solid
    const bool complements = seed % 5 == 0;

    // Solids of their own stand in many columns, so that a ray meets no more than some dozens of them.
    const std::uint32_t columns = own ? std::max(4u, leaves / 50) : 1;
    std::vector<Slab> slabs(own ? leaves : std::min(leaves, 64u));
    std::vector<std::string> names;
    for (Slab& slab : slabs) {
        const int low = random.whole(-64, 63);
        slab.low = 0.25 * low;
        slab.high = 0.25 * random.whole(low + 1, 64);
        slab.column = random.below(columns);
        const double y = 4 * slab.column;
        names.push_back(to.solid(box({slab.low, y - 1, -1}, {slab.high, y + 1, 1})));
    }
    static constexpr Operator operators[] = {Operator::union_, Operator::difference, Operator::xor_,
                                             Operator::difference, Operator::union_};
    std::vector<Link> chain(leaves);
    for (std::uint32_t i = 0; i < leaves; ++i) {
        chain[i].slab = own ? i : random.below(static_cast<std::uint32_t>(slabs.size()));
        chain[i].op = operators[random.below(5)];
        chain[i].on_the_left = form == Form::right || (form != Form::left && random.coin());
    }
    if (form == Form::combinations) {
        // Each hundred leaves on, what is there becomes a combination of its own: at most 500 deep.
        std::string below = names[chain[0].slab];
        const auto name_of = [&](std::uint32_t slab) { return slab < names.size() ? names[slab] : below; };
        for (std::uint32_t first = 1; first < leaves; first += 100) {
            std::vector<Link> part(chain.begin() + first - 1, chain.begin() + std::min(first + 100, leaves));
            part[0].slab = static_cast<std::uint32_t>(names.size());
            below = to.combination(tree_of(part, name_of, complements));
        }
        to.region(leaf(below));
    } else {
        to.region(tree_of(
            chain, [&](std::uint32_t slab) { return names[slab]; }, complements));
    }
    const int rays = to.rays(leaves > 10000 ? 4 : 12);
    for (int i = 0; i < rays; ++i) {
        const std::uint32_t column = random.below(std::min(4u, columns));
        const double y = 4 * column + random.between(-0.9, 0.9), z = random.between(-0.9, 0.9);
        const double way = i % 2 == 0 ? 1 : -1;
        const Ray ray{{i % 3 == 2 ? 0.1 : -40 * way, y, z}, {way * (i % 4 == 3 ? 4 : 1), 0, 0}};
        to.ray(ray.origin, ray.direction);
        to.known(stretches(ray, slabs, column, [&](double x) {
            const auto holds = [&](const Link& link) {
                const Slab& slab = slabs[link.slab];
                return slab.column == column && slab.low < x && x < slab.high;
            };
            bool value = holds(chain[0]);
            for (std::uint32_t k = 1; k < leaves; ++k)
                value = chain[k].on_the_left ? joined(chain[k].op, holds(chain[k]), value)
                                             : joined(chain[k].op, value, holds(chain[k]));
            return value;
        }));
    }
    return to.take();
}

}  // namespace csgrt::stress
