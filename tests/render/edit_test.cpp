// Edits: the next Model is the one that would be compiled from the edited scene, region by region, to the last bit.
#include <csgrt/edit.hpp>

#include <map>
#include <random>
#include <thread>

#include "base/identical.hpp"
#include "catch.hpp"
#include "formats/json/write/writer.hpp"
#include "integration/lists.hpp"
#include "integration/same_answers.hpp"
#include "integration/scenes.hpp"
#include "sanitized.hpp"
#include "thrown.hpp"

using namespace csgrt;

namespace {

constexpr const char* text = R"({"csgrt": 1,
    "solids": {"ball": {"type": "sphere", "center": [0, 0, 0], "radius": 10},
               "box": {"type": "box", "low": [-4, -4, -30], "high": [4, 4, 30]},
               "tub": {"type": "sphere", "center": [0, 0, 0], "radius": 18}},
    "combinations": {
        "hub.r": {"region": true, "id": 1, "tree": "ball"},
        "rim.r": {"region": true, "id": 2, "tree": {"difference": ["box", "ball"]}},
        "wheel": {"tree": {"union": ["hub.r", "rim.r"]}},
        "hull.r": {"region": true, "id": 3, "tree": {"difference": ["tub", "ball"]}},
        "all": {"tree": {"union": ["wheel", {"object": "wheel", "translate": [60, 0, 0]},
                                   {"object": "wheel", "translate": [0, 60, 0]},
                                   {"object": "hull.r", "translate": [0, 0, 60]}]}}}})";

Model wheels() { return Model(parse_scene(text, "wheels.json")); }

std::vector<std::string> paths(const Model& model) {
    std::vector<std::string> all;
    for (const RegionInfo& region : model.regions()) all.push_back(region.path);
    return all;
}

const RegionInfo& at(const Model& model, const std::string& path) {
    for (const RegionInfo& region : model.regions())
        if (region.path == path) return region;
    FAIL("no region " << path);
    return model.regions().front();
}

std::string refusal(const std::function<void()>& work) { return test::thrown_by(work).text; }

View small_view(const Scene& scene) {
    View view{.width = 40, .height = 30, .camera = scene.camera};
    view.channels |= channel::ghosts;
    return view;
}

/// Pictures and partitions of both are the same, regions being told by their paths.
void require_same_models(const Model& edited, const Model& fresh) {
    std::map<std::string, std::uint32_t> number;
    for (std::uint32_t i = 0; i < fresh.regions().size(); ++i) number[fresh.regions()[i].path] = i;
    REQUIRE(number.size() == fresh.regions().size());
    REQUIRE(edited.regions().size() == fresh.regions().size());
    std::vector<std::uint32_t> to_fresh;
    for (const RegionInfo& region : edited.regions()) {
        REQUIRE(number.contains(region.path));
        to_fresh.push_back(number[region.path]);
        const RegionInfo& other = fresh.regions()[to_fresh.back()];
        REQUIRE(region.color == other.color);
        REQUIRE(region.state == other.state);
        REQUIRE(region.bounds.low == other.bounds.low);
        REQUIRE(region.bounds.high == other.bounds.high);
    }
    Renderer a(edited, test::on_native_device()), b(fresh, test::on_native_device());
    View view = small_view(edited.scene());
    for (const bool every_partition : {true, false}) {
        view.every_partition = every_partition;
        Image one = a.render(view);
        for (const char* name : {"region", "ghost"}) {
            const auto channel = static_cast<std::size_t>(std::ranges::find(one.names, name) - one.names.begin());
            for (std::uint32_t& id : one.channels.ids(channel)) id = id == 0 ? 0 : to_fresh[id - 1] + 1;
        }
        test::require_same(one, b.render(view));
    }
    const std::vector<Ray> rays = test::random_rays(fresh.bounds(), 60);
    for (const bool hidden : {true, false}) {
        Partitions one, other;
        Fields fields = all_fields;
        fields.hidden = hidden;
        a.partitions(rays, one, fields);
        b.partitions(rays, other, fields);
        for (Array<std::int32_t>* ids : {&one.region_ids, &one.overlap_region_ids})
            for (std::int32_t& id : *ids) id = static_cast<std::int32_t>(to_fresh[static_cast<std::size_t>(id)]);
        for (std::size_t i = 0; i < rays.size(); ++i) REQUIRE(same_rows(one, i, other, i));
    }
}

void require_compiled_anew(const Model& edited) { require_same_models(edited, Model(edited.scene())); }

