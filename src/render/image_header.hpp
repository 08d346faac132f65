// Image header: a picture's attributes beside its channels.
#pragma once

#include <string>
#include <vector>

#include <csgrt/renderer.hpp>

#include "compile/frame.hpp"

namespace csgrt {

/// Writes the camera in the form that graphics programs expect: matrices worldToCamera and cameraToScreen, row-major.
void describe_camera(const PreparedFrame& frame, Image& image);

/// Warnings, a line each, as many as fit a header.
std::string warnings_attribute(const std::vector<Warning>& warnings);

}  // namespace csgrt
