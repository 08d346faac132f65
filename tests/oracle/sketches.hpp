// Sketches of every kind of curve, and what a ray may meet in them.
#pragma once

#include <cmath>
#include <string>

#include "random.hpp"

namespace csgrt::oracle {

inline constexpr const char* sketch_forms[] = {"rectangle",
                                               "star",
                                               "polygon with a hole",
                                               "circle",
                                               "ring",
                                               "slot",
                                               "arcs",
                                               "flat arcs",
                                               "Bezier loop",
                                               "mixed",
                                               "B-spline",
                                               "rational B-spline",
                                               "crossing itself",
                                               "degree 12"};
inline constexpr std::size_t sketch_form_count = std::size(sketch_forms);

class SketchMaker {
public:
    explicit SketchMaker(Random& random) : random_(random) {}

    Sketch make(std::size_t form) {
        sketch_ = {};
        switch (form) {
            case 0:
                loop({{-1, -0.5}, {1, -0.5}, {1, 0.5}, {-1, 0.5}}, 0);
                break;
            case 1:
                loop(around(9, 0.3), 0);
                break;
            case 2:
                loop(around(6, 0.8), 0);
                loop({{-0.25, -0.25}, {0.25, -0.25}, {0, 0.25}}, 0);
                break;
            case 3: {
                const double r = random_.between(0.2, 1);
                circle(random_.between(-1, 1), 0, r);
                break;
            }
            case 4:
                circle(0, 0, 1);
                circle(0.1, 0.1, random_.between(0.1, 0.85));
                break;
            case 5: {  // half circles on a rectangle
                const std::uint32_t a = vertex(-0.5, -0.5), b = vertex(0.5, -0.5), c = vertex(0.5, 0.5),
                                    d = vertex(-0.5, 0.5);
                sketch_.curves = {Sketch::Line{a, b}, Sketch::Arc{b, c, 0.5, true, false}, Sketch::Line{c, d},
                                  Sketch::Arc{d, a, 0.5, true, false}};
                break;
            }
            case 6:
                loop(around(5, 0.7), 1);
                break;
            case 7:
                loop(around(4, 0.7), 2);
                break;
            case 8:
                loop(around(3, 0.6), 3);
                break;
            case 9:
                loop(around(6, 0.5), 4);
                break;
            case 10:
            case 11:
                spline(form == 11);
                break;
            case 12:
                loop({{-1, -1}, {1, 1}, {1, -1}, {-1, 1}}, 0);
                break;
            default: {
                Sketch::Bezier bezier;
                for (int i = 0; i < 12; ++i) bezier.points.push_back(some_vertex(1));
                bezier.points.push_back(bezier.points.front());
                sketch_.curves = {bezier};
            }
        }
        sketch_.reversed.assign(sketch_.curves.size(), 0);
        return sketch_;
    }

private:
    using Points = std::vector<Sketch::Point>;

    std::uint32_t vertex(double u, double v) {
        sketch_.vertices.push_back({u, v});
        return static_cast<std::uint32_t>(sketch_.vertices.size() - 1);
    }
    /// In the square from -reach to reach.
    std::uint32_t some_vertex(double reach) {
        const double v = random_.between(-reach, reach), u = random_.between(-reach, reach);
        return vertex(u, v);
    }
    /// Around the origin, between `least` and 1 away from it.
    Points around(int count, double least) {
        Points points;
        for (int i = 0; i < count; ++i) {
            const double angle = 6.283185307179586 * (i + random_.between(-0.3, 0.3)) / count,
                         r = random_.between(least, 1);
            points.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
        return points;
    }
    /// kind: 0 lines, 1 arcs, 2 arcs that are nearly straight, 3 Bezier curves, 4 any of them.
    void loop(const Points& points, int kind) {
        const auto first = static_cast<std::uint32_t>(sketch_.vertices.size());
        const auto count = static_cast<std::uint32_t>(points.size());
        for (const auto& p : points) vertex(p.u, p.v);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t a = first + i, b = first + (i + 1) % count;
            const auto &p = points[i], &q = points[(i + 1) % count];
            const double half = 0.5 * std::hypot(p.u - q.u, p.v - q.v);
            const int one = kind == 4 ? static_cast<int>(random_.below(4)) : kind;
            if (one == 0) {
                sketch_.curves.push_back(Sketch::Line{a, b});
            } else if (one <= 2) {
                const double r = half * (one == 2 ? random_.power(1, 6) : 1 + random_.between(0, 1));
                const bool left = random_.coin();  // nearly straight: the short way
                sketch_.curves.push_back(Sketch::Arc{a, b, r, left, one == 2 ? !left : random_.coin()});
            } else {
                Sketch::Bezier bezier{{a}};
                for (std::size_t k = 1 + random_.below(5); k > 0; --k) bezier.points.push_back(some_vertex(1.2));
                bezier.points.push_back(b);
                sketch_.curves.push_back(bezier);
            }
        }
    }
    void circle(double u, double v, double r) {
        const double angle = random_.between(0, 6);
        const std::uint32_t center = vertex(u, v), start = vertex(u + r * std::cos(angle), v + r * std::sin(angle));
        sketch_.curves.push_back(Sketch::Arc{start, center, -1, false, false});
    }
    void spline(bool rational) {
        Sketch::Nurb nurb;
        nurb.order = 3 + static_cast<std::uint32_t>(random_.below(3));
        const std::size_t count = nurb.order + random_.below(3);
        for (std::size_t i = 0; i < count; ++i) {
            const double angle = 6 * static_cast<double>(i) / static_cast<double>(count);
            nurb.points.push_back(vertex(std::cos(angle), random_.between(0.5, 1) * std::sin(angle)));
            if (rational) nurb.weights.push_back(random_.between(0.3, 3));
        }
        double knot = 0;
        for (std::size_t i = 0; i < count + nurb.order; ++i) {
            // Single and double knots inside; as many as the order at both ends.
            if (i == nurb.order || i == count || (i > nurb.order && i < count && random_.coin()))
                knot += random_.between(0.5, 1);
            nurb.knots.push_back(knot);
        }
        sketch_.curves = {nurb, Sketch::Line{nurb.points.back(), nurb.points.front()}};
    }

    Random& random_;
    Sketch sketch_;
};

}  // namespace csgrt::oracle
