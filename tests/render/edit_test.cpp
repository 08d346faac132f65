// Edits: the next Model is the one that would be compiled from the edited scene, region by region, to the last bit.
#include <csgrt/edit.hpp>

#include <random>
#include <thread>

#include "base/identical.hpp"
#include "catch.hpp"
#include "compile/model.hpp"
#include "formats/json/write/writer.hpp"
#include "integration/lists.hpp"
#include "integration/scenes.hpp"
#include "render/same_models.hpp"
#include "sanitized.hpp"
#include "scene/vector.hpp"
#include "thrown.hpp"

using namespace csgrt;
using test::require_compiled_anew, test::require_same_models, test::small_view;

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

/// A random edit of any kind. Some are refused.
void edit_at_random(Edit& edit, const Model& model, std::mt19937& random) {
    const auto below = [&](std::size_t count) { return random() % static_cast<unsigned>(count); };
    const auto part = [&] { return static_cast<double>(below(1001)) / 1000; };
    std::string path = model.regions()[below(model.regions().size())].path;
    if (below(3) == 0) path = path.substr(0, path.find('/', 1 + below(path.size())));
    const Matrix matrix = {1, 0, 0, 20 * part(), 0, 1, 0, -30 * part(), 0, 0, 1, part(), 0, 0, 0, 1};
    const Ell ball{{}, {1 + 20 * part(), 0, 0}, {0, 9, 0}, {0, 0, 9}};
    switch (below(11)) {
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
            const std::string name = "new" + std::to_string(random());
            edit.add(Solid{name, ball, {}});
            edit.add(path, below(2) ? Operator::union_ : Operator::difference, name, matrix);
            break;
        }
        case 6:
            edit.move(below(4) ? path : "/", matrix, below(2) ? Edit::Share::alone : Edit::Share::all);
            break;
        case 7:
            edit.erase(path);
            break;
        case 8:
            edit.add_top(model.children(path).at(0).object, matrix);
            break;
        case 9:
            edit.replace(model.solids()[below(model.solids().size())].name, ball, below(2) ? matrix : identity);
            break;
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

TEST_CASE("a path tells its matrix, its placement, its region and what is below it", "[promise:edits]") {
    const Model model = wheels();
    CHECK(model.matrix_of("/all/wheel@2") == test::moved(60, 0, 0));
    CHECK(model.matrix_of("all/wheel@2/hub.r") == identity);
    CHECK(model.placement_of("/all/wheel@2/hub.r/ball") == test::moved(60, 0, 0));
    CHECK(model.region("/all/wheel@2/rim.r") == 3);
    CHECK(model.region("all/hull.r/") == 6);
    CHECK(model.region("/all/wheel@2") == -1);
    CHECK(model.regions("all/wheel@2/") == std::vector<std::uint32_t>{2, 3});
    CHECK(model.regions("/all/hull.r") == std::vector<std::uint32_t>{6});
    CHECK(model.regions("/").size() == 7);
    CHECK(model.regions("/all/whee").empty());
    const auto listed = [](const Model& of, const std::string& path) {
        std::string rows;
        for (const ChildInfo& child : of.children(path)) {
            CHECK(child.path.ends_with("/" + child.name));
            rows += child.path + " " + child.object + " " + child.type + " " + std::to_string(int(child.op)) + "\n";
        }
        return rows;
    };
    CHECK(listed(model, "/") == "/all all combination 1\n");
    CHECK(listed(model, "all/") ==
          "/all/wheel wheel combination 1\n/all/wheel@2 wheel combination 1\n"
          "/all/wheel@3 wheel combination 1\n/all/hull.r hull.r region 1\n");
    CHECK(listed(model, "/all/hull.r") == "/all/hull.r/tub tub ell 1\n/all/hull.r/ball ball ell 3\n");
    CHECK(listed(model, "/all/hull.r/ball").empty());
    CHECK(listed(Model(model.scene(), {"all/wheel@3", "hull.r"}), "/") ==
          "/all/wheel@3 wheel combination 1\n/hull.r hull.r region 1\n");
    // As BRL-CAD writes it: u tub - box u wheel + hull.r ^ hub.r
    const Tree mixed = ((tree("tub") - tree("box")) | (tree("wheel") & tree("hull.r"))) ^ tree("hub.r");
    const Model other = Edit(model).add(Combination{.name = "mixed", .tree = mixed, .region = true}, true).commit();
    CHECK(listed(other, "mixed") ==
          "/mixed/tub tub ell 1\n/mixed/box box arb8 3\n/mixed/wheel wheel combination 1\n"
          "/mixed/hull.r hull.r region 2\n/mixed/hub.r hub.r region 4\n");
    CHECK(refusal([&] { static_cast<void>(model.matrix_of("/all/weel")); }).find("no member 'weel'") !=
          std::string::npos);
    CHECK(refusal([&] { static_cast<void>(model.children("")); }) == "the path '' names nothing");
    CHECK(refusal([&] { static_cast<void>(model.region("")); }) == "the path '' names nothing");
}

TEST_CASE("a move is one of the world, whatever stands above", "[promise:edits]") {
    const Matrix turn{0, -2, 0, 7, 1, 0, 0, 60, 0, 0, 1, 5, 0, 0, 0, 1}, slide = test::moved(3, 4, 5);
    const Model model = Edit(wheels()).set_matrix("/all/wheel@2", turn).commit();
    const std::string hub = "/all/wheel@2/hub.r";
    const Model moved = Edit(model).move(hub, slide).commit();
    CHECK(moved.placement_of(hub) == compose(slide, model.placement_of(hub)));
    CHECK(moved.matrix_of(hub) == test::moved(4, -1.5, 5));
    const Vec3 low = at(model, hub).bounds.low;
    CHECK(at(moved, hub).bounds.low == Vec3{low.x + 3, low.y + 4, low.z + 5});
    CHECK(at(moved, "/all/wheel/hub.r").bounds.low == at(model, "/all/wheel/hub.r").bounds.low);
    const Model all = Edit(model).move(hub, slide, Edit::Share::all).commit();
    CHECK(all.matrix_of("/all/wheel/hub.r") == moved.matrix_of(hub));
    const Model back = Edit(moved).move(hub, test::moved(-3, -4, -5)).commit();
    CHECK(back.placement_of(hub) == model.placement_of(hub));
    for (const Model& next : {moved, all}) require_compiled_anew(next);
    Edit edit(model);
    edit.set_matrix("/all/wheel@2", Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1});
    CHECK(refusal([&] {
              edit.move(hub, slide);
          }).starts_with("a matrix above '/all/wheel@2/hub.r' cannot be inverted, so that nothing below it can be"));
}

