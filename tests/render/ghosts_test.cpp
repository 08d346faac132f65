// Ghosts: the picture is the one of the shown regions, and the channel is what two pictures say by themselves, to the
// last bit; however a picture is drawn.
#include <csgrt/edit.hpp>

#include <random>

#include "catch.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "sanitized.hpp"
#include "stress/parts.hpp"

using namespace csgrt;

namespace {

/// The regions at these states, with others for each state.
Model with(const Model& model, const std::vector<State>& states, State shown, State ghost) {
    Edit edit(model);
    for (std::size_t i = 0; i < states.size(); ++i)
        if (states[i] != State::shown || shown != State::shown)
            edit.set_state(model.regions()[i].path, states[i] == State::shown   ? shown
                                                    : states[i] == State::ghost ? ghost
                                                                                : State::hidden);
    return edit.commit();
}

/// States of one ghost, of one that is shown, or of all kinds.
std::vector<State> random_states(std::size_t regions, std::mt19937& random) {
    const auto kind = random() % 3;
    std::vector<State> states(regions, kind == 1 ? State::ghost : State::shown);
    if (kind < 2) states[random() % regions] = kind == 1 ? State::shown : State::ghost;
    for (State& state : states)
        if (kind == 2) state = static_cast<State>(random() % 3);
    return states;
}

View random_view(const Model& model, std::mt19937& random) {
    const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
    const auto within = [&] {
        const auto [low, high] = model.bounds();
        return Vec3{between(low.x, high.x), between(low.y, high.y), between(low.z, high.z)};
    };
    View view{.width = 61, .height = 45, .every_partition = random() % 4 == 0};
    view.camera.azimuth = between(0, 360);
    view.camera.elevation = between(-90, 90);
    if (random() % 2) view.camera.perspective = between(10, 90);
    if (random() % 4 == 0)  // among the regions
        view.camera = {.perspective = 70, .center = within(), .eye = within()};
    if (random() % 3 == 0) {
        const Vec3 normal{between(-1, 1), between(-1, 1), between(-1, 1)}, at = within();
        view.clip = {{normal, normal.x * at.x + normal.y * at.y + normal.z * at.z}};
    }
    return view;
}

/// Returns how many pixels have a ghost.
std::size_t require_ghosts(const Model& model, std::mt19937& random, int tries, const Settings& settings) {
    std::size_t count = 0;
    Renderer renderer(model, settings);
    for (int i = 0; i < tries; ++i) {
        INFO("try " << i);
        const std::vector<State> states = random_states(model.regions().size(), random);
        View view = random_view(model, random);
        renderer.set_model(with(model, states, State::hidden, State::shown));
        const Image passed = renderer.render(view);
        renderer.set_model(with(model, states, State::shown, State::hidden));
        view.channels |= channel::display;
        Image shown = renderer.render(view);
        shown.names.emplace_back("ghost");
        shown.are_ids.push_back(true);
        std::vector<std::vector<float>> channels;
        for (std::size_t c = 0; c < shown.channels.size(); ++c)
            channels.emplace_back(shown.channels[c].begin(), shown.channels[c].end());
        std::vector<float>& ghosts = channels.emplace_back(channels.front().size());
        for (std::size_t k = 0; k < ghosts.size(); ++k) {
            const bool is_before = passed.channel("Z")[k] < shown.channel("Z")[k];
            ghosts[k] = is_before ? std::bit_cast<float>(passed.ids("region")[k]) : 0.0f;
            count += is_before;
        }
        shown.channels = Channels(channels);

        renderer.set_model(with(model, states, State::shown, State::ghost));
        view.channels |= channel::ghosts;
        const Image whole = renderer.render(view);
        test::require_same(whole, shown);
        Framebuffer framebuffer;
        renderer.render(view, framebuffer, [](int) { return true; });
        test::require_same(framebuffer.image(), whole);
        for (const std::uint32_t own : {channel::display, channel::color | channel::normal, channel::distance}) {
            view.channels = own | channel::ghosts;
            const Image some = renderer.render(view);
            for (std::size_t c = 0; c < some.names.size(); ++c) {
                INFO(some.names[c]);
                const auto at = std::ranges::find(whole.names, some.names[c]) - whole.names.begin();
                REQUIRE(std::ranges::equal(some.channels.ids(c), whole.channels.ids(static_cast<std::size_t>(at))));
            }
        }
    }
    return count;
}

}  // namespace

TEST_CASE("ghosts are where two pictures say, however the picture is drawn", "[promise:edits]") {
    std::mt19937 random(11);
    const Model parts(stress::scene_of_parts(12));
    Settings checked = test::on_native_device();
    checked.check = 1;  // what is behind the surfaces is not drawn, and not compared
    CHECK(require_ghosts(parts, random, test::tries(40), test::on_native_device()) > 1000);
    CHECK(require_ghosts(parts, random, test::tries(8), checked) > 200);
    CHECK(require_ghosts(parts, random, test::tries(4), {.reference = true}) > 100);
    const std::string folder = test::folder("CSGRT_BRLCAD");
    if (folder.empty()) return;
    const Model goliath(load_scene(folder + "/goliath.asc"));
    CHECK(require_ghosts(goliath, random, test::tries(6), test::on_native_device()) > 500);
}

TEST_CASE("the same by PoCL", "[.long]") {
    std::mt19937 random(12);
    Settings pocl{.device = "pocl", .wait_for_device = true};
    CHECK(require_ghosts(Model(stress::scene_of_parts(12)), random, 40, pocl) > 1000);
    pocl.precision = Precision::single;
    CHECK(require_ghosts(Model(stress::scene_of_parts(12)), random, 40, pocl) > 1000);
}
