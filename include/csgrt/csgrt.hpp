// csgrt: exact ray tracing of Constructive Solid Geometry on any OpenCL device.
//
//     #include <csgrt/csgrt.hpp>
//
//     int main() {
//         csgrt::Scene scene = csgrt::load_scene("scenes/operators.json");
//         csgrt::Renderer renderer(scene);
//         csgrt::Image image = renderer.render({.width = 512, .height = 512, .camera = scene.camera});
//         csgrt::write_image(image, "operators.exr");  // component csgrt::image
//         auto rays = renderer.shoot({{{0, -9e3, 0}, {0, 1, 0}}});
//         for (auto& p : rays[0].partitions) std::printf("%s %g %g\n", renderer.regions()[p.region].path.c_str(), p.in, p.out);
//     }
#pragma once

#include <csgrt/error.hpp>
#include <csgrt/image.hpp>
#include <csgrt/renderer.hpp>
#include <csgrt/scene.hpp>
#include <csgrt/scene_io.hpp>
#include <csgrt/verify.hpp>
