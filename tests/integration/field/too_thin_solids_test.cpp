// A solid so thin that its own two faces are one surface is named, with its thickness and the limit.
#include "catch.hpp"

#include <string>
#include <vector>

#include "integration/field/judge.hpp"
#include "scene/warning_texts.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

std::vector<std::string> notes_of(Shape shape, const Matrix& matrix = identity) {
    Builder to("film", 1, 1);
    to.region(leaf(to.solid(std::move(shape)), matrix));
    to.region(leaf(to.solid(box({0, 0, -0.5}, {100, 100, 0}))));
    const StressScene made = to.take();
    Renderer renderer(made.scene, made.objects, test::on_reference());
    return test::texts(renderer.model().warnings());
}
bool says(const std::vector<std::string>& notes, const std::string& part) {
    return notes.size() == 1 && notes.front().find(part) != std::string::npos;
}

/// A box of 100 x 100 mm of that thickness.
Arb film(double thickness) { return box({0, 0, 0}, {100, 100, thickness}); }

}  // namespace

TEST_CASE("a film whose two faces are one surface is named", "[field][promise:coincidence]") {
    CHECK(says(notes_of(film(1e-8)),
               "s0: nothing is left of it: two of its faces are 1e-08 mm apart, and faces within 1.4142"));
    CHECK(says(notes_of(film(1e-8)), "e-08 mm, 1e-10 of its size, are one surface"));
    CHECK(says(notes_of(film(1), scaling(1e-9)), "s0: nothing is left of it") == false);  // small, and not thin
    CHECK(says(notes_of(cylinder({3, 4, 0}, {0, 0, 1e-9}, 50)), "two of its faces are 1e-09 mm apart"));
    CHECK(says(notes_of(film(1), Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1e-9, 7, 0, 0, 0, 1}), "1e-09 mm apart"));
    // However it lies in space.
    Random random(3);
    for (int i = 0; i < 20; ++i) {
        const Matrix turn = rotation(random);
        CHECK(says(notes_of(film(1e-9), turn), "s0: nothing is left of it"));
        CHECK(notes_of(film(1e-6), turn).empty());
        CHECK(says(notes_of(cylinder({3, 4, 0}, {0, 0, 1e-9}, 50), turn), "s0: nothing is left of it"));
        CHECK(notes_of(cylinder({3, 4, 0}, {0, 0, 1e-6}, 50), turn).empty());
    }
}

TEST_CASE("what is noted as gone is met by no ray, and what is not noted is met", "[field][promise:coincidence]") {
    Random random(5);
    std::size_t gone = 0, there = 0;
    for (int i = 0; i < 60; ++i) {
        Builder to("film", static_cast<std::uint64_t>(i), 1);
        const double thickness = random.power_of_ten(-9, -5);
        const Matrix turn = rotation(random);
        to.region(leaf(to.solid(film(thickness)), turn));
        const StressScene made = to.take();
        Settings settings = test::on_reference();
        settings.tolerance_rule = Tolerance::surfaces;
        Renderer renderer(made.scene, made.objects, settings);
        const auto answer = renderer.shoot({{moved_point(turn, {50, 50, 10}), moved_direction(turn, {0, 0, -1})}});
        CHECK(answer.front().partitions.empty() ==
              says(test::texts(renderer.model().warnings()), "s0: nothing is left of it"));
        ++(renderer.model().warnings().empty() ? there : gone);
    }
    CHECK(gone > 10);
    CHECK(there > 10);
}

TEST_CASE("of many films the first few are named, and the others counted", "[field]") {
    Builder to("films", 1, 1);
    for (int i = 0; i < 9; ++i) to.region(leaf(to.solid(film(1e-9)), translation({0, 0, 3.0 * i})));
    const StressScene made = to.take();
    const std::vector<std::string> notes =
        test::texts(Renderer(made.scene, made.objects, test::on_reference()).model().warnings());
    REQUIRE(notes.size() == 6);
    CHECK(notes.back() == "nothing is left of 4 more such solids");
}

TEST_CASE("a shell between two solids that became one is named, with both", "[field]") {
    Random random(7);
    const auto larger = [](int kind, double by) -> Shape {
        const double r = 20 * (1 + by), z = 15 * (1 + by);
        if (kind == 0) return Ell{{0, 0, 0}, {r, 0, 0}, {0, r, 0}, {0, 0, r}};
        if (kind == 1) return cylinder({0, 0, -z}, {0, 0, 2 * z}, r);
        if (kind == 2) return Tor{{0, 0, 0}, {0, 0, 1}, 30, 0.5 * r};
        return box({-z, -z, -z}, {z, z, z});
    };
    for (int kind = 0; kind < 4; ++kind)
        for (const double by : {0.0, 3e-11, 1e-8}) {
            const Matrix turn = rotation(random);
            const auto notes_and_hits = [&](double outer, double inner) {
                Builder to("shell", 1, 1);
                const std::string a = to.solid(larger(kind, outer)), b = to.solid(larger(kind, inner));
                to.region(operate(Operator::difference, {leaf(a, turn), leaf(b, turn)}));
                to.region(leaf(to.solid(box({90, 0, 0}, {100, 1, 1}))));
                const StressScene made = to.take();
                Settings settings = test::on_reference();
                settings.tolerance_rule = Tolerance::surfaces;
                Renderer renderer(made.scene, made.objects, settings);
                const Ray ray{moved_point(turn, {28, 3, -100}), moved_direction(turn, {kind == 2 ? 0 : -0.28, 0, 1})};
                return std::pair(test::texts(renderer.model().warnings()),
                                 renderer.shoot({ray}).front().partitions.size());
            };
            CAPTURE(kind, by);
            const auto [notes, hits] = notes_and_hits(by, 0);
            CHECK(says(notes, "s0: nothing is left between it and 's1', which is removed from it: they are ") ==
                  (by == 3e-11));
            CHECK(notes.empty() == (by != 3e-11));
            CHECK(hits == (by == 1e-8 ? 2 : 0));
            CHECK(notes_and_hits(0, by).first.empty());  // the larger one is removed: nothing is left anyway
        }
}
