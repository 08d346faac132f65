// What a CAD viewer does, without a window: each action on a model, how many statements it takes, and how long it is
// until its pixels are there. docs/viewer.md has the table. The sequence of actions runs several times, each time with
// other parts; the times are medians.
//
//     viewer SCENE [OBJECT...]
#include <csgrt/csgrt.hpp>

#include <algorithm>
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

/// A gizmo's matrix: a way in the world.
csgrt::Matrix moved(const csgrt::Vec3& by) {
    csgrt::Matrix matrix = csgrt::identity;
    matrix[3] = by.x;
    matrix[7] = by.y;
    matrix[11] = by.z;
    return matrix;
}

/// A viewer's state: what is looked at, from where, and what undo brings back.
struct Viewer {
    std::atomic<bool> cancelled{false};
    csgrt::Renderer renderer;
    csgrt::View view;
    csgrt::Framebuffer window;
    std::vector<csgrt::Model> before;  // Models share what an edit leaves alone

    Viewer(csgrt::Model model, const csgrt::Camera& camera)
        : renderer(std::move(model), {.wait_for_device = true, .progress = [this](double) { return !cancelled; }}) {
        view.width = 800;
        view.height = 600;
        view.camera = camera;
        view.every_partition = false;
        view.channels = csgrt::channel::display;  // bytes for the screen, and nothing else
    }

    /// One frame, of which a window would show window.image().ids("RGBA8").
    void draw() { renderer.render(view, window); }
    csgrt::Model model() const { return renderer.model(); }
    csgrt::Edit edit() const { return csgrt::Edit(model()); }
    void show(const csgrt::Edit& edit) {
        csgrt::Model next = edit.commit();
        before.push_back(model());
        renderer.set_model(std::move(next));
        draw();
    }
    void undo() {
        renderer.set_model(before.back());
        before.pop_back();
        draw();
    }

    /// The height of the picture at its centre, in millimetres.
    double height() const {
        const csgrt::Box box = model().bounds();
        const csgrt::Vec3 size = sum(box.high, -1, box.low);
        return view.camera.view_size.value_or(std::hypot(size.x, size.y, size.z));
    }
    csgrt::Vec3 center() const {
        const csgrt::Box box = model().bounds();
        return view.camera.center.value_or(sum(sum({}, 0.5, box.low), 0.5, box.high));
    }
    /// The hit at a pixel beside the middle of the window.
    csgrt::Pick pick(int right = 0) const { return model().pick(view, view.width / 2 + right, view.height / 2); }
    std::string picked_path(int right) const {
        const csgrt::Pick seen = pick(right);
        return model().regions()[seen.region < 0 ? 0 : static_cast<std::size_t>(seen.region)].path;
    }
};

/// The rows of the table, in the order of their first times.
struct Table {
    struct Row {
        std::string name;
        int statements;
        std::vector<double> milliseconds;
    };
    std::vector<Row> rows;

    void add(const char* name, int statements, double milliseconds) {
        auto row = std::ranges::find(rows, name, &Row::name);
        if (row == rows.end()) row = rows.insert(row, {name, statements, {}});
        row->milliseconds.push_back(milliseconds);
    }
    void print() {
        std::printf("| action | statements | milliseconds |\n|---|---|---|\n");
        for (Row& row : rows) {
            std::ranges::sort(row.milliseconds);
            const double median = row.milliseconds[row.milliseconds.size() / 2];
            std::printf("| %s | %d | %.3g |\n", row.name.c_str(), row.statements, median);
        }
    }
};

constexpr int statements_of(const char* text) {
    int count = 1;
    for (; *text; ++text) count += *text == ';';
    return count;
}

