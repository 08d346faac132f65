// Solids that triangles make.
#include "compile/tight_box.hpp"

namespace csgrt {

Box Tight::operator()(const Bot&) const { return {}; }

Box Tight::operator()(const Ars&) const { return {}; }

Box Tight::operator()(const Nmg&) const { return {}; }

Box Tight::operator()(const Vol&) const { return {}; }

Box Tight::operator()(const Dsp&) const { return {}; }

}  // namespace csgrt
