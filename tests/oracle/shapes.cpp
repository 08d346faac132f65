#include "shapes.hpp"

#include <iterator>
#include <utility>

#include "curved_shapes.hpp"

namespace csgrt::oracle {

namespace detail {

namespace {

Shape ell_form(std::size_t form, const LocalFrame& s, Random& random) {
    const auto of = [&](double a, double b, double c) {
        return Ell{v(s.at), v(s.vector(a, 0, 0)), v(s.vector(0, b, 0)), v(s.vector(0, 0, c))};
    };
    const double r = random.between(0.5, 2);
    switch (form) {
        case 0:
            return of(1, 1, 1);
        case 1:
            return of(r, r, r);
        case 2: {
            const double c = random.between(0.5, 2), b = random.between(0.5, 2);
            return of(r, b, c);
        }
        case 3:
            return of(r, random.between(0.5, 2), 1e-3);  // pancake
        case 4:
            return of(1e-3, 1e-3 * r, 1);  // needle
        case 5:
            return of(r, 1, 1e-6);  // nearly a disc
        case 6:
            return of(r, r * (1 + 1e-9), r);  // nearly a sphere
        default: {
            const double lean = random.between(-0.5, 0.5);  // axes not at right angles
            return Ell{v(s.at), v(s.vector(1, 0, 0)), v(s.vector(lean, r, 0)), v(s.vector(0, lean, 1))};
        }
    }
}

constexpr const char* ell_forms[] = {"unit sphere", "sphere", "ellipsoid",   "pancake",
                                     "needle",      "disc",   "near sphere", "skew"};

/// Base semi-axes a, b, top c, d, in units; top at (lean_x, lean_y, height).
Shape tgc_of(const LocalFrame& s, double a, double b, double c, double d, double height, double lean_x = 0,
             double lean_y = 0) {
    return Tgc{v(s.at),
               v(s.vector(lean_x, lean_y, height)),
               v(s.vector(a, 0, 0)),
               v(s.vector(0, b, 0)),
               v(s.vector(c, 0, 0)),
               v(s.vector(0, d, 0))};
}

Shape tgc_form(std::size_t form, const LocalFrame& s, Random& random) {
    const double r = random.between(0.5, 2), q = random.between(0.5, 2), h = random.between(0.5, 4);
    const double f = random.between(0.1, 0.9), g = random.between(0.1, 0.9), l = random.between(-1, 1);
    switch (form) {
        case 0:
            return tgc_of(s, 1, 1, 1, 1, 2);  // right circular cylinder
        case 1:
            return tgc_of(s, r, q, r, q, h);  // elliptical cylinder
        case 2:
            return tgc_of(s, r, q, r, q, h, l, 1);  // oblique
        case 3:
            return tgc_of(s, r, r, r * f, r * f, h);  // truncated cone
        case 4:
            return tgc_of(s, r, q, r * 0.5, q * 0.5, h,
                          l);  // oblique elliptical cone, equal ratios
        case 5:
            return tgc_of(s, 1, 1, 0, 0, 2);  // cone to an apex
        case 6:
            return tgc_of(s, r, q, 0, 0, h, l, -l);  // oblique, to an apex
        case 7:
            return tgc_of(s, 0, 0, r, r, h);  // standing on its apex
        case 8:
            return tgc_of(s, r, q, r * f, q * g, h);  // general: a quartic
        case 9:
            return tgc_of(s, r, q, r * f, q / g, h, l,
                          l);  // one ellipse long in a, the other in b
        case 10:
            return tgc_of(s, 1, 1, 0.5, 1e-3, h);  // nearly a wedge
        case 11:
            return tgc_of(s, r, r, r * f, r * f, 1e-3);  // thin disc
        case 12:
            return tgc_of(s, 1e-3, 1e-3, 5e-4, 5e-4, 1);  // needle
        case 13:
            return tgc_of(s, r, r, r * (1 - 1e-7), r * (1 - 1e-7),
                          h);  // nearly a cylinder
        case 14:
            return tgc_of(s, r, q, r * f, q * f * (1 + 1e-7), h);  // nearly equal ratios
        default:
            return tgc_of(s, r, q, r * 1e-3, q * 1e-3, h);  // nearly an apex
    }
}

constexpr const char* tgc_forms[] = {
    "right cylinder", "elliptical cylinder", "oblique cylinder", "truncated cone", "oblique elliptical cone",
    "apex",           "oblique apex",        "on its apex",      "quartic",        "crossed quartic",
    "near wedge",     "thin disc",           "needle",           "near cylinder",  "near equal ratios",
    "near apex"};

Shape arb_form(std::size_t form, const LocalFrame& s, Random& random) {
    const double r = random.between(0.5, 2), q = random.between(0.5, 2), l = random.between(-0.5, 0.5);
    const auto of = [&](const std::array<QVec, 8>& units) {
        Arb arb;
        for (std::size_t i = 0; i < 8; ++i) arb.vertices[i] = v(s.point(units[i].x, units[i].y, units[i].z));
        return arb;
    };
    const auto box = [&](double x, double y, double z, double top_x, double top_y, double lean) {
        return of({{{-x, -y, 0},
                    {x, -y, 0},
                    {x, y, 0},
                    {-x, y, 0},
                    {lean - top_x, -top_y, z},
                    {lean + top_x, -top_y, z},
                    {lean + top_x, top_y, z},
                    {lean - top_x, top_y, z}}});
    };
    switch (form) {
        case 0:
            return box(1, 1, 2, 1, 1, 0);
        case 1:
            return box(r, q, 1, r, q, 0);
        case 2:
            return box(r, q, 1, r, q, l);  // leaning: parallel faces
        case 3:
            return box(1, q, r, 0.5, 0.25, l);  // frustum
        case 4:
            return box(1, r, 1e-3, 1, r, 0);  // plate
        case 5:
            return box(1e-3, 1e-3, r, 1e-3, 1e-3, 0);  // rod
        case 6:                                        // arb7: face 4567 is a triangle
            return of({{{0, 0, 0},
                        {1, 0, 0},
                        {1, 1, 0},
                        {0, 1, 0},
                        {0.25, 0, 1},
                        {1, 0, 0.625},
                        {1, 0.5, 0.5},
                        {0.25, 0, 1}}});
        case 7:  // arb6: a wedge
            return of({{{0, 0, 0},
                        {r, 0, 0},
                        {r, q, 0},
                        {0, q, 0},
                        {0.5 * r, 0, 1},
                        {0.5 * r, 0, 1},
                        {0.5 * r, q, 1},
                        {0.5 * r, q, 1}}});
        case 8: {  // arb5: a pyramid
            const QVec top{l, 0.25, q};
            return of({{{-1, -r, 0}, {1, -r, 0}, {1, r, 0}, {-1, r, 0}, top, top, top, top}});
        }
        case 9: {  // arb4, as mk_arb4 repeats its vertices
            const QVec top{l, l, q};
            return of({{{0, 0, 0}, {1, 0, 0}, {0, r, 0}, {0, r, 0}, top, top, top, top}});
        }
        case 10: {  // arb4, the other way to repeat them
            const QVec top{l, l, q};
            return of({{{0, 0, 0}, {1, 0, 0}, {0, r, 0}, {0, 0, 0}, top, top, top, top}});
        }
        default:
            return box(1, 1, 1, 1e-3, 1e-3, l);  // nearly a pyramid
    }
}

constexpr const char* arb_forms[] = {"cube", "box",  "leaning box", "frustum", "plate",  "rod",
                                     "arb7", "arb6", "arb5",        "arb4",    "arb4 b", "near arb5"};

Shape arbn_form(std::size_t form, const LocalFrame& s, Random& random) {
    Arbn arbn;
    const auto plane = [&](const QVec& direction, double reach) {
        const QVec n = direction.x * s.x + direction.y * s.y + direction.z * s.z;
        const Vec3 normal = v(n);
        arbn.planes.push_back({normal, to_double(dot(normal, s.at) + quad(s.size * reach))});
    };
    const auto box = [&](double x, double y, double z) {
        plane({1, 0, 0}, x), plane({-1, 0, 0}, x), plane({0, 1, 0}, y), plane({0, -1, 0}, y), plane({0, 0, 1}, z),
            plane({0, 0, -1}, z);
    };
    const auto some_planes = [&](int count, double least, double most) {
        for (int i = 0; i < count; ++i) {
            const double reach = random.between(least, most);
            plane(random.direction(), reach);
        }
    };
    switch (form) {
        case 0:
            box(1, 1, 1);
            break;
        case 1:  // octahedron with its corners cut
            for (const double x : {-1, 1})
                for (const double y : {-1, 1})
                    for (const double z : {-1, 1}) plane(unit({x, y, z}), 1);
            box(1.5, 1.5, 1.5);
            break;
        case 2:  // random faces
            box(2, 2, 2);
            some_planes(12, 0.7, 1.3);
            break;
        case 3:  // a thin plate, cut
            box(2, 2, 1e-3);
            some_planes(6, 0.5, 1);
            break;
        default:  // faces that touch nothing, and one that is there twice
            box(1, 1.5, 0.5);
            plane({0, 0, 1}, 0.5), plane(unit({1, 1, 1}), 3);
    }
    return arbn;
}

constexpr const char* arbn_forms[] = {"cube", "octahedron", "random", "plate", "idle faces"};

Shape half_form(std::size_t form, const LocalFrame& s, Random& random) {
    const Vec3 normal = v(form == 0 ? s.z : random.direction());
    return Half{{normal, form == 0 ? to_double(dot(normal, s.at)) : s.size * random.between(-3, 3)}};
}

constexpr const char* half_forms[] = {"aligned", "random"};

Shape tor_form(std::size_t form, const LocalFrame& s, Random& random) {
    static constexpr double ratios[] = {0.5, 0.25, 0, 0.9, 1e-2, 1e-3, 1, 0.999999};
    const double ratio = form == 2 ? random.between(0.1, 0.9) : ratios[form];
    const double r = s.size * (form == 0 ? 1.0 : random.between(0.5, 2));
    const quad stretch = form == 0 ? 1 : random.between(0.1, 10);  // the axis may have any length
    return Tor{v(s.at), v(stretch * s.z), r, std::min(r, r * ratio)};
}

constexpr const char* tor_forms[] = {"half", "quarter", "random", "fat", "1e-2", "1e-3", "horn", "near horn"};

Shape ehy_form(std::size_t form, const LocalFrame& s, Random& random) {
    const double h = random.between(0.5, 3), r = random.between(0.5, 2), q = random.between(0.5, 2);
    const auto of = [&](double height, double r1, double r2, double c) {
        return Ehy{v(s.at), v(s.vector(0, 0, height)), v(s.x), s.size * r1, s.size * r2, s.size * c};
    };
    switch (form) {
        case 0:
            return of(2, 1, 1, 1);
        case 1:
            return of(h, r, r, random.between(0.1, 2));
        case 2:
            return of(h, r, q, random.between(0.1, 2));
        case 3:
            return of(h, r, q, 1e-3);  // nearly a cone
        case 4:
            return of(h, r, q, 1e3);  // nearly a paraboloid
        case 5:
            return of(1e-3, 1, r, 0.5);  // a dish
        default:
            return of(1, 1e-3, 1e-3, 0.5);  // needle
    }
}

constexpr const char* ehy_forms[] = {"plain", "round", "elliptical", "near cone", "near paraboloid", "dish", "needle"};

}  // namespace

}  // namespace detail

Matrix detail::to_matrix(const QAffine& m) {
    const Vec3 x = v(m.x), y = v(m.y), z = v(m.z), o = v(m.origin);
    return {x.x, y.x, z.x, o.x, x.y, y.y, z.y, o.y, x.z, y.z, z.z, o.z, 0, 0, 0, 1};
}

Matrix detail::placement(std::size_t index, double size, Random& random) {
    if (index == 0) return identity;
    if (index == 1) {
        const LocalFrame s = aligned_local_frame(random);
        return to_matrix({s.x, s.y, s.z, s.at});
    }
    const LocalFrame a = random_local_frame(random, size), b = random_local_frame(random, 1);
    const QAffine turn{a.x, a.y, a.z, a.at}, first{b.x, b.y, b.z, {}};
    const auto stretch = [&](double x, double y, double z) { return QAffine{{x, 0, 0}, {0, y, 0}, {0, 0, z}, {}}; };
    switch (index) {
        case 2:
            return to_matrix(turn);
        case 3: {
            const double s = random.power(-3, 3);
            return to_matrix(turn * stretch(s, s, s));
        }
        case 4: {
            const double z = random.power(-1, 1), y = random.power(-1, 1), x = random.power(-1, 1);
            return to_matrix(turn * stretch(x, y, z) * first);
        }
        case 5: {
            const QAffine shear{
                {1, 0, 0}, {random.between(-2, 2), 1, 0}, {random.between(-2, 2), random.between(-2, 2), 1}, {}};
            return to_matrix(turn * shear);
        }
        case 6:
            return to_matrix(turn * stretch(1, 1, -1));
        default: {
            QAffine m = turn;
            m.origin = quad(1e5 * size) * random.direction();
            return to_matrix(m);
        }
    }
}

Case make_case(Kind kind, std::size_t index, Random& random) {
    const auto build = [&](auto form_of, const auto& names) {
        const std::size_t forms = std::size(names), form = index % forms, round = index / forms;
        const std::size_t place = round % std::size(detail::placements);
        const std::size_t turn = round / std::size(detail::placements) % 4;
        const double size = turn == 2 ? 1e-3 : turn == 3 ? 1e6 : 1.0;
        const LocalFrame local =
            form == 0 || place == 1 ? aligned_local_frame(random) : random_local_frame(random, size);
        Shape shape = form_of(form, local, random);
        std::string name = std::string(names[form]) + ", " + detail::placements[place] +
                           (turn == 2   ? ", tiny"
                            : turn == 3 ? ", large"
                                        : "");
        return Case{std::move(name), std::move(shape), detail::placement(place, local.size, random)};
    };
    switch (kind) {
        case Kind::ell:
            return build(detail::ell_form, detail::ell_forms);
        case Kind::tgc:
            return build(detail::tgc_form, detail::tgc_forms);
        case Kind::arb:
            return build(detail::arb_form, detail::arb_forms);
        case Kind::arbn:
            return build(detail::arbn_form, detail::arbn_forms);
        case Kind::half:
            return build(detail::half_form, detail::half_forms);
        case Kind::tor:
            return build(detail::tor_form, detail::tor_forms);
        case Kind::ehy:
            return build(detail::ehy_form, detail::ehy_forms);
        case Kind::part:
            return build(detail::part_form, detail::part_forms);
        case Kind::epa:
            return build(detail::epa_form, detail::epa_forms);
        case Kind::rpc:
            return build(detail::rpc_form, detail::rpc_forms);
        case Kind::rhc:
            return build(detail::rhc_form, detail::rhc_forms);
        case Kind::eto:
            return build(detail::eto_form, detail::eto_forms);
        case Kind::hyp:
            return build(detail::hyp_form, detail::hyp_forms);
        case Kind::superell:
            return build(detail::superell_form, detail::superell_forms);
        case Kind::hrt:
            return build(detail::hrt_form, detail::hrt_forms);
        case Kind::metaball:
            return build(detail::metaball_form, detail::metaball_forms);
    }
    throw std::logic_error("no such kind of solid");
}

}  // namespace csgrt::oracle