TEST_CASE("what is compiled by itself is told by paths, and keeps colours and states", "[promise:edits]") {
    // The two balls at the ends keep the model's extent; no two parts share a place along any axis.
    const Model model(parse_scene(R"({"csgrt": 1,
        "solids": {"low": {"type": "sphere", "center": [-300, -300, -300], "radius": 10},
                   "high": {"type": "sphere", "center": [300, 300, 300], "radius": 10},
                   "ball": {"type": "sphere", "center": [0, 0, 0], "radius": 10},
                   "box": {"type": "box", "low": [0, 1, -20], "high": [8, 11, 34]},
                   "tub": {"type": "sphere", "center": [-90, -80, -70], "radius": 18}},
        "combinations": {
            "ends.r": {"region": true, "id": 1, "tree": {"union": ["low", "high"]}},
            "hub.r": {"region": true, "id": 2, "tree": "ball"},
            "rim.r": {"region": true, "id": 3, "tree": {"difference": ["box", "ball"]}},
            "tub.r": {"region": true, "id": 4, "tree": "tub"},
            "wheel": {"tree": {"union": ["hub.r", "rim.r"]}},
            "car": {"tree": {"union": ["wheel", {"object": "wheel", "translate": [70, 80, 90]}, "tub.r"]}},
            "all": {"tree": {"union": ["ends.r", "car"]}}}})",
                                  "yard.json"));
    const std::string second = "/all/car/wheel@2", hub = second + "/hub.r", tub = "/all/car/tub.r";
    const Matrix slide = test::moved(0.25, 0, 0.5);
    const Model painted = Edit(model).set_state(tub, State::hidden).set_color(hub, {1, 0, 0}).commit();
    const Model moved = Edit(painted).move(second, slide).commit();
    CHECK(&moved.solids()[0] == &model.solids()[0]);  // it was not compiled anew
    CHECK(moved.matrix_of(second) == test::moved(70.25, 80, 90.5));
    CHECK(moved.placement_of(hub + "/ball") == test::moved(70.25, 80, 90.5));
    const Model again = Edit(moved).move(second, slide).set_color(hub, {0, 1, 0}).commit();
    CHECK(&again.solids()[0] == &model.solids()[0]);
    CHECK(again.matrix_of(second) == test::moved(70.5, 80, 91));
    CHECK(again.scene().find("wheel~2") == nullptr);
    CHECK(painted.matrix_of(second) == test::moved(70, 80, 90));
    const Model twice = Edit(painted).move(second, slide).move(second, slide).commit();
    CHECK(twice.placement_of(hub) == again.placement_of(hub));

    const Model less = Edit(again).remove("/all/car/wheel").commit();
    CHECK(paths(less) == std::vector<std::string>{"/all/ends.r", hub, second + "/rim.r", tub});
    CHECK(less.region(hub) == 1);
    CHECK(less.children("/all/car").size() == 2);
    CHECK(less.children("/all/car").at(0).path == second);
    CHECK(less.matrix_of(second) == again.matrix_of(second));
    CHECK(less.matrix_of("/all/car/wheel") == Model(less.scene()).matrix_of("/all/car/wheel"));
    CHECK(at(less, tub).state == State::hidden);
    const Model shown = Edit(less).set_state(tub, State::shown).set_color(tub, {0, 0, 1}).commit();
    CHECK(at(shown, hub).color == Vec3{0, 1, 0});
    const Model last = Edit(less).move("/all/car/wheel", slide).commit();
    CHECK(last.matrix_of(second) == test::moved(70.75, 80, 91.5));
    const Model back = Edit(less).add("/all/car", Operator::union_, "wheel").commit();
    CHECK(back.regions().size() == model.regions().size());
    for (const Model& next : {moved, again, twice, less, shown, last, back}) require_compiled_anew(next);

    // A member above a rendered path moves what is rendered; without it the path leads nowhere.
    const std::vector<std::string> roots{"ends.r", second};
    const Model rooted(model.scene(), roots);
    const Model driven = Edit(rooted).move("/all/car", slide).commit();
    CHECK(&driven.solids()[0] == &rooted.solids()[0]);
    CHECK(driven.placement_of(second) == moved.placement_of(second));
    require_same_models(driven, Model(driven.scene(), roots));
    CHECK(refusal([&] {
              static_cast<void>(Edit(driven).remove("/all/car").commit());
          }).find("'all' has no member 'car'") != std::string::npos);
}

