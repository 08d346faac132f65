// BRL-CAD's shader strings.
#pragma once

#include <string>
#include <string_view>

#include <csgrt/scene.hpp>

namespace csgrt {

/// The finish that a shader and its parameters describe, in either of BRL-CAD's notations: "sh=5 di=.9" as in v4
/// databases, or "sh 5 di .9" (a Tcl list, braces allowed) as in v5. Plastic, phong, mirror and glass have BRL-CAD's
/// defaults, and so has a light; every other shader keeps its name and looks like plastic, a stack like the last of
/// those four in it. Parameters that a finish does not have, or that are no numbers, are passed over, as BRL-CAD does:
/// appearance is no reason to refuse a model.
Finish read_finish(std::string_view shader, std::string_view parameters);

/// The same for one string that starts with the shader's name: "plastic", "plastic {sh 5 di .9}", "glass tr=.7".
Finish read_finish(std::string_view shader_and_parameters);

/// What is not as BRL-CAD draws it, where a shader's name tells; empty: nothing.
std::string shader_warning(std::string_view shader);

/// Adds to the scene's warnings one for each shader that is drawn as plastic, with how many combinations have it, and
/// one for the lights that should cast shadows.
void warn_of_shaders(Scene& scene);

}  // namespace csgrt
