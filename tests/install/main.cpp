#include <csgrt/csgrt.hpp>
#include <csgrt/viewer.hpp>

#include <cstdio>
#include <string_view>

// The version of the headers, of the package and of the library are one.
static_assert(CSGRT_VERSION == CSGRT_VERSION_MAJOR * 10000 + CSGRT_VERSION_MINOR * 100 + CSGRT_VERSION_PATCH);
#ifdef PACKAGE_VERSION
static_assert(std::string_view(CSGRT_VERSION_STRING) == PACKAGE_VERSION);
#endif
#if CSGRT_VERSION < 100
#error "CSGRT_VERSION is no number that the preprocessor can compare"
#endif

bool initializers_keep_defaults();

int main() {
    if (std::string_view(csgrt::version()) != CSGRT_VERSION_STRING) {
        std::printf("the library is version %s, its headers are version %s\n", csgrt::version(), CSGRT_VERSION_STRING);
        return 1;
    }
    if (!initializers_keep_defaults()) return 1;
    csgrt::Scene scene;
    scene.objects.push_back(csgrt::Solid{"ball", csgrt::Ell{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}});
    csgrt::Renderer renderer(scene);
    const auto rays = renderer.shoot({{{0, -9, 0}, {0, 1, 0}}});
#ifdef CONSUMER_HAS_IMAGE
    csgrt::write_image(renderer.render({.width = 8, .height = 8}), "ball.exr");
    std::printf("%d pixels wide\n", csgrt::read_image("ball.exr").width);
#endif
#ifdef CONSUMER_HAS_VIEW
    csgrt::Viewer viewer(renderer.model(), {}, {.name = "ball"});
    viewer.run([] { return false; });
    std::printf("a page was at %s\n", viewer.address().c_str());
#endif
    for (const auto& p : rays[0].partitions) std::printf("in %g out %g\n", p.in, p.out);
    return rays[0].partitions.size() == 1 && rays[0].partitions[0].in == 8 && rays[0].partitions[0].out == 10 ? 0 : 1;
}