/// A random edit of any kind. Some are refused.
void edit_at_random(Edit& edit, const Model& model, std::mt19937& random) {
    const auto below = [&](std::size_t count) { return random() % static_cast<unsigned>(count); };
    const auto part = [&] { return static_cast<double>(below(1001)) / 1000; };
    std::string path = model.regions()[below(model.regions().size())].path;
    if (below(3) == 0) path = path.substr(0, path.find('/', 1 + below(path.size())));
    const Matrix matrix = {1, 0, 0, 20 * part(), 0, 1, 0, -30 * part(), 0, 0, 1, part(), 0, 0, 0, 1};
    switch (below(7)) {
        case 0:
            edit.set_color(path, {part(), part(), part()});
            break;
        case 1:
            edit.set_state(path, static_cast<State>(below(3)));
            break;
        case 2:
            edit.set_finish(path, {.specular = part(), .shine = static_cast<int>(below(20))});
            break;
        case 3:
            edit.set_matrix(path, matrix, below(2) ? Edit::Share::alone : Edit::Share::all);
            break;
        case 4:
            edit.remove(path);
            break;
        case 5: {
            const double radius = 1 + 20 * part();
            const std::string name = "new" + std::to_string(random());
            edit.add(Solid{name, Ell{{}, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}, {}});
            edit.add(path, below(2) ? Operator::union_ : Operator::difference, name, matrix);
            break;
        }
        default:
            edit.set_lights({{.position = {100 * part(), 100, 100}, .color = {1, part(), 1}}});
            edit.set_background({part(), 0, 0});
    }
}

}  // namespace

TEST_CASE("each instance of a region has a path of its own, which edits of others do not change", "[promise:edits]") {
    const Model model = wheels();
    CHECK(paths(model) == std::vector<std::string>{"/all/wheel/hub.r", "/all/wheel/rim.r", "/all/wheel@2/hub.r",
                                                   "/all/wheel@2/rim.r", "/all/wheel@3/hub.r", "/all/wheel@3/rim.r",
                                                   "/all/hull.r"});
    const Model less = Edit(model).remove("/all/wheel@2").commit();
    CHECK(paths(less) == std::vector<std::string>{"/all/wheel/hub.r", "/all/wheel/rim.r", "/all/wheel@3/hub.r",
                                                  "/all/wheel@3/rim.r", "/all/hull.r"});
    const Model more = Edit(less).add("all", Operator::union_, "wheel").commit();
    CHECK(paths(more)[5] == "/all/wheel@2/hub.r");
    const Model moved = Edit(more).set_matrix("/all/wheel@3/hub.r", identity).commit();
    CHECK(paths(moved) == paths(more));
    CHECK(Model(moved.scene(), {"/all/wheel@3"}).regions()[1].path == "/all/wheel@3/rim.r");
    // Kept in files, too.
    CHECK(paths(Model(parse_scene(json_scene_text(moved.scene()), "again.json"))) == paths(moved));
}

TEST_CASE("regions whose legs do not tell them apart are numbered", "[promise:edits]") {
    const char* const both = R"({"csgrt": 1,
        "solids": {"a": {"type": "sphere", "center": [0, 0, 0], "radius": 1},
                   "b": {"type": "sphere", "center": [9, 0, 0], "radius": 1},
                   "c": {"type": "sphere", "center": [4, 0, 0], "radius": 9}},
        "combinations": {"x": {"tree": {"intersection": ["c", {"union": ["a", "b"]}]}}}})";
    CHECK(paths(Model(parse_scene(both, "both.json"))) == std::vector<std::string>{"/x/c", "/x/c@2"});
}

TEST_CASE("colours, finishes and states are those of one instance, or of all below a path", "[promise:edits]") {
    const Model model = wheels();
    const Vec3 red{1, 0, 0}, blue{0, 0, 1};
    const Model painted = Edit(model).set_color("/all/wheel@2", red).set_color("/all/wheel@2/rim.r", blue).commit();
    CHECK(at(painted, "/all/wheel@2/hub.r").color == red);
    CHECK(at(painted, "/all/wheel@2/rim.r").color == blue);
    CHECK(at(painted, "/all/wheel/hub.r").color == at(model, "/all/wheel/hub.r").color);
    CHECK(at(Edit(painted).set_color("all", red).commit(), "/all/wheel@2/rim.r").color == red);
    const Model shiny = Edit(painted).set_finish("/all/hull.r", {.shine = 77}).commit();
    CHECK(at(shiny, "/all/hull.r").finish.shine == 77);
    CHECK(at(model, "/all/hull.r").finish.shine == 10);
    for (const Model& next : {painted, shiny}) require_compiled_anew(next);
    // A region that begins to shine gives light.
    Finish glow{.shader = "light"};
    glow.light = Emission();
    require_compiled_anew(Edit(shiny).set_finish("/all/hull.r", glow).commit());
}

