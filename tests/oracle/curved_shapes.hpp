// Forms of the solids of a closed form; see shapes.hpp.
#pragma once

#include <csgrt/scene.hpp>

#include "local_frame.hpp"

namespace csgrt::oracle::detail {

inline Shape part_form(std::size_t form, const LocalFrame& s, Random& random) {
    const auto of = [&](double h, double r_v, double r_h) {
        return Part{v(s.at), v(s.vector(0, 0, h)), s.size * r_v, s.size * r_h};
    };
    const double r = random.between(0.5, 2), h = random.between(0.5, 3), f = random.between(0.1, 0.9);
    switch (form) {
        case 0:
            return of(2, 1, 1);
        case 1:
            return of(h, r, r - f * std::fmin(h, r));
        case 2:
            return of(r * (1 + f), r * f, r);  // widening
        case 3:
            return of(r + h, r, 0);  // to a point
        case 4:
            return of(r + h, 0, r);
        case 5:
            return of(h, r, r + h * (1 + f));  // one ball
        case 6:
            return of(h, r + h * (1 - 1e-6), r);  // nearly one ball
        case 7:
            return of(1, 1e-3, 2e-3);  // needle
        case 8:
            return of(1e-3, 1, 1 - 5e-4);  // two balls, nearly one
        default:
            return of(0, r, f);  // no axis
    }
}
inline constexpr const char* part_forms[] = {"capsule",      "cone",     "widening",        "to a point",
                                             "from a point", "one ball", "nearly one ball", "needle",
                                             "two near",     "no axis"};

inline Shape epa_form(std::size_t form, const LocalFrame& s, Random& random) {
    const auto of = [&](double h, double r_1, double r_2) {
        return Epa{v(s.at), v(s.vector(0, 0, h)), v(s.x), s.size * r_1, s.size * r_2};
    };
    const double h = random.between(0.5, 3), r = random.between(0.5, 2), q = random.between(0.5, 2);
    switch (form) {
        case 0:
            return of(2, 1, 1);
        case 1:
            return of(h, r, r);
        case 2:
            return of(h, r, q);
        case 3:
            return of(h, r, 1e-3);  // a blade
        case 4:
            return of(1e-3, 1, r);  // a dish
        default:
            return of(1, 1e-3, 1e-3);  // needle
    }
}
inline constexpr const char* epa_forms[] = {"plain", "round", "elliptical", "blade", "dish", "needle"};

inline Shape rpc_form(std::size_t form, const LocalFrame& s, Random& random) {
    const auto of = [&](double h, double b, double r) {
        return Rpc{v(s.at), v(s.vector(h, 0, 0)), v(s.vector(0, 0, b)), s.size * r};
    };
    const double h = random.between(0.5, 3), b = random.between(0.5, 2), r = random.between(0.5, 2);
    switch (form) {
        case 0:
            return of(2, 1, 1);
        case 1:
            return of(h, b, r);
        case 2:
            return of(h, b, 1e-3);  // a blade
        case 3:
            return of(h, 1e-3, r);  // a sheet
        default:
            return of(1e-3, b, r);  // a slice
    }
}
inline constexpr const char* rpc_forms[] = {"plain", "random", "blade", "sheet", "slice"};

inline Shape rhc_form(std::size_t form, const LocalFrame& s, Random& random) {
    const auto of = [&](double h, double b, double r, double c) {
        return Rhc{v(s.at), v(s.vector(h, 0, 0)), v(s.vector(0, 0, b)), s.size * r, s.size * c};
    };
    const double h = random.between(0.5, 3), b = random.between(0.5, 2), r = random.between(0.5, 2);
    switch (form) {
        case 0:
            return of(2, 1, 1, 1);
        case 1:
            return of(h, b, r, random.between(0.1, 2));
        case 2:
            return of(h, b, r, 1e-3);  // nearly a wedge
        case 3:
            return of(h, b, r, 1e3);  // nearly a parabola
        case 4:
            return of(h, b, 1e-3, 0.5);  // a blade
        default:
            return of(1e-3, b, r, 0.5);  // a slice
    }
}
inline constexpr const char* rhc_forms[] = {"plain", "random", "near wedge", "near parabola", "blade", "slice"};

inline Shape hyp_form(std::size_t form, const LocalFrame& s, Random& random) {
    const auto of = [&](double h, double a, double b, double neck) {
        return Hyp{v(s.at), v(s.vector(0, 0, h)), v(s.vector(a, 0, 0)), s.size * b, neck};
    };
    const double h = random.between(0.5, 3), a = random.between(0.5, 2), b = random.between(0.5, 2);
    switch (form) {
        case 0:
            return of(2, 1, 1, 0.5);
        case 1:
            return of(h, a, b, random.between(0.1, 0.9));
        case 2:
            return of(h, a, b, 1e-2);  // a thin neck
        case 3:
            return of(h, a, b, 1e-6);  // nearly two cones
        case 4:
            return of(h, a, b, 1 - 1e-6);  // nearly a cylinder
        case 5:
            return of(1e-3, a, b, 0.3);  // a disc
        default:
            return of(1, 1e-3, 2e-3, 0.3);  // needle
    }
}
inline constexpr const char* hyp_forms[] = {"plain",         "random", "thin neck", "near cones",
                                            "near cylinder", "disc",   "needle"};

inline Shape eto_form(std::size_t form, const LocalFrame& s, Random& random) {
    // The ellipse's semi-axes in units of the circle's radius, c leaning away
    // from the axis by `angle`.
    const auto of = [&](double c, double d, double angle, double stretch) {
        const double r = form == 0 ? 1.0 : random.between(0.5, 2);
        return Eto{v(s.at), v(quad(stretch) * s.z), v(s.vector(r * c * std::sin(angle), 0, r * c * std::cos(angle))),
                   s.size * r, s.size * r * d};
    };
    const double angle = random.between(-3, 3), stretch = random.between(0.1, 10);
    switch (form) {
        case 0:
            return of(0.5, 0.25, 0, 1);
        case 1:
            return of(0.5, 0.25, 1.5707963267948966, stretch);
        case 2: {
            const double d = random.between(0.1, 0.5);
            return of(random.between(0.5, 0.9), d, angle, stretch);
        }
        case 3:
            return of(0.5, 0.5, angle, stretch);  // a torus
        case 4:
            return of(0.02, 0.01, angle, stretch);  // a ring
        case 5:
            return of(0.5, 1e-3, angle, stretch);  // a shell
        case 6:
            return of(1, 0.9, 1.5707963267948966, stretch);  // closed: no hole
        default:
            return of(2, 0.3, 0.25, stretch);  // high
    }
}
inline constexpr const char* eto_forms[] = {"upright", "flat", "leaning", "torus", "ring", "shell", "horn", "high"};

inline Shape superell_form(std::size_t form, const LocalFrame& s, Random& random) {
    const double a = random.between(0.5, 2), b = random.between(0.5, 2), c = random.between(0.5, 2);
    const auto of = [&](double n, double e) {
        if (form == 0) return Superell{v(s.at), v(s.vector(1, 0, 0)), v(s.vector(0, 1, 0)), v(s.vector(0, 0, 1)), n, e};
        return Superell{v(s.at), v(s.vector(a, 0, 0)), v(s.vector(0, b, 0)), v(s.vector(0, 0, c)), n, e};
    };
    const auto some = [&](double n_least, double n_most, double e_least, double e_most) {
        const double e = random.between(e_least, e_most);
        return of(random.between(n_least, n_most), e);
    };
    switch (form) {
        case 0:
            return of(1, 1);  // a sphere
        case 1:
            return of(0.5, 0.3);  // a cushion
        case 2:
            return of(0.05, 0.05);  // nearly a box
        case 3:
            return some(0.2, 2, 0.2, 2);
        case 4:
            return of(2, 2);  // an octahedron
        case 5:
            return of(3, 3);  // a star
        case 6:
            return some(2, 4, 0.2, 2);
        case 7:
            return some(0.2, 2, 2, 4);
        case 8:
            return of(1, 2);  // a double cone of square outline
        default:
            return of(2.5, 5);
    }
}
inline constexpr const char* superell_forms[] = {"sphere", "cushion",    "near box", "convex",      "octahedron",
                                                 "star",   "thin poles", "thin rim", "square dome", "spikes"};

inline Shape hrt_form(std::size_t form, const LocalFrame& s, Random& random) {
    const double a = random.between(0.5, 2), b = random.between(0.5, 2), lean = random.between(-0.5, 0.5);
    const auto of = [&](double x, double y, double z, double skew) {
        return Hrt{v(s.at), v(s.vector(x, 0, 0)), v(s.vector(skew, y, 0)), v(s.vector(0, skew, z)), s.size};
    };
    switch (form) {
        case 0:
            return of(1, 1, 1, 0);
        case 1:
            return of(a, b, 1, 0);
        case 2:
            return of(a, 1e-2, b, 0);  // flat
        default:
            return of(1, a, b, lean);
    }
}
inline constexpr const char* hrt_forms[] = {"plain", "stretched", "flat", "skew"};

inline Shape metaball_form(std::size_t form, const LocalFrame& s, Random& random) {
    using Method = Metaball::Method;
    Metaball ball;
    const auto of = [&](Method method, double threshold, std::size_t count) {
        ball.method = method;
        ball.threshold = threshold;
        for (std::size_t i = 0; i < count; ++i) {
            const QVec p = random.in_cube();
            ball.points.push_back(
                {v(s.point(p.x, p.y, p.z)), s.size * random.between(0.3, 0.8), random.between(0.5, 3)});
        }
        return ball;
    };
    switch (form) {
        case 0:
            return of(Method::isopotential, 1, 1);  // a ball
        case 1:
            return of(Method::isopotential, 1, 3);
        case 2:
            return of(Method::isopotential, random.between(1, 4), 8);
        case 3:
            return of(Method::blob, 1, 1);
        case 4:
            return of(Method::blob, 1, 3);
        case 5:
            return of(Method::blob, random.between(0.2, 2), 8);
        case 6:
            return of(Method::metaball, 0.25, 4);
        default: {  // two that touch: the field half-way is the threshold
            of(Method::isopotential, 1, 0);
            for (const double x : {-1, 1}) ball.points.push_back({v(s.point(x, 0, 0)), s.size * std::sqrt(0.5), 1});
            return ball;
        }
    }
}
inline constexpr const char* metaball_forms[] = {"ball",        "three",       "eight",     "blob",
                                                 "three blobs", "eight blobs", "metaballs", "touching"};

}  // namespace csgrt::oracle::detail
