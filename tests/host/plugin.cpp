// A library of a host's that keeps a Renderer on PoCL, and is unloaded.
#include <csgrt/csgrt.hpp>

/// 0; 4: there is no such device.
extern "C" int draw(const char* scene) try {
    csgrt::Settings settings{.device = "pocl"};
    static csgrt::Renderer kept(csgrt::load_scene(scene), {}, settings);
    csgrt::View view{.width = 24, .height = 24, .every_partition = false};
    kept.render(view);
    return 0;
} catch (const csgrt::Error& error) {
    return static_cast<int>(error.status());
}
