// What a CAD viewer does, without a window: each action on a model, how many statements it takes, and how long it is
// until its pixels are there. docs/viewer.md has the table.
//
//     viewer SCENE [OBJECT...]
#include <csgrt/csgrt.hpp>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

csgrt::Vec3 sum(const csgrt::Vec3& a, double s, const csgrt::Vec3& b) {
    return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

/// A viewer's state: what is looked at, and from where.
struct Viewer {
    std::atomic<bool> cancelled{false};
    csgrt::Renderer renderer;
    csgrt::View view;
    csgrt::Framebuffer window;

    Viewer(csgrt::Model model, const csgrt::Camera& camera)
        : renderer(std::move(model), {.progress = [this](double) { return !cancelled; }}) {
        view.width = 800;
        view.height = 600;
        view.camera = camera;
        view.every_partition = false;
        view.channels = csgrt::channel::display;  // bytes for the screen, and nothing else
    }

    /// One frame, of which a window would show window.image().ids("RGBA8").
    void draw() { renderer.render(view, window); }
    /// The height of the picture at its centre, in millimetres.
    double height() const {
        const csgrt::Box box = renderer.model().bounds();
        const csgrt::Vec3 size = sum(box.high, -1, box.low);
        return view.camera.view_size.value_or(std::hypot(size.x, size.y, size.z));
    }
    csgrt::Vec3 center() const {
        const csgrt::Box box = renderer.model().bounds();
        return view.camera.center.value_or(sum(sum({}, 0.5, box.low), 0.5, box.high));
    }
    /// What the pixel in the middle of the window, or beside it, shows.
    csgrt::Pick pick(int right = 0) const {
        return renderer.model().pick(view, view.width / 2 + right, view.height / 2);
    }
    std::string picked_path() const {
        const csgrt::Pick seen = pick();
        return renderer.model().regions()[seen.region < 0 ? 0 : static_cast<std::size_t>(seen.region)].path;
    }
    csgrt::Edit edit() const { return csgrt::Edit(renderer.model()); }
};

constexpr int statements_of(const char* text) {
    int count = 1;
    for (; *text; ++text) count += *text == ';';
    return count;
}

void print(const char* name, int statements, double milliseconds) {
    std::printf("| %s | %d | %.2f |\n", name, statements, milliseconds);
}

/// Runs statements, and tells how many they are and how long they took.
#define ACTION(name, ...)                                                    \
    {                                                                        \
        const auto start = Clock::now();                                     \
        __VA_ARGS__;                                                         \
        print(name, statements_of(#__VA_ARGS__), milliseconds_since(start)); \
    }

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::fprintf(stderr, "usage: viewer SCENE [OBJECT...]\n");
        return 2;
    }
    const csgrt::Scene scene = csgrt::load_scene(argv[1]);
    Viewer v(csgrt::Model(scene, std::vector<std::string>(argv + 2, argv + argc)), scene.camera);
    v.draw();
    std::printf("| action | statements | milliseconds |\n|---|---|---|\n");

    ACTION("the same frame again", v.draw())
    ACTION("orbit", v.view.camera.azimuth += 15; v.view.camera.elevation += 5; v.draw())
    ACTION("pan by 20 pixels", const double pixel = v.height() / v.view.height;
           const double a = v.view.camera.azimuth * std::numbers::pi / 180;
           v.view.camera.center = sum(v.center(), 20 * pixel, {-std::sin(a), std::cos(a), 0}); v.draw())
    ACTION("zoom to the point under the cursor", const csgrt::Pick seen = v.pick(40);
           if (seen.region >= 0) v.view.camera.center = sum(seen.point, 0.5, sum(v.center(), -1, seen.point));
           v.view.camera.view_size = v.height() / 2; v.draw())
    v.view.camera = scene.camera;
    ACTION("pick: region, solid, point", const csgrt::Pick seen = v.pick(); static_cast<void>(seen))
    const std::string part = v.picked_path();
    ACTION("hide a part", v.renderer.set_model(v.edit().set_state(part, csgrt::State::hidden).commit()); v.draw())
    ACTION("isolate a part", const std::string top = part.substr(0, part.find('/', 1)); v.renderer.set_model(
        v.edit().set_state(top, csgrt::State::hidden).set_state(part, csgrt::State::shown).commit());
           v.draw())
    ACTION("show all", const std::string top = part.substr(0, part.find('/', 1));
           v.renderer.set_model(v.edit().set_state(top, csgrt::State::shown).commit()); v.draw())
    ACTION("recolour a part", v.renderer.set_model(v.edit().set_color(part, {1, 0.5, 0}).commit()); v.draw())
    if (part.find('/', 1) != std::string::npos) {
        csgrt::Matrix up = csgrt::identity;
        up[11] = 0.05 * v.height();
        ACTION("move a part", v.renderer.set_model(v.edit().set_matrix(part, up).commit()); v.draw())
    }
    ACTION("cut by a plane", v.view.clip = {{{1, 0, 0}, v.center().x}}; v.draw())
    v.view.clip.clear();
    ACTION("four rays a pixel", v.view.samples = 4; v.draw())
    v.view.samples = 1;
    double first_pixels = 0;
    const auto coarse_start = Clock::now();
    ACTION("coarse first, then all", v.renderer.render(v.view, v.window, [&](int size) {
        if (size == 8) first_pixels = milliseconds_since(coarse_start);
        return true;
    }))
    print("... its first pixels", 0, first_pixels);
    ACTION("a screen of twice the density", v.view.width *= 2; v.view.height *= 2; v.draw())
    v.view.samples = 16;
    std::thread impatient([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        v.cancelled = true;
    });
    try {
        v.draw();
        std::printf("16 rays a pixel were drawn before 30 ms were over\n");
    } catch (const csgrt::Error& error) {
        if (error.status() != csgrt::Status::interrupted) throw;
        std::printf("a frame of 16 rays a pixel was cancelled\n");
    }
    impatient.join();
    std::printf("device: %s, %zu regions, %zu solids\n", v.renderer.statistics().device.c_str(),
                v.renderer.model().regions().size(), v.renderer.model().solids().size());
    return 0;
} catch (const csgrt::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
