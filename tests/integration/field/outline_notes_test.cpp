// The warning that nothing is left of a solid is true: it is given of an extruded outline whose ends are one surface,
// and of none whose walls merely share a plane (sides of length 0, spurs, shared corners, holes on the outline, cells).
#include "catch.hpp"

#include "integration/field/judge.hpp"
#include "scene/warning_texts.hpp"
#include "stress/build.hpp"

using namespace csgrt;
using namespace csgrt::stress;

namespace {

struct Outline {
    Sketch sketch;
    Sketch::Point inside;  ///< a point well within what it encloses

    void ring(const std::vector<Sketch::Point>& corners) {
        const auto first = static_cast<std::uint32_t>(sketch.vertices.size()),
                   count = static_cast<std::uint32_t>(corners.size());
        sketch.vertices.insert(sketch.vertices.end(), corners.begin(), corners.end());
        for (std::uint32_t i = 0; i < count; ++i)
            sketch.curves.push_back(Sketch::Line{first + i, first + (i + 1) % count});
    }
};

constexpr std::size_t forms = 7;

/// Rectangles, and what is wrong with them.
Outline outline(std::size_t form, Random& random) {
    const double a = random.whole(4, 9), b = random.whole(4, 9), x = random.whole(1, 3), y = random.whole(1, 3);
    Outline o;
    o.inside = {0.3, 0.35};
    switch (form) {
        case 0:  // a side of length 0
            o.ring({{0, 0}, {a, 0}, {a, 0}, {a, b}, {0, b}});
            break;
        case 1:  // a spur outward
            o.ring({{0, 0}, {a, 0}, {a, y}, {a + x, y}, {a, y}, {a, b}, {0, b}});
            break;
        case 2:  // a spur along a side
            o.ring({{0, 0}, {a, 0}, {a, b}, {a, b + x}, {a, b}, {0, b}});
            break;
        case 3:  // two that share a corner
            o.ring({{0, 0}, {a, 0}, {a, b}, {0, b}});
            o.ring({{a, b}, {a + x, b}, {a + x, b + y}, {a, b + y}});
            break;
        case 4:  // a hole with a side on the outline
            o.ring({{0, 0}, {a, 0}, {a, b}, {0, b}});
            o.ring({{x, 0}, {x, y}, {x + 0.5, y}, {x + 0.5, 0}});
            break;
        case 5:  // a hole that touches a corner of it
            o.ring({{0, 0}, {a, 0}, {a, b}, {0, b}});
            o.ring({{a, b}, {a - x, b}, {a - x, b - y}, {a, b - y}});
            break;
        default:  // a stair back to a wall's own line
            o.ring({{0, 0}, {x, 0}, {x, y}, {x + 1, y}, {x + 1, -1}, {a + x, -1}, {a + x, b}, {0, b}});
            break;
    }
    return o;
}

Ebm checkers(Random& random) {
    Ebm ebm;
    ebm.width = 5, ebm.depth = 4;
    for (std::uint32_t i = 0; i < 20; ++i) ebm.cells.push_back((i % 5 + i / 5) % 2 == 0 || random.below(4) == 0);
    ebm.height = 1;
    return ebm;
}

struct Told {
    bool met = false, noted = false;
};

Told told_of(Shape shape, const Matrix& place, const Ray& ray) {
    Builder to("outline", 1, 1);
    to.region(leaf(to.solid(std::move(shape)), place));
    const StressScene made = to.take();
    Settings settings = test::on_reference();
    settings.tolerance_rule = Tolerance::surfaces;
    Renderer renderer(made.scene, made.objects, settings);
    Told told;
    told.met = !renderer.shoot({{moved_point(place, ray.origin), moved_direction(place, ray.direction)}})
                    .front()
                    .partitions.empty();
    for (const std::string& text : test::texts(renderer.model().warnings()))
        told.noted = told.noted || text.find("nothing is left of it") != std::string::npos;
    return told;
}

void check_notes(std::uint64_t seed, int count) {
    Random random(seed);
    std::size_t gone = 0;
    for (int i = 0; i < count; ++i) {
        const Matrix place = i % 2 == 0 ? identity : rotation(random);
        const double height = random.below(3) == 0 ? random.power_of_ten(-15, -11) : random.between(0.1, 5);
        const std::size_t form = static_cast<std::size_t>(i) % (forms + 1);
        Told told;
        if (form == forms) {
            Ebm ebm = checkers(random);
            ebm.height = height;
            told = told_of(ebm, place, {{0.3, 0.35, -3}, {0.01, 0.02, 1}});
        } else {
            const Outline o = outline(form, random);
            Extrude solid;
            solid.a = {1, 0, 0}, solid.b = {0, 1, 0}, solid.h = {0, 0, height};
            solid.sketch = o.sketch;
            told = told_of(solid, place, {{o.inside.u, o.inside.v, -3}, {0.01, 0.02, 1}});
        }
        INFO("seed " << seed << ", " << i << ": form " << form << ", height " << height);
        CHECK(told.noted == !told.met);
        CHECK(told.met == (height > 1e-3));
        gone += told.noted;
    }
    CHECK(gone * 8 > static_cast<std::size_t>(count));
}

}  // namespace

TEST_CASE("an extruded outline is said to be gone if, and only if, it is", "[field]") { check_notes(1, 160); }
TEST_CASE("an extruded outline is said to be gone if, and only if, it is, 10^5 of them", "[.long]") {
    for (std::uint64_t seed = 10; seed < 110; ++seed) check_notes(seed, 1000);
}
