#include "functions.hpp"

extern "C" const csgrt::ImageFunctions csgrt_image_functions = {csgrt::write_image, csgrt::read_image};