TEST_CASE("what is hidden is seen through, and stays in partitions and Booleans", "[promise:edits]") {
    const Model model = wheels();
    const std::vector<Ray> ray{{{0, 0, 100}, {0, 0, -1}}};  // through the hull, then the first wheel
    const Model hidden = Edit(model).set_state("/all/hull.r", State::hidden).commit();
    const Model ghost = Edit(model).set_state("/all/hull.r", State::ghost).commit();
    Hits hits;
    Partitions all, shown;
    for (const Model& next : {model, hidden, ghost}) {
        const bool is_shown = at(next, "/all/hull.r").state == State::shown;
        next.cast_rays(ray, hits);
        CHECK(next.regions()[static_cast<std::size_t>(hits.region_ids[0])].path ==
              (is_shown ? "/all/hull.r" : "/all/wheel/rim.r"));
        next.partitions(ray, all);
        next.partitions(ray, shown, {.hidden = false});
        CHECK(all.region_ids.size() == 5);  // twice the hull, twice the rim, and the hub
        CHECK(shown.region_ids.size() == (is_shown ? 5 : 3));
        const View down{.width = 1, .height = 1, .camera = {.elevation = 90, .center = Vec3{0, 0, 0}}};
        const Pick pick = next.pick(down, 0, 0);
        CHECK(pick.region == hits.region_ids[0]);
        CHECK(pick.along.partitions.size() == 5);
    }
    View view{.width = 9, .height = 9, .camera = {.elevation = 90}};
    view.channels = channel::ids | channel::ghosts;
    const Image picture = Renderer(ghost).render(view);
    std::size_t ghosts = 0;
    for (std::size_t i = 0; i < picture.ids("ghost").size(); ++i) {
        const std::uint32_t passed = picture.ids("ghost")[i];
        ghosts += passed != 0;
        CHECK((passed == 0 || ghost.regions()[passed - 1].path == "/all/hull.r"));
        CHECK(picture.ids("region")[i] != 7);
    }
    CHECK(ghosts > 0);
    for (const Model& next : {hidden, ghost}) require_compiled_anew(next);
    require_compiled_anew(
        Edit(model).set_state("/all", State::hidden).set_state("/all/wheel@2", State::shown).commit());
}

TEST_CASE("a matrix moves one instance, or all that share the leg", "[promise:edits]") {
    const Model model = wheels();
    Matrix up = identity;
    up[11] = 5;
    const auto raised = [&](const Model& next, const std::string& path) {
        return at(next, path).bounds.high.z == at(model, path).bounds.high.z + 5;
    };
    const Model alone = Edit(model).set_matrix("/all/wheel@2/hub.r", up).commit();
    CHECK(raised(alone, "/all/wheel@2/hub.r"));
    CHECK_FALSE(raised(alone, "/all/wheel/hub.r"));
    CHECK_FALSE(raised(alone, "/all/wheel@2/rim.r"));
    const Model all = Edit(model).set_matrix("/all/wheel@2/hub.r", up, Edit::Share::all).commit();
    for (const char* path : {"/all/wheel/hub.r", "/all/wheel@2/hub.r", "/all/wheel@3/hub.r"}) CHECK(raised(all, path));
    // Again and again: no more copies come.
    Model again = alone;
    for (int i = 0; i < 3; ++i) again = Edit(again).set_matrix("/all/wheel@2/hub.r", up).commit();
    CHECK(again.scene().objects.size() == alone.scene().objects.size());
    for (const Model& next : {alone, all, again}) require_compiled_anew(next);
}

TEST_CASE("solids are replaced, objects added, legs removed with their operators") {
    const Model model = wheels();
    const Model large = Edit(model).replace("ball", Ell{{}, {12, 0, 0}, {0, 12, 0}, {0, 0, 12}}).commit();
    CHECK(at(large, "/all/wheel/hub.r").bounds.high.x == 12);
    const Model whole = Edit(model).remove("/all/hull.r/ball").commit();  // nothing is taken away any more
    Array<std::int32_t> ids;
    whole.region_at(std::vector<Vec3>{{0, 0, 60}}, ids);
    CHECK(whole.regions()[static_cast<std::size_t>(ids[0])].path == "/all/hull.r");
    CHECK(paths(Edit(model).remove("/all/hull.r/tub").commit()).size() == 6);  // and what was taken from it, too
    Combination part{.name = "part.r", .tree = tree("box") - tree("ball"), .region = true};
    const Model added = Edit(model).add(part).add("all", Operator::union_, "part.r").commit();
    CHECK(paths(added).back() == "/all/part.r");
    const Model beside = Edit(model).add(part, true).commit();
    CHECK(paths(beside).back() == "/part.r");
    CHECK(paths(Edit(beside).remove("part.r").commit()) == paths(model));
    for (const Model& next : {large, whole, added}) require_compiled_anew(next);
}