TEST_CASE("top objects have places, with the bits of members", "[promise:edits]") {
    const Matrix turn{0, -1, 0, 7, 1, 0, 0, 60, 0, 0, 1, 5, 0, 0, 0, 1}, slide = test::moved(3, 4, 5);
    const Model model = wheels(), placed = Edit(model).set_matrix("all", turn).commit();
    CHECK(placed.matrix_of("/all") == turn);
    CHECK(placed.placement_of("/all/wheel@2") == compose(turn, test::moved(60, 0, 0)));
    CHECK(paths(placed) == paths(model));
    // The same below a combination.
    Scene around = model.scene();
    around.objects.emplace_back(Combination{.name = "around", .tree = tree("all", turn)});
    const Model member(around);
    const std::vector<Ray> rays = test::random_rays(placed.bounds(), 60);
    Partitions one, other;
    placed.partitions(rays, one, all_fields);
    member.partitions(rays, other, all_fields);
    CHECK(one.t_in.size() > 20);
    for (std::size_t i = 0; i < rays.size(); ++i) REQUIRE(same_rows(one, i, other, i));
    for (const char* root : {"all/wheel@2", "/all"})  // a path from a top object has its place, too
        CHECK(at(Model(placed.scene(), {root}), "/all/wheel@2/hub.r").bounds.low ==
              at(placed, "/all/wheel@2/hub.r").bounds.low);

    const std::string text_of_placed = json_scene_text(placed.scene());
    CHECK(text_of_placed.find(R"("objects": [{"object": "all", "matrix": [)") != std::string::npos);
    CHECK(Model(parse_scene(text_of_placed, "placed.json")).matrix_of("all") == turn);
    const Model moved = Edit(placed).move("/", slide).move("/all", slide).commit();
    CHECK(moved.matrix_of("all") == compose(slide, compose(slide, turn)));
    const Model back = Edit(placed).set_matrix("all", identity).commit();
    CHECK(json_scene_text(back.scene()) ==
          json_scene_text(Edit(model).set_matrix("/all/wheel", identity).commit().scene()));
    const Model two = Edit(placed).add_top("hull.r", slide).commit();
    CHECK(at(two, "/hull.r").bounds.high == Vec3{21, 22, 23});
    CHECK(Edit(two).remove("hull.r").commit().matrix_of("all") == turn);
    const Model named = Edit(Model(model.scene(), {"/all/wheel@3", "hull.r"})).move("/", slide).commit();
    CHECK(named.matrix_of("hull.r") == slide);
    CHECK(named.placement_of("/all/wheel@3") == compose(slide, test::moved(0, 60, 0)));
    for (const Model& next : {placed, moved, two}) require_compiled_anew(next);

    Scene wrong = placed.scene();
    wrong.top_matrices.push_back(identity);
    CHECK(refusal([&] { Model{wrong}; }).find("/objects: there are 2 places for 1 top objects") != std::string::npos);
    CHECK(refusal([&] { static_cast<void>(json_scene_text(wrong)); }).find("other places") != std::string::npos);
    wrong.top.push_back("all");
    CHECK(refusal([&] { Model{wrong}; }).find("'all' is rendered in two places") != std::string::npos);
    wrong.top = {"/all"};
    wrong.top_matrices = {turn};
    CHECK(refusal([&] { Model{wrong}; }).find("the top object '/all' is a path") != std::string::npos);
    wrong.top = {"all", "/all/wheel"};
    wrong.top_matrices.push_back(identity);
    CHECK(refusal([&] { Model{wrong}; }).find("the top object '/all/wheel' is a path") != std::string::npos);
    wrong.top = {"all"};
    wrong.top_matrices = {Matrix{}};
    CHECK(refusal([&] { Model{wrong}; }).find("/objects/0: the matrix of 'all' must end in the row") !=
          std::string::npos);
}

