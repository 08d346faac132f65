// Chains of edits: after each, the Model is the one that is compiled from its scene, numbers and tables included.
#include <csgrt/edit.hpp>

#include <thread>

#include "catch.hpp"
#include "compile/random_parts.hpp"
#include "render/same_models.hpp"
#include "sanitized.hpp"

using namespace csgrt;
using namespace csgrt::test;

namespace {

struct Tally {
    int commits = 0, refused = 0, in_part = 0, returns = 0;
};

class Chain : RandomParts {
public:
    using RandomParts::RandomParts;

    void go(int steps, Tally& tally) {
        Model model(scene());
        std::vector<Model> earlier{model};
        for (int i = 0; i < steps; ++i) {
            Edit edit(model);
            try {
                const bool is_one = below(3) > 0;
                if (!is_one) edit_some(edit, model);
                Chain same(*this);
                edit_some(edit, model);
                const Model next = edit.commit();
                require_compiled_anew(next);
                if (is_one && below(3) == 0) {  // the same edit of the scene with all earlier edits
                    Edit other(Model(model.scene()));
                    same.edit_some(other, model);
                    require_same_models(next, other.commit());
                }
                ++tally.commits;
                tally.in_part += &next.solids()[0] == &model.solids()[0];
                if (below(4) == 0) go_far_and_back(next, tally);
                model = next;
            } catch (const std::exception&) {  // the model is as before
                ++tally.refused;
                continue;
            }
            earlier.push_back(model);
            if (below(5) == 0) model = earlier[below(earlier.size())];  // undo; it may go on elsewhere
        }
    }

private:
    std::string some_path(const Model& model) {
        std::string path = model.regions()[below(model.regions().size())].path;
        if (below(2) == 0) path = path.substr(0, path.find('/', 1 + below(path.size())));
        if (const auto children = model.children(path); !children.empty() && below(3) == 0)
            path = children[below(children.size())].path;
        return path;
    }

    void edit_some(Edit& edit, const Model& model) {
        const std::string path = some_path(model);
        const Edit::Share share = below(2) ? Edit::Share::alone : Edit::Share::all;
        switch (below(14)) {
            case 0:
                edit.set_color(path, {1, 0.5, 0});
                break;
            case 1:
                edit.set_state(path, static_cast<State>(below(3)));
                break;
            case 2:
                edit.replace(model.solids()[below(model.solids().size())].name, some_solid().shape,
                             below(2) ? some_matrix() : identity);
                break;
            case 3:
                edit.add(path, below(3) ? Operator::union_ : Operator::difference,
                         model.solids()[below(model.solids().size())].name, some_matrix());
                break;
            case 4:
                edit.add(path, Operator::union_, "g" + std::to_string(below(3)), some_matrix());
                break;
            case 5:
            case 6:
                edit.remove(path);
                break;
            case 7:
                edit.add_top(model.children(path).at(0).object, some_matrix());
                break;
            case 8:
                edit.set_matrix(path, model.matrix_of(some_path(model)), share);
                break;
            case 9:
            case 10:
                edit.set_matrix(path, some_matrix(), share);
                break;
            default:
                edit.move(path, moved(0.5 * below(5) - 1, 0.5 * below(5) - 1, 0), share);
        }
    }

