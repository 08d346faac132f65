// What is wrong with solids of a closed form.
#pragma once

#include <csgrt/scene.hpp>

#include "scene/fault_rules.hpp"

namespace csgrt {

Faults curved_faults(const Part& s);
Faults curved_faults(const Epa& s);
Faults curved_faults(const Rpc& s);
Faults curved_faults(const Rhc& s);
Faults curved_faults(const Eto& s);
Faults curved_faults(const Hyp& s);
Faults curved_faults(const Superell& s);
Faults curved_faults(const Hrt& s);
Faults curved_faults(const Metaball& s);

}  // namespace csgrt
