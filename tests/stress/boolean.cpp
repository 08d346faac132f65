// What trees and overlaps make hard, geometry apart.
#include "build.hpp"

namespace csgrt::stress {

/// Two to nine regions in one place; some are one another's copies, some share solids.
StressScene overlaps(std::uint64_t seed, std::size_t times) {
    Builder to("overlaps", seed, times);
    Random& random = to.random();
    std::vector<std::string> solids;
    const int count = random.whole(3, 6), regions = random.whole(2, 9);
    for (int i = 0; i < count; ++i) solids.push_back(some_solid(to));
    Tree before;
    for (int i = 0; i < regions; ++i) {
        std::vector<std::string> own;
        for (const std::string& solid : solids)
            if (random.below(3) > 0) own.push_back(solid);
        if (own.empty()) own.push_back(solids.front());
        Tree tree = some_tree(own, random);
        if (i > 0 && random.below(4) == 0) tree = before;
        before = tree;
        to.region(std::move(tree));
    }
    some_rays(to, 12, to.rays(60));
    return to.take();
}

/// Six to fourteen solids under differences of differences, xor and complements.
StressScene nested(std::uint64_t seed, std::size_t times) {
    Builder to("nested", seed, times);
    Random& random = to.random();
    const int count = random.whole(6, 14);
    Tree tree = leaf(some_solid(to));
    const std::string ground = to.solid(ball({0, 0, 0}, 11));
    for (int i = 1; i < count; ++i) {
        const Tree next = leaf(some_solid(to));
        switch (random.below(6)) {
            case 0:
                tree = operate(Operator::difference, {next, tree});
                break;
            case 1:
                tree = operate(Operator::difference, {leaf(ground), tree});
                break;
            case 2:
                tree = operate(Operator::xor_, {tree, next});
                break;
            case 3:
                tree = operate(Operator::intersection, {leaf(ground), operate(Operator::not_, {tree})});
                break;
            case 4:
                tree = operate(Operator::union_, {next, tree});
                break;
            default:
                tree = operate(Operator::xor_, {next, operate(Operator::difference, {leaf(ground), next}), tree});
                break;
        }
        // What stands below becomes a combination of its own, now and then.
        if (random.below(4) == 0) tree = leaf(to.combination(std::move(tree)));
    }
    to.region(std::move(tree));
    some_rays(to, 12, to.rays(60));
    return to.take();
}

}  // namespace csgrt::stress
