#include <csgrt/csgrt.hpp>

#include <cstdio>

int main() {
    csgrt::Scene scene;
    scene.objects.push_back(csgrt::Solid{"ball", csgrt::Ell{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}});
    csgrt::Renderer renderer(scene);
    const auto rays = renderer.shoot({{{0, -9, 0}, {0, 1, 0}}});
#ifdef CONSUMER_HAS_IMAGE
    csgrt::write_image(renderer.render({.width = 8, .height = 8}), "ball.exr");
    std::printf("%d pixels wide\n", csgrt::read_image("ball.exr").width);
#endif
    for (const auto& p : rays[0].partitions) std::printf("in %g out %g\n", p.in, p.out);
    return rays[0].partitions.size() == 1 && rays[0].partitions[0].in == 8 && rays[0].partitions[0].out == 10 ? 0 : 1;
}