TEST_CASE("what was removed is brought back, and what is erased leaves its names free", "[promise:edits]") {
    const Model model = wheels();
    const Combination lamp{.name = "lamp", .tree = tree("bulb") | tree("ball"), .region = true};
    const Solid bulb{"bulb", Ell{{}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, {}};
    const Model lit = Edit(model).add(bulb).add(lamp, true).commit();
    const Model dark = Edit(lit).remove("lamp").commit();
    CHECK(refusal([&] { Edit(dark).add(lamp, true); }) ==
          "the scene has an object 'lamp' already\n  add_top() renders it, replace() gives a solid another shape, "
          "erase() "
          "deletes it; or take another name");
    const Model again = Edit(dark).add_top("lamp", test::moved(0, 0, 99)).commit();
    CHECK(again.placement_of("lamp/bulb") == test::moved(0, 0, 99));
    require_compiled_anew(again);
    for (const Model& from : {again, dark}) {  // with what only it used, and in one edit with its return
        const Model erased = Edit(from).erase("lamp").commit();
        CHECK(erased.scene().find("bulb") == nullptr);
        CHECK(erased.scene().find("ball") != nullptr);
        CHECK(paths(erased) == paths(model));
        CHECK(paths(Edit(from).erase("lamp").add(bulb).add(lamp, true).commit()) == paths(lit));
    }
    CHECK(Edit(model).erase("/all/hull.r").commit().scene().find("tub") == nullptr);
    Edit edit(model);
    CHECK(refusal([&] { edit.erase("/all/wheel@2"); }) ==
          "'wheel' has other uses: 'all', 'all'\n  remove() takes it away here alone, and leaves the object");
    CHECK(refusal([&] { edit.erase("ball"); }).starts_with("'ball' has other uses: 'hub.r', 'rim.r', 'hull.r'"));
    CHECK(refusal([&] { edit.erase("all"); }) == "'all' is all that is rendered");
    CHECK(refusal([&] { Edit(lit).add_top("lamp"); }) ==
          "'lamp' is rendered already\n  set_matrix() gives it another place");
    CHECK(refusal([&] { edit.add_top("whel"); }) == "the scene has no object 'whel'\n  did you mean 'wheel'?");
    CHECK(refusal([&] {
              Edit(Edit(model).add_top("hull.r").commit()).erase("/all/hull.r");
          }).starts_with("'hull.r' has other uses: the list of what is rendered"));
    require_same_models(edit.commit(), model);
}

TEST_CASE("a solid is replaced by a moved one, again and again", "[promise:edits]") {
    const Model model = wheels();
    const Ell small{{}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
    const Model once = Edit(model).replace("ball", small, test::moved(5, 0, 0)).commit();
    const Model twice = Edit(once).replace("ball", small, test::moved(6, 0, 0)).commit();
    CHECK(paths(twice) == paths(model));
    CHECK(at(once, "/all/wheel@2/hub.r").bounds.high.x == 67);
    CHECK(at(twice, "/all/wheel@2/hub.r").bounds.high.x == 68);
    CHECK(twice.scene().objects.size() == once.scene().objects.size());
    const Model bare = Edit(model).add(Solid{"bare", small, {}}, true).commit();  // rendered without a region around
    const Model moved = Edit(bare).replace("bare", small, test::moved(5, 0, 0)).commit();
    CHECK(paths(moved) == paths(bare));
    CHECK(at(moved, "/bare").bounds.high.x == 7);
    CHECK(at(moved, "/bare").material_id == at(bare, "/bare").material_id);
    for (const Model& next : {once, twice, moved}) require_compiled_anew(next);
}

TEST_CASE("the path '/' is all", "[promise:edits]") {
    const Model model = Edit(wheels()).add_top("hull.r").commit();
    const Model alone = Edit(model).set_state("/", State::hidden).set_state("/all/wheel@2", State::shown).commit();
    for (const RegionInfo& region : alone.regions())
        CHECK((region.state == State::shown) == region.path.starts_with("/all/wheel@2/"));
    const Model red = Edit(alone).set_color("/", {1, 0, 0}).set_finish("/", {.shine = 3}).commit();
    for (const RegionInfo& region : red.regions()) {
        CHECK(region.color == Vec3{1, 0, 0});
        CHECK(region.finish.shine == 3);
    }
    for (const Model& next : {alone, red}) require_compiled_anew(next);
    const Model read(parse_scene(json_scene_text(red.scene()), "red.json"));
    CHECK(at(read, "/hull.r").state == State::hidden);
    CHECK(at(read, "/all/wheel@2/hub.r").color == Vec3{1, 0, 0});
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

TEST_CASE("instances of one object are rendered side by side, and one of them is taken away", "[promise:edits]") {
    const Model two(wheels().scene(), {"all/wheel", "/all/wheel@2/"});
    CHECK(two.warnings().empty());
    CHECK(paths(two) ==
          std::vector<std::string>{"/all/wheel/hub.r", "/all/wheel/rim.r", "/all/wheel@2/hub.r", "/all/wheel@2/rim.r"});
    const Model one = Edit(two).remove("/all/wheel").commit();
    CHECK(paths(one) == std::vector<std::string>{"/all/wheel@2/hub.r", "/all/wheel@2/rim.r"});
    require_same_models(one, Model(one.scene(), {"all/wheel@2"}));
    CHECK(Model(wheels().scene(), {"all/wheel@2", "/all/wheel@2"}).warnings().size() == 1);
}

TEST_CASE("what cannot be is refused with the place, and changes nothing", "[promise:edits]") {
    const Model model = wheels();
    Edit edit(model);
    CHECK(refusal([&] { edit.set_matrix("/all/weel/hub.r", identity); }).find("'all' has no member 'weel'") !=
          std::string::npos);
    CHECK(refusal([&] { edit.set_matrix("wheel", identity); }) ==
          "'wheel' is neither rendered by this name nor a leg of a combination\n  give the path that leads to it");
    CHECK(refusal([&] { edit.remove("wheel"); }) ==
          "'wheel' is no leg of a combination\n  give the path that leads to it");
    CHECK(refusal([&] { edit.replace("wheel", Ell{}); }) == "'wheel' is a combination: it has no numbers of its own");
    CHECK(refusal([&] { edit.add(Solid{"ball", Ell{}, {}}); }).starts_with("the scene has an object 'ball' already"));
    CHECK(refusal([&] { edit.add("ball", Operator::union_, "box"); }) == "'ball' is a solid: it has no legs");
    CHECK(refusal([&] { edit.remove("/"); }) == "'/' is all, not one object\n  give the path of one");
    CHECK(refusal([&] { edit.remove("/all"); }) == "'/all' is all that is rendered");
    CHECK(refusal([&] {
              static_cast<void>(Edit(model).set_color("/all/x", {}).commit());
          }).starts_with("the model has no region at '/all/x', nor below it"));
    CHECK(refusal([&] {
              static_cast<void>(Edit(model).set_color("/all/weel/hub.r", {}).commit());
          }).find("did you mean '/all/wheel/hub.r'?") != std::string::npos);
    CHECK(refusal([&] { edit.set_state("", State::hidden); }) == "the path '' names nothing");
    CHECK(refusal([&] {
              edit.set_color("/all", {2, 0, 0});
          }).find("a colour has components from 0 to 1") != std::string::npos);
    CHECK(refusal([&] { edit.set_finish("/all", {.shine = -1}); }).find("'shine' must be from 0") != std::string::npos);
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
            } catch (const std::exception&) {  // the model is as before
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
            } catch (const std::exception&) {
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
        for (int i = 0; i < test::tries(60) || pictures == 0; ++i) {
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
