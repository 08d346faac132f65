// Edges in pictures, beside the silhouettes and the faces of bodies whose distance functions are known.
#include <csgrt/renderer.hpp>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "catch.hpp"
#include "integration/deep_scenes.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "scene/vector.hpp"

using namespace csgrt;

namespace {

/// A body as the common part of its faces. Each face is a function that is negative within, and never larger than the
/// distance to the face.
struct Body {
    const char* name;
    Shape shape;
    std::vector<std::function<double(Vec3)>> faces;
};

auto plane(const Vec3& normal, double distance) {
    return [n = unit(normal), distance](Vec3 p) { return dot(n, p) - distance; };
}
auto ball(double radius) {
    return [radius](Vec3 p) { return length(p) - radius; };
}
auto tube(double radius) {
    return [radius](Vec3 p) { return std::hypot(p.x, p.y) - radius; };
}

std::vector<std::function<double(Vec3)>> box_faces(double x, double y, double z) {
    return {plane({1, 0, 0}, x),  plane({-1, 0, 0}, x), plane({0, 1, 0}, y),
            plane({0, -1, 0}, y), plane({0, 0, 1}, z),  plane({0, 0, -1}, z)};
}
Arb box(double x, double y, double z) {
    return {{{{-x, -y, -z}, {x, -y, -z}, {x, y, -z}, {-x, y, -z}, {-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}}}};
}
std::vector<Plane> octahedron_planes(double distance) {
    std::vector<Plane> planes;
    for (int i = 0; i < 8; ++i)
        planes.push_back({unit({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0}), distance});
    return planes;
}

std::vector<Body> bodies() {
    std::vector<Body> all;
    all.push_back({"ball", Ell{{}, {40, 0, 0}, {0, 40, 0}, {0, 0, 40}}, {ball(40)}});
    all.push_back({"ellipsoid", Ell{{}, {60, 0, 0}, {0, 30, 0}, {0, 0, 40}}, {[](Vec3 p) {
                       return 30 * (std::hypot(p.x / 60, p.y / 30, p.z / 40) - 1);
                   }}});
    all.push_back({"cube", box(40, 40, 40), box_faces(40, 40, 40)});
    all.push_back({"plank", box(60, 20, 8), box_faces(60, 20, 8)});
    all.push_back({"cylinder",
                   Tgc{{0, 0, -40}, {0, 0, 80}, {25, 0, 0}, {0, 25, 0}, {25, 0, 0}, {0, 25, 0}},
                   {tube(25), plane({0, 0, 1}, 40), plane({0, 0, -1}, 40)}});
    all.push_back({"cone",
                   Tgc{{0, 0, -30}, {0, 0, 60}, {40, 0, 0}, {0, 40, 0}, {10, 0, 0}, {0, 10, 0}},
                   {[](Vec3 p) { return (std::hypot(p.x, p.y) - 25 + p.z / 2) * 2 / std::sqrt(5); },
                    plane({0, 0, 1}, 30), plane({0, 0, -1}, 30)}});
    all.push_back({"torus", Tor{{}, {0, 0, 1}, 40, 12}, {[](Vec3 p) {
                       return std::hypot(std::hypot(p.x, p.y) - 40, p.z) - 12;
                   }}});
    all.push_back({"capsule", Part{{0, 0, -30}, {0, 0, 60}, 20, 20}, {[](Vec3 p) {
                       return length(p - Vec3{0, 0, std::clamp(p.z, -30.0, 30.0)}) - 20;
                   }}});
    Body octahedron{"octahedron", Arbn{octahedron_planes(40 / std::sqrt(3))}, {}};
    for (const Plane& face : std::get<Arbn>(octahedron.shape).planes)
        octahedron.faces.push_back(plane(face.normal, face.distance));
    all.push_back(octahedron);
    const Vec3 corners[] = {{40, 40, 40}, {40, -40, -40}, {-40, 40, -40}, {-40, -40, 40}};
    Body tetrahedron{
        "tetrahedron",
        Arb{{corners[0], corners[1], corners[2], corners[0], corners[3], corners[3], corners[3], corners[3]}},
        {}};
    for (const Vec3& corner : corners) tetrahedron.faces.push_back(plane(-1 * corner, 40 / std::sqrt(3)));
    all.push_back(tetrahedron);
    return all;
}

/// The face that a ray meets first; -1: it misses the body.
int face_of(const Body& body, const Ray& ray) {
    double t = 0;
    for (int step = 0; step < 10'000 && t < 2000; ++step) {
        const Vec3 at = ray.origin + t * ray.direction;
        int outermost = 0;
        double distance = -1e300;
        for (std::size_t i = 0; i < body.faces.size(); ++i)
            if (const double d = body.faces[i](at); d > distance) outermost = static_cast<int>(i), distance = d;
        if (distance < 1e-7) return outermost;
        t += distance;
    }
    return -1;
}

Scene scene_of(const Body& body) {
    Scene scene;
    scene.objects.push_back(Solid{"body", body.shape, {}});
    scene.top = {"body"};
    return scene;
}

bool is_black(const Image& image, std::size_t i) {
    return image.channel("R")[i] == 0 && image.channel("G")[i] == 0 && image.channel("B")[i] == 0;
}

/// The share of the pixels of `a` with a pixel of `b` beside them or at their place.
double share_beside(const std::vector<bool>& a, const std::vector<bool>& b, int width) {
    int all = 0, found = 0;
    for (int i = 0; i < static_cast<int>(a.size()); ++i) {
        if (!a[static_cast<std::size_t>(i)]) continue;
        ++all;
        bool is_found = false;
        for (int k : {0, 1, -1, width, -width, width + 1, width - 1, -width + 1, -width - 1})
            if (i + k >= 0 && i + k < static_cast<int>(b.size())) is_found |= b[static_cast<std::size_t>(i + k)];
        found += is_found;
    }
    return all ? static_cast<double>(found) / all : 0;
}

View view_with_edges() {
    View view{.width = 200, .height = 160, .every_partition = false};
    view.camera.azimuth = 32;
    view.camera.elevation = 55;
    view.camera.view_size = 160;
    view.channels = channel::color;
    view.edges = true;
    return view;
}

}  // namespace

