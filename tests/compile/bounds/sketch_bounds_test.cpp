// Boxes of solids that outlines make: around points of their curves by definition, and no wider.
#include "catch.hpp"

#include <cmath>

#include "compile/bounds/bounds.hpp"
#include "compile/linear.hpp"
#include "compile/solids/axis_frame.hpp"
#include "oracle/profiles.hpp"
#include "oracle/revolved.hpp"
#include "scene/solids/sketch_extent.hpp"

using namespace csgrt;

namespace {

/// Many points of a sketch's curves.
std::vector<oracle::QVec> points_of(const Sketch& sketch, int steps = 2000) {
    using namespace oracle;
    std::vector<QVec> points;
    const Outline outline(sketch);
    std::vector<Outline::Rational> rationals = outline.spans();
    for (const Sketch::Curve& curve : sketch.curves) {
        if (const auto* bezier = std::get_if<Sketch::Bezier>(&curve))
            rationals.push_back(Outline::bezier(sketch, *bezier));
        if (const auto* line = std::get_if<Sketch::Line>(&curve)) {
            points.push_back(Outline::point(sketch, line->start));
            points.push_back(Outline::point(sketch, line->end));
        }
        if (const auto* arc = std::get_if<Sketch::Arc>(&curve)) {
            const auto circle = Outline::circle(sketch, *arc);
            const double r = to_double(circle.radius);
            for (int i = 0; i < steps; ++i) {
                const double angle = 6.283185307179586 * i / steps;
                const QVec p = circle.center + QVec{r * std::cos(angle), r * std::sin(angle), 0};
                if (Outline::on_arc(sketch, *arc, p)) points.push_back(p);
            }
            points.push_back(Outline::point(sketch, arc->start));
            if (arc->radius > 0) points.push_back(Outline::point(sketch, arc->end));
        }
    }
    for (const auto& r : rationals)
        for (int i = 0; i <= steps; ++i) {
            const quad t = r.low + (r.high - r.low) * i / steps, w = value_at(r.w, t);
            points.push_back({value_at(r.x, t) / w, value_at(r.y, t) / w, 0});
        }
    return points;
}

void check_tight(const Box& box, const Box& surface, double slack) {
    const auto check = [&](double outer, double inner) {
        CHECK(outer >= inner - 1e-13);
        CHECK(outer <= inner + slack);
    };
    check(-box.low.x, -surface.low.x), check(-box.low.y, -surface.low.y), check(-box.low.z, -surface.low.z);
    check(box.high.x, surface.high.x), check(box.high.y, surface.high.y), check(box.high.z, surface.high.z);
}

}  // namespace

TEST_CASE("bounds: the box of an extrusion is tight") {
    oracle::Random random(5);
    for (std::size_t form = 0; form < oracle::sketch_form_count; ++form) {
        INFO(oracle::sketch_forms[form]);
        if (std::string(oracle::sketch_forms[form]) == "flat arcs") continue;  // sampled circles of a million sizes
        Extrude shape;
        shape.v = {1, 2, 3}, shape.a = {1, 0.2, 0}, shape.b = {0, 0.7, 0.3}, shape.h = {0.1, -0.2, 2};
        shape.sketch = oracle::SketchMaker(random).make(form);
        Box surface = empty_box;
        const Matrix m{0, -2, 0, 5, 2, 0, 0.5, 0, 0, 0, 1, -4, 0, 0, 0, 1};
        for (const oracle::QVec& p : points_of(shape.sketch))
            for (const long double z : {0, 1}) {
                const Wide at = wide(shape.v) + static_cast<long double>(p.x) * wide(shape.a) +
                                static_cast<long double>(p.y) * wide(shape.b) + z * wide(shape.h);
                extend(surface, narrow(transform_point(m, at)));
            }
        check_tight(solid_box(shape, m), surface, 1e-4);
    }
}

TEST_CASE("bounds: the box of a revolve is tight, whatever its angle") {
    oracle::Random random(6);
    for (std::size_t form = 0; form < oracle::profile_form_count; ++form)
        for (const double angle : {0.3, 2.0, 3.5, 5.5, 6.283185307179586}) {
            INFO(oracle::profile_forms[form] << ", angle " << angle);
            Revolve shape;
            shape.v = {1, 2, 3}, shape.axis = {0, 3, 4}, shape.r = {0, -4, 3}, shape.angle = angle;
            shape.sketch = oracle::ProfileMaker(random).make(form);
            const Matrix m{0, -2, 0, 5, 2, 0, 0.5, 0, 0, 0, 1, -4, 0, 0, 0, 1};
            const AxisFrame axes = axis_frame(shape);
            Box surface = empty_box;
            for (const oracle::QVec& p : points_of(oracle::closed_to_axis(shape.sketch), 200))
                for (int i = 0; i <= 100; ++i) {
                    const long double turn = static_cast<long double>(angle) * i / 100;
                    const auto u = static_cast<long double>(p.x), v = static_cast<long double>(p.y);
                    const Wide at =
                        wide(shape.v) + u * (std::cos(turn) * axes.x + std::sin(turn) * axes.y) + v * axes.z;
                    extend(surface, narrow(transform_point(m, at)));
                }
            check_tight(solid_box(shape, m), surface, 1e-2);
        }
}

TEST_CASE("bounds: the box of an ebm holds its solid cells only") {
    Ebm ebm;
    ebm.width = 4, ebm.depth = 3, ebm.height = 2;
    ebm.cells = {0, 0, 0, 0, 0, 7, 1, 0, 0, 0, 0, 0};
    ebm.matrix[3] = 10;
    check_tight(solid_box(ebm, identity), {{11, 1, 0}, {13, 2, 2}}, 1e-13);
}

TEST_CASE("bounds: how far curves reach") {
    // A quarter of the unit circle, and a parabola.
    const long double w = std::sqrt(0.5L);
    const auto quarter = extent_of({{{1, 0, 1}, {1, 1, w}, {0, 1, 1}}}, 1, 1);
    CHECK(static_cast<double>(quarter.first) == Approx(1).epsilon(1e-15));
    CHECK(static_cast<double>(quarter.second) == Approx(std::sqrt(2.0)).epsilon(1e-15));
    const auto parabola = extent_of({{{0, 0, 1}, {1, 2, 1}, {2, 0, 1}}}, 0, 1);
    CHECK(static_cast<double>(parabola.second) == Approx(1).epsilon(1e-15));
    CHECK(parabola.second >= 1);
}
