// Solids of a closed form.
#include "compile/tight_box.hpp"

namespace csgrt {

Box Tight::operator()(const Part&) const { return {}; }

Box Tight::operator()(const Epa&) const { return {}; }

Box Tight::operator()(const Rpc&) const { return {}; }

Box Tight::operator()(const Rhc&) const { return {}; }

Box Tight::operator()(const Eto&) const { return {}; }

Box Tight::operator()(const Hyp&) const { return {}; }

Box Tight::operator()(const Superell&) const { return {}; }

Box Tight::operator()(const Hrt&) const { return {}; }

Box Tight::operator()(const Metaball&) const { return {}; }

}  // namespace csgrt
