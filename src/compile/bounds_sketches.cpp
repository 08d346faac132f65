// Solids that outlines make.
#include "compile/tight_box.hpp"

namespace csgrt {

Box Tight::operator()(const Ebm&) const { return {}; }

Box Tight::operator()(const Extrude&) const { return {}; }

Box Tight::operator()(const Revolve&) const { return {}; }

}  // namespace csgrt
