#include "scene/faults/unsupported.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace csgrt {

namespace {

struct Known {
    std::string_view type, sentence;
};
constexpr Known known[] = {
    {"brep",
     "a brep is bounded by NURB surfaces, which csgrt does not draw; make a mesh (bot) of it with BRL-CAD's "
     "`facetize`"},
    {"bspline",
     "a bspline is bounded by NURB surfaces, which csgrt does not draw; make a mesh (bot) of it with "
     "BRL-CAD's `facetize`"},
    {"poly", "a polysolid is an older form of a mesh; BRL-CAD's `dbupgrade` writes it as a bot, which csgrt draws"},
    {"hf", "an hf is an older form of a height field; BRL-CAD's `dbupgrade` writes it as a dsp, which csgrt draws"},
    {"submodel",
     "a submodel names objects of another database; put them into this one with BRL-CAD's `dbconcat` and "
     "use them in its place"},
};

}  // namespace

std::string why_left_out(const Unsupported& shape) {
    if (!shape.reason.empty()) return shape.reason;
    const auto* found =
        std::find_if(std::begin(known), std::end(known), [&](const Known& k) { return k.type == shape.type; });
    if (found != std::end(known)) return std::string(found->sentence);
    return "csgrt does not know solids of type '" + shape.type + "'; make a mesh (bot) of it with BRL-CAD's `facetize`";
}

}  // namespace csgrt
