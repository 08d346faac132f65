// Shaders: reads BRL-CAD's shader strings.
#pragma once

#include <string>
#include <string_view>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The finish that a shader and its parameters describe, in one of BRL-CAD's two notations: "sh=5 di=.9" as in v4
/// databases, or "sh 5 di .9" (a Tcl list, braces allowed) as in v5. Plastic, phong, mirror, glass and light have
/// BRL-CAD's defaults. Every other shader keeps its name and has the finish of plastic. A stack has the finish of its
/// last shader of these. Unknown parameters, and parameters that are not numbers, are ignored, as in BRL-CAD.
Finish read_finish(std::string_view shader, std::string_view parameters);

/// The finish of one string that starts with the shader's name: "plastic", "plastic {sh 5 di .9}", "glass tr=.7".
Finish read_finish(std::string_view shader_and_parameters);

/// A warning if BRL-CAD draws this shader differently; else empty.
std::string shader_warning(std::string_view shader);

/// Adds a warning for each shader that is drawn as plastic, with the number of its combinations, and a warning for
/// lights that should cast shadows.
void warn_of_shaders(Scene& scene);

}  // namespace csgrt