/// Runs statements, and tells how many they are and how long they took.
#define ACTION(name, ...)                                                        \
    {                                                                            \
        const auto start = Clock::now();                                         \
        __VA_ARGS__;                                                             \
        table.add(name, statements_of(#__VA_ARGS__), milliseconds_since(start)); \
    }

/// All actions once, with the part that is seen beside the window's middle. Leaves the Model as it was.
void act(Viewer& v, Table& table, int right) {
    const csgrt::Camera camera = v.view.camera;
    ACTION("the same frame again", v.draw())
    ACTION("orbit", v.view.camera.azimuth += 15; v.view.camera.elevation += 5; v.draw())
    ACTION("pan by 20 pixels", const double pixel = v.height() / v.view.height;
           const double a = v.view.camera.azimuth * std::numbers::pi / 180;
           v.view.camera.center = sum(v.center(), 20 * pixel, {-std::sin(a), std::cos(a), 0}); v.draw())
    ACTION("zoom to the point under the cursor", const csgrt::Pick seen = v.pick(40);
           if (seen.region >= 0) v.view.camera.center = sum(seen.point, 0.5, sum(v.center(), -1, seen.point));
           v.view.camera.view_size = v.height() / 2; v.draw())
    v.view.camera = camera;

    csgrt::Pick seen;
    ACTION("pick: region, solid, point", seen = v.pick(right))
    const std::string part = v.picked_path(right);
    ACTION("recolour a part", v.show(v.edit().set_color(part, {1, 0.5, 0})))
    ACTION("hide a part", v.show(v.edit().set_state(part, csgrt::State::hidden)))
    ACTION("isolate a part", v.show(v.edit().set_state("/", csgrt::State::hidden).set_state(part, csgrt::State::shown)))
    ACTION("show all", v.show(v.edit().set_state("/", csgrt::State::shown)))
    v.view.channels |= csgrt::channel::ghosts;
    ACTION("make a part a ghost", v.show(v.edit().set_state(part, csgrt::State::ghost)))
    ACTION("orbit, with this ghost", v.view.camera.azimuth += 15; v.draw())
    v.undo();
    v.view.channels = csgrt::channel::display;
    v.view.camera = camera;
    ACTION("cut by a plane", v.view.clip = {{{1, 0, 0}, v.center().x}}; v.draw())
    v.view.clip.clear();

    // Towards the middle: a part that leaves the model's extent costs a whole compilation.
    const csgrt::Matrix gizmo = moved(sum(sum({}, 0.01, v.center()), -0.01, seen.point));
    const csgrt::Shape ball = csgrt::Ell{seen.point, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
    ACTION("move a part by a gizmo's matrix", v.show(v.edit().move(part, gizmo)))
    ACTION("drag it on", v.show(v.edit().move(part, gizmo)))
    ACTION("add a part", v.show(v.edit().add(csgrt::Solid{"a new ball", ball}, true)))
    ACTION("drag the new part", v.show(v.edit().move("/a new ball", gizmo)))
    ACTION("remove a part", v.show(v.edit().remove(part)))
    ACTION("undo", v.undo())
    while (!v.before.empty()) v.undo();

    v.view.samples = 4;
    ACTION("four rays a pixel", v.draw())
    v.view.samples = 1;
    double first_pixels = 0;
    const auto coarse_start = Clock::now();
    ACTION("coarse first, then all", v.renderer.render(v.view, v.window, [&](int size) {
        if (size == 8) first_pixels = milliseconds_since(coarse_start);
        return true;
    }))
    table.add("the first pixels of this", 0, first_pixels);
    ACTION("a screen of twice the density", v.view.width *= 2; v.view.height *= 2; v.draw())
    v.view.width /= 2;
    v.view.height /= 2;
}

/// Whether a frame ends when a user has gone on before it is drawn.
void cancel(Viewer& v) {
    v.view.samples = 256;
    std::thread impatient([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        v.cancelled = true;
    });
    try {
        v.draw();
        std::printf("256 rays a pixel were drawn before 30 ms were over\n");
    } catch (const csgrt::Error& error) {
        if (error.status() != csgrt::Status::interrupted) throw;
        std::printf("a frame of 256 rays a pixel was cancelled\n");
    }
    impatient.join();
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::fprintf(stderr, "usage: viewer SCENE [OBJECT...]\n");
        return 2;
    }
    Table table;
    const csgrt::Scene scene = csgrt::load_scene(argv[1]);
    const std::vector<std::string> objects(argv + 2, argv + argc);
    const auto start = Clock::now();
    const csgrt::Model model(scene, objects);
    table.add("a new Model", 1, milliseconds_since(start));
    Viewer v(model, scene.camera);
    v.draw();
    const int rounds = 5;
    for (int i = 0; i < rounds; ++i) act(v, table, (i - rounds / 2) * v.view.width / 16);
    table.print();
    cancel(v);
    std::printf("device: %s, %zu regions, %zu solids\n", v.renderer.statistics().device.c_str(),
                v.renderer.model().regions().size(), v.renderer.model().solids().size());
    return 0;
} catch (const csgrt::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