TEST_CASE("edges are where ten bodies end, and where their faces meet") {
    for (const Body& body : bodies())
        for (const double perspective : {0.0, 30.0}) {
            Renderer renderer(scene_of(body), {}, test::on_native_device());
            View view = view_with_edges();
            view.camera.perspective = perspective;
            const Image image = renderer.render(view);
            const RayGrid rays = renderer.model().grid_of(view);
            std::vector<int> faces;
            for (int y = 0; y < view.height; ++y)
                for (int x = 0; x < view.width; ++x) faces.push_back(face_of(body, rays.ray(x, y)));
            std::vector<bool> expected(faces.size()), found(faces.size());
            for (std::size_t i = 0; i < faces.size(); ++i) {
                const std::size_t width = static_cast<std::size_t>(view.width);
                for (const std::size_t k : {i + 1, i + width})
                    if (k < faces.size() && faces[i] != faces[k]) expected[faces[i] < 0 ? k : i] = true;
                found[i] = is_black(image, i) && image.channel("A")[i] == 1 && faces[i] >= 0;
                if (faces[i] < 0) REQUIRE(is_black(image, i));  // the background
            }
            INFO(body.name << ", perspective " << perspective << ", " << std::count(found.begin(), found.end(), true)
                           << " pixels of edges, " << std::count(expected.begin(), expected.end(), true)
                           << " expected");
            CHECK(share_beside(expected, found, view.width) > 0.99);
            CHECK(share_beside(found, expected, view.width) > 0.99);
        }
}

