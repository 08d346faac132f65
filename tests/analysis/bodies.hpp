// Bodies whose volume, area, centroid and moments are known.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <csgrt/scene.hpp>

namespace csgrt::test {

using Tensor = std::array<std::array<double, 3>, 3>;

/// A body, and its exact figures. The second moments (the integrals of x x, x y, ...) are about the origin.
struct Body {
    std::string name;
    Scene scene;
    double volume = 0, area = 0;
    Vec3 centroid = {};
    Tensor second = {};
};

/// The moments xx, yy, zz and products xy, yz, zx of second moments.
inline std::array<double, 6> inertia_of(const Tensor& s) {
    return {s[1][1] + s[2][2], s[2][2] + s[0][0], s[0][0] + s[1][1], s[0][1], s[1][2], s[2][0]};
}
/// The second moments about the centroid.
inline Tensor central(const Body& body) {
    const double c[] = {body.centroid.x, body.centroid.y, body.centroid.z};
    Tensor s = body.second;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) s[i][j] -= body.volume * c[i] * c[j];
    return s;
}

/// The integral of a polynomial of degree 9 or less: Gauss's rule of five points.
template <class F>
double integral(double a, double b, F f) {
    const double far = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3, near = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3;
    const double outer = (322 - 13 * std::sqrt(70.0)) / 900, inner = (322 + 13 * std::sqrt(70.0)) / 900;
    const double m = (a + b) / 2, h = (b - a) / 2;
    return h * (outer * (f(m - far * h) + f(m + far * h)) + inner * (f(m - near * h) + f(m + near * h)) +
                128.0 / 225 * f(m));
}

inline Arb block(Vec3 low, Vec3 high) {
    return {{Vec3{low.x, low.y, low.z},
             {high.x, low.y, low.z},
             {high.x, high.y, low.z},
             {low.x, high.y, low.z},
             Vec3{low.x, low.y, high.z},
             {high.x, low.y, high.z},
             {high.x, high.y, high.z},
             {low.x, high.y, high.z}}};
}
inline Ell ball_at(Vec3 v, double r) { return {v, {r, 0, 0}, {0, r, 0}, {0, 0, r}}; }
inline Tgc round_rod(double r, double height) {
    return {{0, 0, -height / 2}, {0, 0, height}, {r, 0, 0}, {0, r, 0}, {r, 0, 0}, {0, r, 0}};
}

/// Turns and moves a body, so that no figure is 0 or equal to another by symmetry.
inline void place(Body& body, const std::vector<Shape>& shapes, const Tree& tree) {
    const double a = 0.7, b = 0.4, ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b);
    const Tensor turn = {{{ca, -sa * cb, sa * sb}, {sa, ca * cb, -ca * sb}, {0, sb, cb}}};
    const double move[] = {30, -20, 50};
    Matrix matrix = identity;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) matrix[4 * i + j] = turn[i][j];
        matrix[4 * i + 3] = move[i];
    }
    const Tensor inner = central(body);
    const double c[] = {body.centroid.x, body.centroid.y, body.centroid.z};
    double out[3];
    for (std::size_t i = 0; i < 3; ++i) out[i] = turn[i][0] * c[0] + turn[i][1] * c[1] + turn[i][2] * c[2] + move[i];
    body.centroid = {out[0], out[1], out[2]};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            body.second[i][j] = body.volume * out[i] * out[j];
            for (std::size_t k = 0; k < 3; ++k)
                for (std::size_t l = 0; l < 3; ++l) body.second[i][j] += turn[i][k] * inner[k][l] * turn[j][l];
        }
    }
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        Solid solid;
        solid.name = std::string(1, static_cast<char>('a' + i));
        solid.shape = shapes[i];
        body.scene.objects.push_back(solid);
    }
    Combination inner_combination, region;
    inner_combination.name = "shape";
    inner_combination.tree = tree;
    region.name = body.name;
    region.region = true;
    region.tree = csgrt::tree("shape", matrix);
    body.scene.objects.push_back(inner_combination);
    body.scene.objects.push_back(region);
    body.scene.top = {body.name};
}

inline Tensor diagonal(double x, double y, double z) { return {{{x, 0, 0}, {0, y, 0}, {0, 0, z}}}; }

