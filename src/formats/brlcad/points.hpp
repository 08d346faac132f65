// Points (BRL-CAD's pnts). Each may have a colour, a scale and a normal. A point with a scale is a ball.
#pragma once

#include <cstddef>

#include "formats/brlcad/objects.hpp"

namespace csgrt {

class ByteReader;
class Parameters;

/// Reads the keys count, type, scale, and data, which is a list of lists of numbers. Throws Fault.
BrlcadPoints read_v5_points(Parameters& p);

/// Reads scale: a double  type: 2 bytes  count: 4 bytes  doubles of each point: x y z, colour?, scale?, normal?. Throws
/// Fault.
BrlcadPoints read_g_points(ByteReader& bytes);

}  // namespace csgrt