TEST_CASE("edges: the same pixels on every device, in every form of the picture, and in a framebuffer's later frames") {
    const Scene scene = load_scene(test::folder("CSGRT_SCENES") + "/operators.json");
    for (const Lighting light : {Lighting::model, Lighting::headlight, Lighting::studio}) {
        View view = view_with_edges();
        view.camera = scene.camera;
        view.light = light;
        view.channels = channel::all | channel::display;
        Renderer native(scene, {}, test::on_native_device()), device(scene, {}, test::on_device()),
            reference(scene, {}, {.reference = true});
        const Image whole = native.render(view);
        test::require_same(device.render(view), whole);
        test::require_same(reference.render(view), whole);
        const std::vector<std::uint8_t> bytes = display_pixels(whole);
        const auto words = whole.ids("RGBA8");
        for (std::size_t i = 0; i < words.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) REQUIRE((words[i] >> 8 * c & 255u) == bytes[4 * i + c]);

        view.channels = channel::display;  // the surfaces are drawn beside the picture, or stay on the device
        Framebuffer framebuffer;
        for (Renderer* const renderer : {&device, &native})
            for (int i = 0; i < 3; ++i) {
                renderer->render(view, framebuffer);
                const auto shown = framebuffer.image().ids("RGBA8");
                REQUIRE(std::equal(shown.begin(), shown.end(), words.begin()));
            }
        view.samples = 3;
        view.channels = channel::color;
        test::require_same(device.render(view), native.render(view));
        view.samples = 1;
        view.channels = channel::display;
        int steps = 0;
        native.render(view, framebuffer, [&](int) { return ++steps < 9; });
        CHECK(steps == 3);
        CHECK(std::ranges::equal(framebuffer.image().ids("RGBA8"), words));
        view.edges = false;
        native.render(view, framebuffer);
        CHECK_FALSE(std::ranges::equal(framebuffer.image().ids("RGBA8"), words));
    }
}

TEST_CASE("edges leave parts of one and two pixels their colour") {
    View view{.width = 100, .height = 100, .every_partition = false, .edges = true};
    view.camera.azimuth = view.camera.elevation = 0;
    view.camera.center = Vec3{};
    view.camera.view_size = 100;
    for (const bool is_lying : {false, true}) {
        Scene scene;
        for (int width = 1; width <= 4; ++width) {
            Arb bar = box(1, width / 2.0, 30);
            for (Vec3& corner : bar.vertices) {
                corner.y += 10 * width + width / 2.0;
                if (is_lying) std::swap(corner.y, corner.z);
            }
            scene.top.push_back("bar" + std::to_string(width));
            scene.objects.push_back(Solid{scene.top.back(), bar, {}});
        }
        const Image image = Renderer(scene, {}, test::on_native_device()).render(view);
        std::string middle = ".";
        for (std::size_t i = 0; i < 100; ++i) {
            const std::size_t pixel = is_lying ? 100 * (99 - i) + 50 : 100 * 50 + i;
            const char shown = image.ids("region")[pixel] == 0 ? '.' : is_black(image, pixel) ? '#' : 'o';
            if (shown != '.' || middle.back() != '.') middle += shown;
        }
        CHECK(middle == ".o.oo.#o#.#oo#.");
    }
}

TEST_CASE("edges where rays need more memory than a kernel of first hits has, and where memory is short") {
    const Scene scene = test::nested_balls(100, {Operator::intersection}, test::Form::list);
    View view = view_with_edges();
    view.channels = channel::display;
    view.light = Lighting::studio;
    Renderer native(scene, {}, test::on_native_device()), reference(scene, {}, {.reference = true});
    const Image expected = reference.render(view);
    test::require_same(native.render(view), expected);
    for (const std::uint64_t room : {0, 400'000}) {
        Settings settings = test::on_device();
        if (room) settings.max_memory = Renderer(scene, {}, settings).statistics().device_bytes + room;
        Framebuffer framebuffer;
        Renderer device(scene, {}, settings);
        for (int i = 0; i < 2; ++i) {
            device.render(view, framebuffer);
            test::require_same(framebuffer.image(), expected);
        }
    }
}

TEST_CASE("edges are smooth with several samples") {
    Scene scene = scene_of(bodies()[0]);
    scene.background = {1, 1, 1};
    Renderer renderer(scene, {}, test::on_native_device());
    View view = view_with_edges();
    view.light = Lighting::studio;
    const Image hard = renderer.render(view);
    view.samples = 16;
    const Image smooth = renderer.render(view);
    view.edges = false;
    const Image plain = renderer.render(view);
    std::size_t darker = 0, black = 0, hard_black = 0;
    for (std::size_t i = 0; i < hard.channel("R").size(); ++i) {
        REQUIRE(smooth.channel("R")[i] <= plain.channel("R")[i]);
        darker += smooth.channel("R")[i] < plain.channel("R")[i] && smooth.channel("R")[i] > 0;
        black += plain.channel("R")[i] > 0 && smooth.channel("R")[i] == 0;
        hard_black +=
            plain.channel("A")[i] == 1 && hard.channel("A")[i] == 1 && is_black(hard, i) && plain.channel("R")[i] > 0;
    }
    CHECK(hard_black > 200);
    CHECK(darker > hard_black);
    CHECK(black < hard_black / 4);
}
