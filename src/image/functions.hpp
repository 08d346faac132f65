// Functions of image.hpp, for programs that load csgrt::image only when they need it.
#pragma once

#include <string>

#include <csgrt/image.hpp>

namespace csgrt {

/// The addresses of the functions of image.hpp.
struct ImageFunctions {
    void (*write)(const Image& image, const std::string& path, const std::string& format,
                  const std::function<bool(double)>& progress);
    Image (*read)(const std::string& path);
};

inline constexpr const char* image_functions_name = "csgrt_image_functions";

}  // namespace csgrt

extern "C" CSGRT_API const csgrt::ImageFunctions csgrt_image_functions;