    /// Drags a part out of the model's sphere, and puts it back.
    void go_far_and_back(const Model& model, Tally& tally) {
        const std::string path = some_path(model);
        const Model far = Edit(model).set_matrix(path, moved(300, 0, 0)).commit();
        require_compiled_anew(far);
        const Model back = Edit(far).set_matrix(path, model.matrix_of(path)).commit();
        require_compiled_anew(back);
        ++tally.returns;
    }
};

void go(int chains, int steps) {
    Tally tally;
    for (int seed = 0; seed < chains; ++seed) {
        INFO("chain " << seed);
        Chain(static_cast<unsigned>(seed)).go(steps, tally);
    }
    CAPTURE(tally.commits, tally.refused, tally.in_part, tally.returns);
    if (sanitized) return;  // too few chains to count
    CHECK(tally.commits > 2 * tally.refused);
    CHECK(20 * tally.in_part > tally.commits);
    CHECK(10 * tally.returns > tally.commits);
}

/// The scene of a ball at the origin and of `more`, between corners that keep the model's extent.
Scene between_corners(const std::vector<Object>& more) {
    Scene scene;
    scene.objects = {ball("far", {-40, -40, -40}), ball("farther", {40, 40, 40}), ball("ball", {0, 0, 0}),
                     region("corners", {leg("far"), leg("farther"), op(Operator::union_, 2)})};
    scene.objects.insert(scene.objects.end(), more.begin(), more.end());
    return scene;
}

}  // namespace

TEST_CASE("chains of edits end in the models that are compiled from their scenes", "[promise:edits]") {
    go(tries(16), 10);
}

TEST_CASE("chains of edits end in the models that are compiled from their scenes: 1,000 chains", "[.long]") {
    go(1000, 16);
}

TEST_CASE("an added part is dragged without compiling the scene again", "[promise:edits]") {
    Scene scene = between_corners({group("all", {leg("corners"), leg("ball"), op(Operator::union_, 2)})});
    const Model start = Edit(Model(scene)).add(Object(ball("lamp", {3, 0, 0})), true).commit();
    Model model = start;
    for (int i = 0; i < 6; ++i) {
        const Model& from = i % 2 ? model : start;
        const Model next =
            Edit(from).set_matrix("/lamp", moved(i - 3, 0.5 * i, 0)).move("lamp", moved(0, 0, 1)).commit();
        CHECK(&next.solids()[0] == &model.solids()[0]);
        CHECK(next.matrix_of("/lamp") == moved(i - 3, 0.5 * i, 1));
        CHECK(next.scene().top_matrices == std::vector{identity, moved(i - 3, 0.5 * i, 1)});
        require_compiled_anew(next);
        model = next;
    }
    // An object that the caller names moves by itself, and not where a combination uses it.
    const std::vector<std::string> objects{"all", "corners"};
    model = Model(scene, objects);
    for (int i = 1; i < 4; ++i) {
        model = Edit(model).move("corners", moved(0, 0, -0.25 * i)).commit();
        require_same_models(model, Model(model.scene(), objects));
    }
    // Places need names: a scene whose top is a path has none.
    scene.top = {"corners", "all/ball"};
    CHECK_THROWS_AS(Edit(Model(scene)).set_matrix("corners", moved(0, 0, 1)).commit(), Error);
}

TEST_CASE("an object that loses its last solid gets a warning", "[promise:edits]") {
    const Scene scene =
        between_corners({group("none", {}), group("some", {leg("none"), leg("ball"), op(Operator::union_, 2)})});
    require_compiled_anew(Edit(Model(scene)).remove("/some/ball").commit());
}

