// The evaluation of the thesis (thesis.cpp), and what can be switched in it.
#pragma once

#include <cstddef>

namespace csgrt::bench {

/// The value of the method's knob is a place in this list. `kernel`: of kernels/thesis.cl.
struct ThesisSwitch {
    const char *name, *kernel;
    std::size_t group = 64;  ///< work-items
};
inline constexpr ThesisSwitch thesis_switches[] = {
    {"as in the thesis", "thesis"},
    {"no list of a primitive's regions", "thesis_searches_regions"},
    {"segments: bits one by one, no clz", "thesis_without_clz"},
    {"segments: bits, written once more", "thesis_makes_bits"},
    {"segments: lists", "thesis_makes_lists"},
    {"regions: a list", "thesis_lists_regions"},
    {"postfix, without early out", "thesis_postfix"},
    {"unions are walked", "thesis_walks_unions"},
    {"work-groups of 32", "thesis", 32},
    {"work-groups of 128", "thesis", 128},
    {"work-groups of 256", "thesis", 256},
};

}  // namespace csgrt::bench