/// Eight compact bodies and four that are thin or of two scales.
inline std::vector<Body> bodies() {
    constexpr double pi = std::numbers::pi;
    std::vector<Body> all;
    const auto add = [&all](const char* name, double volume, double area, Vec3 centroid, const Tensor& second,
                            const std::vector<Shape>& shapes, const Tree& t) {
        Body body{name, {}, volume, area, centroid, second};
        place(body, shapes, t);
        all.push_back(std::move(body));
    };
    const auto block_body = [&](const char* name, double x, double y, double z) {
        const double v = x * y * z;
        add(name, v, 2 * (x * y + y * z + z * x), {}, diagonal(v * x * x / 12, v * y * y / 12, v * z * z / 12),
            {block({-x / 2, -y / 2, -z / 2}, {x / 2, y / 2, z / 2})}, tree("a"));
    };
    const auto shell_body = [&](const char* name, double r, double q) {
        const double s = 4 * pi / 15 * (std::pow(r, 5) - std::pow(q, 5));
        if (q > 0)
            add(name, 4 * pi / 3 * (r * r * r - q * q * q), 4 * pi * (r * r + q * q), {}, diagonal(s, s, s),
                {ball_at({}, r), ball_at({}, q)}, tree("a") - tree("b"));
        else
            add(name, 4 * pi / 3 * r * r * r, 4 * pi * r * r, {}, diagonal(s, s, s), {ball_at({}, r)}, tree("a"));
    };
    shell_body("ball", 10, 0);
    block_body("box", 7, 11, 13);
    {
        const double a = 10, r = 3, v = 2 * pi * pi * a * r * r, s = v * (a * a / 2 + 3 * r * r / 8);
        add("torus", v, 4 * pi * pi * a * r, {}, diagonal(s, s, v * r * r / 4), {Tor{{}, {0, 0, 1}, a, r}}, tree("a"));
    }
    {
        const double r = 8, h = 15, v = pi * r * r * h / 3, s = 3.0 / 20 * v * r * r;
        add("cone", v, pi * r * r + pi * r * std::hypot(r, h), {0, 0, h / 4},
            diagonal(s, s, 3.0 / 80 * v * h * h + v * h * h / 16),
            {Tgc{{}, {0, 0, h}, {r, 0, 0}, {0, r, 0}, {0, 0, 0}, {0, 0, 0}}}, tree("a"));
    }
    {
        const double r = 10, half = 6;  // the lens is 8 thick
        const auto disc = [&](double z) { return r * r - z * z; };
        const double v = 2 * integral(half, r, [&](double z) { return pi * disc(z); });
        const double s = 2 * integral(half, r, [&](double z) { return pi / 4 * disc(z) * disc(z); });
        const double t = 2 * integral(half, r, [&](double z) { return pi * disc(z) * (z - half) * (z - half); });
        add("lens", v, 2 * 2 * pi * r * (r - half), {}, diagonal(s, s, t),
            {ball_at({0, 0, half}, r), ball_at({0, 0, -half}, r)}, tree("a") & tree("b"));
    }
    {
        const double r = 5;
        const auto side = [&](double z) { return r * r - z * z; };  // half a side of the square, squared
        const double s = integral(-r, r, [&](double z) { return 4.0 / 3 * side(z) * side(z); });
        const double t = integral(-r, r, [&](double z) { return 4 * z * z * side(z); });
        add("Steinmetz", 16.0 / 3 * r * r * r, 16 * r * r, {}, diagonal(s, s, t),
            {Tgc{{-9, 0, 0}, {18, 0, 0}, {0, r, 0}, {0, 0, r}, {0, r, 0}, {0, 0, r}},
             Tgc{{0, -9, 0}, {0, 18, 0}, {r, 0, 0}, {0, 0, r}, {r, 0, 0}, {0, 0, r}}},
            tree("a") & tree("b"));
    }
    {
        const double r = 10, v = 7.0 / 8 * 4 / 3 * pi * r * r * r, c = -3 * r / 56;  // without an octant
        const double s = 7.0 / 8 * 4 * pi / 15 * std::pow(r, 5), p = -std::pow(r, 5) / 15;
        add("ball less box", v, 7.0 / 8 * 4 * pi * r * r + 3 * pi * r * r / 4, {c, c, c},
            {{{s, p, p}, {p, s, p}, {p, p, s}}}, {ball_at({}, r), block({0, 0, 0}, {12, 12, 12})},
            tree("a") - tree("b"));
    }
    {
        const double r = 10, low = 4;
        const auto disc = [&](double z) { return r * r - z * z; };
        const double v = integral(low, r, [&](double z) { return pi * disc(z); });
        const double c = integral(low, r, [&](double z) { return pi * disc(z) * z; }) / v;
        const double s = integral(low, r, [&](double z) { return pi / 4 * disc(z) * disc(z); });
        const double t = integral(low, r, [&](double z) { return pi * disc(z) * z * z; });
        add("cap", v, 2 * pi * r * (r - low) + pi * disc(low), {0, 0, c}, diagonal(s, s, t),
            {ball_at({}, r), block({-12, -12, low}, {12, 12, 12})}, tree("a") & tree("b"));
    }
    {
        const double r = 5, q = 4.9, h = 40, v = pi * h * (r * r - q * q), s = v * (r * r + q * q) / 4;
        add("pipe", v, 2 * pi * h * (r + q) + 2 * pi * (r * r - q * q), {}, diagonal(s, s, v * h * h / 12),
            {round_rod(r, h), round_rod(q, h + 2)}, tree("a") - tree("b"));
    }
    shell_body("shell", 10, 10 * (1 - 1e-4));
    block_body("plate", 20, 20, 0.02);
    {
        // A ball of 10 mm, and beside it a ball of 0.01 mm, in one model.
        const double r = 10, q = 0.01, v = 4 * pi / 3 * q * q * q, s = v * q * q / 5;
        Body body{"two scales", {}, v, 4 * pi * q * q, {0, 0, 11}, diagonal(s, s, s + v * 121)};
        place(body, {ball_at({0, 0, 11}, q), ball_at({}, r)}, tree("a"));
        Combination large;
        large.name = "large";
        large.region = true;
        large.tree = tree("b");
        body.scene.objects.push_back(large);
        body.scene.top.push_back("large");
        all.push_back(std::move(body));
    }
    return all;
}

}  // namespace csgrt::test
