// Profiles to turn about an axis: nothing left of it.
#pragma once

#include "sketches.hpp"

namespace csgrt::oracle {

inline constexpr const char* profile_forms[] = {"cylinder", "ring",  "cone",          "zigzag",        "open",
                                                "ball",     "torus", "hollow torus",  "Bezier vase",   "Bezier ring",
                                                "arcs",     "disc",  "with its axis", "B-spline ring", "near the axis"};
inline constexpr std::size_t profile_form_count = std::size(profile_forms);

class ProfileMaker {
public:
    explicit ProfileMaker(Random& random) : random_(random) {}

    Sketch make(std::size_t form) {
        sketch_ = {};
        const double r = random_.between(0.3, 0.9);
        switch (form) {
            case 0:
                lines({{0, -1}, {1, -1}, {1, 1}, {0, 1}});
                break;
            case 1:
                lines({{r, -0.5}, {1, -0.5}, {1, 0.5}, {r, 0.25}, {r, -0.5}});
                break;
            case 2:
                lines({{0, -0.5}, {1, -0.5}, {0, 1}});
                break;
            case 3:
                lines({{0, -0.7}, {0.55, -0.7}, {0.7, -0.2}, {0.3, 0.1}, {r, 0.6}, {0, 0.75}});
                break;
            case 4:
                lines({{0.5, -1}, {1, 0}, {r, 1}});
                break;
            case 5:
                curve(Sketch::Arc{vertex(0, -1), vertex(0, 1), 1, true, false});
                break;
            case 6:
                circle(1, 0, r);
                break;
            case 7:
                circle(1, 0.2, r);
                circle(1, 0.2, 0.8 * r);
                break;
            case 8:
                bezier({{0, -0.75}, {0.8, -0.8}, {0.1, 0}, {0.9, r}, {0, 0.8}});
                break;
            case 9: {
                std::vector<Sketch::Point> points{{r, -0.5}};
                for (int i = 0; i < 5; ++i) points.push_back({random_.between(0, 1.2), random_.between(-1, 1)});
                bezier(points);
                curve(Sketch::Line{static_cast<std::uint32_t>(sketch_.vertices.size() - 1), 0});
                break;
            }
            case 10: {
                const std::uint32_t a = vertex(r + 0.3, -0.5), b = vertex(r + 0.3, 0.5), c = vertex(1.2, 0.5),
                                    d = vertex(1.2, -0.5);
                curve(Sketch::Arc{a, b, random_.between(0.5, 2), false, true});
                curve(Sketch::Line{b, c});
                curve(Sketch::Arc{c, d, random_.between(0.5, 1), random_.coin(), true});
                curve(Sketch::Line{d, a});
                break;
            }
            case 11:
                lines({{0, -1e-3}, {1, -1e-3}, {1, 1e-3}, {0, 1e-3}});
                break;
            case 12:
                lines({{0, -1}, {r, 0}, {0, 1}, {0, -1}});
                break;
            case 13: {
                Sketch::Nurb nurb;
                nurb.order = 3;
                for (const Sketch::Point& p : {Sketch::Point{r, -0.5}, {1, -1}, {1.2, 0}, {1, 1}, {r, 0.5}})
                    nurb.points.push_back(vertex(p.u, p.v)), nurb.weights.push_back(random_.between(0.5, 2));
                nurb.knots = {0, 0, 0, 1, 2, 3, 3, 3};
                curve(nurb);
                curve(Sketch::Line{nurb.points.back(), nurb.points.front()});
                break;
            }
            default:
                lines({{1e-3, -1}, {2e-3, -1}, {1e-3 * r, 0}, {1, 1}, {1e-3, -1}});
        }
        sketch_.reversed.assign(sketch_.curves.size(), 0);
        return sketch_;
    }

private:
    std::uint32_t vertex(double u, double v) {
        sketch_.vertices.push_back({u, v});
        return static_cast<std::uint32_t>(sketch_.vertices.size() - 1);
    }
    void curve(Sketch::Curve c) { sketch_.curves.push_back(std::move(c)); }
    void lines(const std::vector<Sketch::Point>& points) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const std::uint32_t a = vertex(points[i].u, points[i].v), b = vertex(points[i + 1].u, points[i + 1].v);
            curve(Sketch::Line{a, b});
        }
    }
    void bezier(const std::vector<Sketch::Point>& points) {
        Sketch::Bezier one;
        for (const auto& p : points) one.points.push_back(vertex(p.u, p.v));
        curve(one);
    }
    void circle(double u, double v, double r) {
        const std::uint32_t center = vertex(u, v), start = vertex(u, v + r);
        curve(Sketch::Arc{start, center, -1, false, false});
    }

    Random& random_;
    Sketch sketch_;
};

}  // namespace csgrt::oracle
