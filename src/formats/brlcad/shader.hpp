// Shader strings of BRL-CAD.
#pragma once

#include <string>
#include <string_view>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The finish that a shader and its parameters describe, in either of BRL-CAD's notations: "sh=5 di=.9" as in v4
/// databases, or "sh 5 di .9" (a Tcl list, braces allowed) as in v5. Plastic, phong, mirror, glass and light have
/// BRL-CAD's defaults. Every other shader keeps its name and has the finish of plastic; a stack that of the last of
/// these four in it. Parameters that a finish does not have, or that are not numbers, are ignored, as in BRL-CAD:
/// appearance is no reason to refuse a model.
Finish read_finish(std::string_view shader, std::string_view parameters);

/// The finish of one string that starts with the shader's name: "plastic", "plastic {sh 5 di .9}", "glass tr=.7".
Finish read_finish(std::string_view shader_and_parameters);

/// A warning if the shader's name shows that BRL-CAD draws it differently; else empty.
std::string shader_warning(std::string_view shader);

/// Adds to the scene's warnings one for each shader that is drawn as plastic, with the number of combinations that have
/// it, and one for the lights that should cast shadows.
void warn_of_shaders(Scene& scene);

}  // namespace csgrt