TEST_CASE("what cannot be is refused with the place, and changes nothing", "[promise:edits]") {
    const Model model = wheels();
    Edit edit(model);
    CHECK(refusal([&] { edit.set_matrix("/all/weel/hub.r", identity); }).find("'all' has no member 'weel'") !=
          std::string::npos);
    CHECK(refusal([&] { edit.set_matrix("all", identity); }) ==
          "'all' is no leg of a combination: give the path that leads to it");
    CHECK(refusal([&] { edit.replace("wheel", Ell{}); }) == "'wheel' is a combination: it has no numbers of its own");
    CHECK(refusal([&] { edit.add(Solid{"ball", Ell{}, {}}); }) == "the scene has an object 'ball' already");
    CHECK(refusal([&] { edit.add("ball", Operator::union_, "box"); }) == "'ball' is a solid: it has no legs");
    CHECK(refusal([&] { edit.remove("/all"); }) == "'/all' is all that is rendered");
    CHECK(refusal([&] {
              static_cast<void>(Edit(model).set_color("/all/x", {}).commit());
          }).starts_with("the model has no region at '/all/x', nor below it"));
    CHECK(refusal([&] {
              static_cast<void>(Edit(model).set_color("/all/weel/hub.r", {}).commit());
          }).find("did you mean '/all/wheel/hub.r'?") != std::string::npos);
    CHECK(refusal([&] { edit.set_state("", State::hidden); }) == "the path '' names nothing");
    CHECK(refusal([&] {
              static_cast<void>(Edit(model).set_color("/all", {2, 0, 0}).commit());
          }).find("a colour has components from 0 to 1") != std::string::npos);
    Matrix flat = identity;
    flat[0] = 0;
    CHECK(refusal([&] {
              static_cast<void>(Edit(model).set_matrix("/all/wheel/hub.r", flat).commit());
          }).find("singular") != std::string::npos);
    require_same_models(edit.commit(), model);
}

TEST_CASE("after random edits a model is the one that is compiled from the edited scene", "[promise:edits]") {
    std::vector<std::pair<Scene, std::vector<std::string>>> scenes;
    for (const std::string& file : test::scene_files())
        scenes.emplace_back(load_scene(file), std::vector<std::string>());
    scenes.emplace_back(parse_scene(text, "wheels.json"), std::vector<std::string>());
    std::mt19937 random(57);
    int commits = 0, refused = 0;
    for (const auto& [scene, objects] : scenes) {
        Model model(scene, objects);
        for (int i = 0; i < test::tries(8); ++i) {
            Edit edit(model);
            try {
                for (unsigned n = 0; n <= random() % 3; ++n) edit_at_random(edit, model, random);
                model = edit.commit();
            } catch (const Error&) {  // the model is as before
                ++refused;
                continue;
            }
            ++commits;
            require_compiled_anew(model);
        }
    }
    CHECK(commits > refused);
}

TEST_CASE("the same on BRL-CAD's models: 500 edits", "[.long]") {
    std::mt19937 random(500);
    int commits = 0;
    const std::vector<test::Model> few = test::models_there(true);
    if (few.empty()) return;
    for (const test::Model& of : few) {
        Scene scene = load_scene(of.file);
        scene.top = of.objects;  // the edited scene's own, where an edit removes one
        Model model(std::move(scene));
        for (int done = 0; done < test::tries(100);) {
            Edit edit(model);
            try {
                edit_at_random(edit, model, random);
                const Model next = edit.commit();
                require_compiled_anew(next);
                if (next.regions().size() > 3) model = next;
            } catch (const Error&) {
                continue;
            }
            ++done;
            ++commits;
        }
    }
    CHECK(commits >= test::tries(500));
}

TEST_CASE("three threads draw, pick and edit at once, without a lock", "[promise:edits]") {
    Renderer renderer(wheels(), test::on_native_device());
    std::atomic<bool> stop{false};
    std::atomic<int> pictures{0}, picks{0};
    View view = small_view(Scene());
    view.every_partition = false;
    std::thread picker([&] {
        while (!stop) picks += renderer.model().pick(view, 20, 15).region >= -1;
    });
    std::thread editor([&] {
        std::mt19937 random(3);
        for (int i = 0; i < test::tries(60); ++i) {
            const std::string path = "/all/wheel@" + std::to_string(2 + i % 2);
            Matrix matrix = identity;
            matrix[3] = 60 + i % 7;
            Edit edit(renderer.model());
            i % 3 == 0 ? edit.set_matrix(path, matrix) : edit.set_color(path, {1, 0, i % 5 * 0.2});
            renderer.set_model(edit.commit());
        }
        stop = true;
    });
    while (!stop) pictures += renderer.render(view).width == 40;
    picker.join();
    editor.join();
    CHECK(pictures > 0);
    CHECK(picks > 0);
    Renderer fresh(renderer.model(), test::on_native_device());
    test::require_same(renderer.render(view), fresh.render(view));
}
