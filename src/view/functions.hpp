// What csgrt::view gives to the command, which loads it when it is needed: the library for HTTP takes 4 ms to load.
#pragma once

#include <functional>
#include <string>

#include <csgrt/viewer.hpp>

namespace csgrt {

struct ViewFunctions {
    /// Viewer's constructor, then `listening` with its address, then run().
    void (*serve)(const Model& model, const Settings& settings, const ViewerOptions& options,
                  const std::function<void(const std::string&)>& listening, const std::function<bool()>& go_on);
};

inline constexpr const char* view_functions_name = "csgrt_view_functions";

}  // namespace csgrt

extern "C" CSGRT_API const csgrt::ViewFunctions csgrt_view_functions;
