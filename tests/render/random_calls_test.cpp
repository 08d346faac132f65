// Calls of the API in random order, with good arguments and bad ones: each answers as a new Renderer's first call
// would, or throws an Error and changes nothing.
#include <limits>
#include <memory>

#include "catch.hpp"

#include <csgrt/csgrt.hpp>

#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "sanitized.hpp"
#include "stress/random.hpp"

using namespace csgrt;

namespace {

class Calls {
public:
    explicit Calls(std::uint64_t seed) : random_(seed) {
        for (const char* name : {"operators", "overlap", "solids"})
            scenes_.push_back(load_scene(test::folder("CSGRT_SCENES") + "/" + name + ".json"));
        begin_anew();
    }

    void call() {
        switch (random_.below(10)) {
            case 0:
            case 1:
                return render(some_view());
            case 2:
            case 3:
                return render_into(some_view());
            case 4:
                return shoot();
            case 5:
                return refuse_view();
            case 6:
                return refuse_rays();
            case 7:
                return interrupt();
            case 8:
                return move();
            default:
                if (random_.below(4) == 0) begin_anew();
                CHECK(renderer_->model().regions().size() == reference_->model().regions().size());
                CHECK(renderer_->device_warnings().size() == reference_->device_warnings().size());
        }
    }

private:
    void begin_anew() {
        const Scene& scene = scenes_[random_.below(static_cast<std::uint32_t>(scenes_.size()))];
        Settings settings = test::on_native_device();
        if (random_.coin()) settings.max_memory = 4'000'000;
        settings.threads = random_.below(4);
        settings.progress = [this](double) { return !stop_; };
        if (renderer_ && random_.coin())
            *renderer_ = Renderer(scene, {}, settings);
        else
            renderer_ = std::make_unique<Renderer>(scene, std::vector<std::string>(), settings);
        settings.reference = true;
        settings.device.clear();
        settings.progress = nullptr;
        reference_ = std::make_unique<Renderer>(scene, std::vector<std::string>(), settings);
    }

    View some_view() {
        View view;
        view.width = 1 + static_cast<int>(random_.below(70));
        view.height = 1 + static_cast<int>(random_.below(40));
        view.camera.azimuth = random_.between(-180, 180);
        view.camera.elevation = random_.between(-90, 90);
        view.camera.perspective = random_.coin() ? 0 : random_.between(1, 120);
        view.every_partition = random_.coin();
        view.channels = random_.below(channel::all + 1);
        view.transparent = random_.coin();
        return view;
    }

    void render(const View& view) {
        const Image image = renderer_->render(view);
        test::require_same(image, reference_->render(view));
        Image named = image, theirs = image;
        renderer_->name_pixels(named);
        renderer_->name_overlaps(view, named);
        reference_->name_overlaps(view, theirs);
        CHECK(named.attributes["csgrt:overlaps"] == theirs.attributes["csgrt:overlaps"]);
    }

    void render_into(const View& view) {
        Framebuffer& framebuffer = framebuffers_[random_.below(2)];
        renderer_->render(view, framebuffer);
        test::require_same(framebuffer.image(), reference_->render(view));
    }

    std::vector<Ray> some_rays() {
        std::vector<Ray> rays(random_.below(60));
        for (Ray& ray : rays) {
            const Vec3 d = random_.direction();
            ray = {{200 * d.x, 200 * d.y, 200 * d.z}, {-d.x, -d.y + 0.1 * random_.unit(), -d.z}};
        }
        return rays;
    }
    void shoot() {
        const std::vector<Ray> rays = some_rays();
        test::require_same(renderer_->shoot(rays), reference_->shoot(rays));
    }

    void refuse_view() {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        View view = some_view();
        switch (random_.below(5)) {
            case 0:
                view.width = -static_cast<int>(random_.below(3));
                break;
            case 1:
                view.height = 32'769;
                break;
            case 2:
                view.camera.azimuth = nan;
                break;
            case 3:
                view.camera.perspective = 180;
                break;
            default:
                view.camera.center = Vec3{0, nan, 0};
        }
        const auto is_usage = [](const Error& error) { return error.status() == Status::usage; };
        if (random_.coin())
            CHECK_THROWS_MATCHES(renderer_->render(view), Error, Catch::Predicate<Error>(is_usage, "a wrong view"));
        else
            CHECK_THROWS_MATCHES(renderer_->render(view, framebuffers_[0]), Error,
                                 Catch::Predicate<Error>(is_usage, "a wrong view"));
    }

    void refuse_rays() {
        std::vector<Ray> rays = some_rays();
        const Ray bad[] = {{{0, 0, std::numeric_limits<double>::quiet_NaN()}, {0, 0, 1}},
                           {{0, 0, 0}, {0, 0, 0}},
                           {{0, 0, 0}, {std::numeric_limits<double>::infinity(), 0, 0}}};
        rays.insert(rays.begin() + random_.below(static_cast<std::uint32_t>(rays.size() + 1)), bad[random_.below(3)]);
        CHECK_THROWS_AS(renderer_->shoot(rays), Error);
    }

    /// A call that is finished before it is asked answers; the framebuffer keeps a whole picture otherwise, too.
    void interrupt() {
        stop_ = true;
        try {
            View view = some_view();
            view.width = view.height = 200;
            renderer_->render(view, framebuffers_[1]);
        } catch (const Error& error) {
            CHECK(error.status() == Status::interrupted);
        }
        stop_ = false;
    }

    void move() {
        Renderer moved = std::move(*renderer_);
        if (random_.coin()) CHECK_THROWS_AS(renderer_->render(some_view()), Error);
        *renderer_ = std::move(moved);
    }

    stress::Random random_;
    std::vector<Scene> scenes_;
    bool stop_ = false;
    std::unique_ptr<Renderer> renderer_, reference_;
    Framebuffer framebuffers_[2];
};

void make(int calls, std::uint64_t seed) {
    if (test::folder("CSGRT_SCENES").empty()) return;
    Calls made(seed);
    for (int i = 0; i < calls; ++i) {
        INFO("seed " << seed << ", call " << i);
        made.call();
    }
}

}  // namespace

TEST_CASE("calls in random order answer as the first one does, or throw an Error", "[promise:models]") {
    make(test::tries(400), 1);
}
TEST_CASE("100,000 calls in random order", "[.long]") {
    for (std::uint64_t seed = 2; seed < 102; ++seed) make(1000, seed);
}
