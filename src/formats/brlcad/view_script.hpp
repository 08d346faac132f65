// View scripts: shell scripts that MGED's saveview writes, and that give commands to rt:
//
//     #!/bin/sh
//     rt -M -p40 ... <<EOF
//     viewsize 2.78e+02;
//     orientation 2.5e-01 4.3e-01 7.5e-01 4.3e-01;
//     eye_pt 3.8e+02 2.5e+02 1.8e+02;
//     start 0; clean;
//     end;
//     EOF
//
// or these commands alone. A database holds no views: its objects are solids and combinations.
#pragma once

#include <csgrt/scene.hpp>

#include "formats/text_source.hpp"

namespace csgrt {

/// Reads the view of the first frame. Throws Error (scene) for a text that is not such a script.
Camera parse_view_script(const TextSource& source);

}  // namespace csgrt
