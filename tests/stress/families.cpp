#include "families.hpp"

#include <array>

#include "build.hpp"

namespace csgrt::stress {
namespace {

struct Family {
    const char* name;
    StressScene (*make)(std::uint64_t seed, std::size_t times);
};
constexpr std::array<Family, 13> all{{
    {"coplanar", coplanar},
    {"coincident", coincident},
    {"tangent", tangent},
    {"edges", edges},
    {"far_origin", far_origin},
    {"scale", scale},
    {"slivers", slivers},
    {"degenerate", degenerate},
    {"deep_trees", deep_trees},
    {"depth", depth},
    {"overlaps", overlaps},
    {"nested", nested},
    {"pinch", pinch},
}};

}  // namespace

std::vector<std::string> families() {
    std::vector<std::string> names;
    for (const Family& family : all) names.emplace_back(family.name);
    return names;
}

StressScene make(const std::string& family, std::uint64_t seed, std::size_t times) {
    for (const Family& known : all)
        if (family == known.name) return known.make(seed, times);
    throw Error(Status::usage, "there is no stress family '" + family + "'");
}

}  // namespace csgrt::stress
