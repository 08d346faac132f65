// Solids of any numbers, for tests of what is written and read: most of them enclose nothing.
#pragma once

#include <cmath>
#include <random>

#include <csgrt/scene.hpp>

#include "formats/json/simple_solids.hpp"

namespace csgrt {

/// Doubles of every size, sign and length.
class Numbers {
public:
    explicit Numbers(unsigned seed) : random_(seed) {}
    double operator()() {
        switch (random_() % 6) {
            case 0:
                return static_cast<double>(random_() % 2000) - 1000;
            case 1:
                return random_() % 2 ? 0.0 : -0.0;
            case 2: {
                const int power = static_cast<int>(random_() % 600) - 300;
                return std::ldexp(1 + uniform_(random_), power);
            }
            case 3:
                return -uniform_(random_);
            case 4:
                return 25.4 * (static_cast<double>(random_() % 1000) / 8);
            default:
                return uniform_(random_) * 1e4;
        }
    }
    Vec3 vector() {
        const double x = (*this)(), y = (*this)(), z = (*this)();
        return {x, y, z};
    }
    Vec3 color() {
        const double r = uniform_(random_), g = uniform_(random_), b = uniform_(random_);
        return {r, g, b};
    }
    Vec3 direction() {
        const double angle = 6 * uniform_(random_), z = 0.9 * uniform_(random_), r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }
    int integer() { return static_cast<int>(random_()); }
    bool coin() { return random_() % 2 == 0; }
    std::size_t below(std::size_t n) { return random_() % n; }

private:
    std::mt19937 random_;
    std::uniform_real_distribution<double> uniform_{0, 1};
};

template <class Make>
auto list_of(std::size_t count, Make make) {
    std::vector<decltype(make())> list;
    for (std::size_t i = 0; i < count; ++i) list.push_back(make());
    return list;
}

inline Matrix random_placement(Numbers& n) {
    Matrix m = identity;
    if (n.coin()) return m;
    for (std::size_t i = 0; i < 12; ++i) m[i] = n();
    return m;
}

inline Sketch random_sketch(Numbers& n) {
    Sketch sketch;
    const auto vertex = [&] { return static_cast<std::uint32_t>(n.below(100)); };
    if (n.coin()) sketch.name = "sk.\u00e9";
    sketch.vertices = list_of(n.below(9), [&] { return Sketch::Point{n(), n()}; });
    sketch.curves = list_of(n.below(9), [&]() -> Sketch::Curve {
        switch (n.below(5)) {
            case 0:
                return Sketch::Line{vertex(), UINT32_MAX};
            case 1:
                return Sketch::Arc{vertex(), vertex(), n(), n.coin(), n.coin()};
            case 2:
                return Sketch::Arc{vertex(), vertex(), -1, false, false};
            case 3:
                return Sketch::Bezier{list_of(n.below(20), vertex)};
            default:
                return Sketch::Nurb{vertex(), list_of(n.below(5), std::ref(n)), list_of(n.below(60), vertex),
                                    list_of(n.below(3), std::ref(n))};
        }
    });
    const std::size_t odds = 1 + n.below(3);
    if (n.coin()) sketch.reversed = list_of(sketch.curves.size(), [&] { return std::uint8_t{n.below(odds) == 1}; });
    return sketch;
}

inline Bot random_bot(Numbers& n) {
    const auto triangle = [&] {
        return std::array<std::uint32_t, 3>{static_cast<std::uint32_t>(n.below(9)), UINT32_MAX, 0};
    };
    Bot bot;
    bot.mode = static_cast<Bot::Mode>(n.below(4));
    bot.orientation = static_cast<Bot::Orientation>(n.below(3));
    bot.vertices = list_of(n.below(9), [&] { return n.vector(); });
    bot.faces = list_of(n.below(9), triangle);
    const double thickness = n();
    if (n.coin()) bot.thickness = list_of(bot.faces.size(), [&] { return n.below(9) == 0 ? n() : thickness; });
    const std::size_t sides = 1 + n.below(3);
    if (n.coin()) bot.append = list_of(bot.faces.size(), [&] { return static_cast<std::uint8_t>(n.below(sides)); });
    if (n.coin()) bot.normals = list_of(n.below(9), [&] { return n.vector(); });
    if (n.coin()) bot.face_normals = list_of(n.below(9), triangle);
    return bot;
}

template <class Cell>
std::vector<Cell> random_cells(Numbers& n, std::size_t count) {
    const bool picture = n.coin();
    return list_of(count, [&] { return static_cast<Cell>(picture ? (n.coin() ? 255 : 0) : n.below(65536)); });
}

/// Of the type that has this place among a Shape's.
inline Shape random_shape(Numbers& n, std::size_t type) {
    const auto point = [&] { return n.vector(); };
    const auto count = [&] { return static_cast<std::uint32_t>(n.below(6)); };
    const auto some_sphere = [&] {
        const double radius = 1 + n.color().x;
        return sphere(n.vector(), radius);
    };
    const auto some_cone = [&] {
        const bool cylinder = n.coin();
        return cone(n.vector(), {0, 0, 3}, 2, cylinder ? 2 : 0);
    };
    const Shape kinds[] = {
        n.coin() ? Ell{n.vector(), n.vector(), n.vector(), n.vector()} : some_sphere(),
        n.coin() ? Tgc{n.vector(), n.vector(), n.vector(), n.vector(), n.vector(), n.vector()} : some_cone(),
        arb(list_of(4 + n.below(5), point)),
        Arbn{list_of(n.below(5),
                     [&] {
                         return Plane{n.direction(), n()};
                     })},
        Half{{n.direction(), n()}},
        Tor{n.vector(), n.vector(), n(), n()},
        Ehy{n.vector(), n.vector(), n.direction(), n(), n(), n()},
        Part{n.vector(), n.vector(), n(), n()},
        Epa{n.vector(), n.vector(), n.direction(), n(), n()},
        Rpc{n.vector(), n.vector(), n.vector(), n()},
        Rhc{n.vector(), n.vector(), n.vector(), n(), n()},
        Eto{n.vector(), n.vector(), n.vector(), n(), n()},
        Hyp{n.vector(), n.vector(), n.vector(), n(), n()},
        Superell{n.vector(), n.vector(), n.vector(), n.vector(), n(), n()},
        Hrt{n.vector(), n.vector(), n.vector(), n.vector(), n()},
        Metaball{static_cast<Metaball::Method>(n.below(3)), n(),
                 list_of(n.below(5),
                         [&] {
                             return Metaball::Point{n.vector(), n(), n.coin() ? 1 : n()};
                         })},
        Pipe{list_of(n.below(5),
                     [&] {
                         return Pipe::Point{n.vector(), n(), n(), n()};
                     })},
        Cline{n.vector(), n.vector(), n(), n()},
        random_bot(n),
        Ars{list_of(n.below(5), [&] { return list_of(n.below(5), point); })},
        Nmg{list_of(n.below(5), point),
            list_of(n.below(5), [&] { return list_of(n.below(3), [&] { return list_of(n.below(5), count); }); })},
        Ebm{n.coin() ? "cells.bw" : "", count(), count(), n(), random_placement(n), random_cells<std::uint8_t>(n, 30)},
        Vol{n.coin() ? "a \"b\"" : "", count(), UINT32_MAX, count(), static_cast<std::uint8_t>(n.below(256)),
            static_cast<std::uint8_t>(n.coin() ? 255 : n.below(256)), n.vector(), random_placement(n),
            random_cells<std::uint8_t>(n, n.below(200))},
        Dsp{n.coin() ? "terra.bin" : "", count(), count(), n.coin(), static_cast<Dsp::Cut>(n.below(3)),
            random_placement(n), random_cells<std::uint16_t>(n, n.below(30))},
        Extrude{n.vector(), n.vector(), n.vector(), n.vector(), random_sketch(n)},
        Revolve{n.vector(), n.vector(), n.vector(), n.coin() ? n() : std::abs(std::fmod(n(), 6.3)), random_sketch(n)},
        Unsupported{"grip \"\\ \u00e9\n"}};
    static_assert(std::size(kinds) == std::variant_size_v<Shape::variant>);
    return kinds[type];
}

inline Shape random_shape(Numbers& n) { return random_shape(n, n.below(std::variant_size_v<Shape::variant>)); }

}  // namespace csgrt
