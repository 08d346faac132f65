// Solids that triangles make.
#include "compile/tight_box.hpp"

namespace csgrt {

Box Tight::operator()(const Bot& s) const {
    Box box = empty_box;
    for (const auto& face : s.faces)
        for (const std::uint32_t corner : face) extend(box, narrow(transform_point(m, wide(s.vertices[corner]))));
    return box;
}

Box Tight::operator()(const Ars&) const { return {}; }

Box Tight::operator()(const Nmg&) const { return {}; }

Box Tight::operator()(const Vol&) const { return {}; }

Box Tight::operator()(const Dsp&) const { return {}; }

}  // namespace csgrt
