// csgrt: exact ray tracing of Constructive Solid Geometry on any OpenCL device. This header includes all others.
//
//     #include <csgrt/csgrt.hpp>
//
//     int main() {
//         csgrt::Scene scene = csgrt::load_scene("scenes/operators.json");
//         csgrt::Model model(scene);
//         csgrt::Renderer renderer(model);
//         csgrt::Image image = renderer.render({.width = 512, .height = 512, .camera = scene.camera});
//         csgrt::write_image(image, "operators.exr");  // component csgrt::image
//         auto rays = renderer.shoot({{{0, -9e3, 0}, {0, 1, 0}}});
//         for (auto& p : rays[0].partitions)
//             std::printf("%s %g %g\n", model.regions()[p.region].path.c_str(), p.in, p.out);
//     }
//
// Rules that hold unless a comment says otherwise:
// - Lengths and coordinates are millimetres, angles degrees, coordinates right-handed with z up. Distances along a ray
//   are in units of the length of its direction.
// - Functions that fail throw csgrt::Error, or std::bad_alloc.
// - A function may be called by any thread, but the functions of one object by one thread at a time. Several threads
//   may read the same plain struct (Scene, Image, ...) at the same time.
// - Plain structs have a default for every member, so that designated initializers may leave out any of them. Later
//   versions may add members.
#pragma once

#include <csgrt/camera.hpp>
#include <csgrt/check.hpp>
#include <csgrt/device.hpp>
#include <csgrt/edit.hpp>
#include <csgrt/error.hpp>
#include <csgrt/framebuffer.hpp>
#include <csgrt/image.hpp>
#include <csgrt/measure.hpp>
#include <csgrt/method.hpp>
#include <csgrt/model.hpp>
#include <csgrt/partitions.hpp>
#include <csgrt/rays.hpp>
#include <csgrt/renderer.hpp>
#include <csgrt/scene.hpp>
#include <csgrt/scene_io.hpp>
#include <csgrt/settings.hpp>
#include <csgrt/solids.hpp>
#include <csgrt/statistics.hpp>
#include <csgrt/vector.hpp>
#include <csgrt/verify.hpp>
#include <csgrt/version.hpp>
#include <csgrt/view.hpp>