TEST_CASE("one of several instances moves without compiling the scene again", "[promise:edits]") {
    Scene scene =
        between_corners({region("a", {leg("ball")}), region("b", {leg("ball", moved(0, 5, 0))}),
                         group("g", {leg("a"), leg("b"), op(Operator::union_, 2)}),
                         group("all", {leg("corners"), leg("g"), leg("g", moved(9, 0, 0)), op(Operator::union_, 3)})});
    const Model start(scene);
    const Matrix matrix = moved(0, 0.5, 0);
    const Model next = Edit(start).move("/all/g@2/a", moved(0, 0.25, 0)).move("/all/g@2/a", moved(0, 0.25, 0)).commit();
    CHECK(&next.solids()[0] == &start.solids()[0]);
    CHECK(next.matrix_of("/all/g@2/a") == matrix);
    CHECK(next.matrix_of("/all/g/a") == identity);
    CHECK(next.children("/all").at(2).object == "g~2");
    CHECK(start.scene().find("g~2") == nullptr);
    require_compiled_anew(next);
    const Model back = Edit(next).set_matrix("/all/g@2/a", identity).commit();
    CHECK(&back.solids()[0] == &next.solids()[0]);
    require_same_models(back, start);

    // Later edits of all instances leave the other alone.
    const Model other = Edit(next).set_matrix("/all/g/a", moved(0, 0, 1), Edit::Share::all).commit();
    CHECK(other.matrix_of("/all/g@2/a") == matrix);
    CHECK(other.matrix_of("/all/g/a") == moved(0, 0, 1));
    const Model sibling = Edit(next).set_matrix("/all/g@2/b", matrix, Edit::Share::all).commit();
    CHECK(sibling.matrix_of("/all/g@2/b") == matrix);
    CHECK(sibling.matrix_of("/all/g/b") == identity);
    const Model fewer = Edit(next).remove("/all/g/b").commit();
    CHECK(fewer.region("/all/g/b") == -1);
    CHECK(fewer.region("/all/g@2/b") >= 0);
    // An edit of one instance after a removal from all instances keeps the removal.
    const Model after = Edit(Edit(start).remove("/all/g/b").commit()).move("/all/g@2/a", matrix).commit();
    CHECK(after.regions().size() == 3);
    CHECK(after.scene().find("g~2") != nullptr);
    for (const Model& model : {other, sibling, fewer, after}) require_compiled_anew(model);
}

TEST_CASE("a Model from before an edit that compiled the scene anew is edited in part", "[promise:edits]") {
    Scene scene = between_corners(
        {region("a", {leg("ball")}), region("b", {leg("ball")}), region("c", {leg("ball", moved(9, 0, 0))}),
         group("all", {leg("corners"), leg("a"), leg("b"), leg("c"), op(Operator::union_, 4)})});
    const Model start(scene);
    for (int i = 1; i < 4; ++i) {
        Edit edit(start);
        edit.move("/all/a", moved(0, i, 0));  // two instances become of one
        if (i == 2) edit.add("all", Operator::union_, "ball", moved(0, 0, i));
        const Model anew = edit.commit();
        CHECK(&anew.solids()[0] != &start.solids()[0]);
        require_compiled_anew(anew);
        for (const Model& from : {start, anew}) {
            const Model next = Edit(from).move("/all/c", moved(0, 0, i)).commit();
            CHECK(&next.solids()[0] == &from.solids()[0]);
            require_compiled_anew(next);
        }
    }
}

TEST_CASE("threads that edit one model at once get the models that are compiled from their scenes", "[promise:edits]") {
    const Model start(parse_scene(R"({"csgrt": 1,
        "solids": {"far": {"type": "sphere", "center": [-40, -40, -40], "radius": 1},
                   "farther": {"type": "sphere", "center": [40, 40, 40], "radius": 1},
                   "box": {"type": "box", "low": [-1, -2, -3], "high": [1, 2, 3]}},
        "combinations": {
            "corners.r": {"region": true, "tree": {"union": ["far", "farther"]}},
            "box.r": {"region": true, "tree": "box"},
            "all": {"tree": {"union": ["corners.r", "box.r", {"object": "box.r", "translate": [9, 0, 0]}]}}}})",
                                  "boxes.json"));
    std::vector<std::vector<Model>> made(3);
    std::vector<std::thread> threads;
    for (std::vector<Model>& mine : made)
        threads.emplace_back([&] {
            Model model = start;
            for (int i = 0; i < 20; ++i) {
                const double x = static_cast<double>(&mine - made.data()) + 0.5;
                model = Edit(model).move(i % 3 == 0 ? "/all/box.r" : "/all/box.r@2", moved(0, x, 0.25)).commit();
                mine.push_back(model);
                if (i % 7 == 6) model = start;
            }
        });
    for (std::thread& thread : threads) thread.join();
    for (const std::vector<Model>& some : made)
        for (const Model& model : some) require_compiled_anew(model);
}
