// Boxes of solids of a closed form: tight around points of their surfaces,
// under any matrix.
#include <functional>
#include <random>

#include "catch.hpp"
#include "compile/bounds/bounds.hpp"
#include "compile/linear.hpp"
#include "sanitized.hpp"

using namespace csgrt;

namespace {

constexpr double pi = 3.14159265358979323846;

struct Random {
    std::mt19937 engine{11};
    double operator()(double low = -1, double high = 1) {
        return std::uniform_real_distribution<double>(low, high)(engine);
    }
    Wide wide() { return {(*this)(), (*this)(), (*this)()}; }
    Matrix matrix() {
        Matrix m{};
        for (const std::size_t i : {0, 1, 2, 4, 5, 6, 8, 9, 10}) m[i] = (*this)();
        for (const std::size_t i : {0, 5, 10}) m[i] += m[i] < 0 ? -2 : 2;
        for (const std::size_t i : {3, 7, 11}) m[i] = (*this)(-50, 50);
        m[15] = 1;
        return m;
    }
};

/// A point of the surface for u and w from 0 to 1.
using Surface = std::function<Wide(long double u, long double w)>;

/// `around` lies within the solid's box, whose sides are no farther off than a
/// part of the diagonal.
void check_box(const Box& box, const Box& around, double part) {
    const double slack = part * diagonal(around);
    const auto fits = [&](double low, double high, double inner_low, double inner_high) {
        CHECK(low <= inner_low);
        CHECK(high >= inner_high);
        CHECK(inner_low - low < slack);
        CHECK(high - inner_high < slack);
    };
    fits(box.low.x, box.high.x, around.low.x, around.high.x);
    fits(box.low.y, box.high.y, around.low.y, around.high.y);
    fits(box.low.z, box.high.z, around.low.z, around.high.z);
}

void check_tight(const Shape& shape, const Matrix& m, const Surface& surface) {
    Box around = empty_box;
    constexpr int steps = 400;
    for (int i = 0; i <= steps; ++i)
        for (int k = 0; k <= steps; ++k)
            extend(around, narrow(transform_point(m, surface(1.0L * i / steps, 1.0L * k / steps))));
    check_box(solid_box(shape, m), around, 1e-3);
}

Wide on_circle(const Wide& x, const Wide& y, long double u) {
    return std::cos(2 * static_cast<long double>(pi) * u) * x + std::sin(2 * static_cast<long double>(pi) * u) * y;
}

/// Three random axes at right angles.
struct Axes {
    Wide x, y, z;
    explicit Axes(Random& random) {
        z = glm::normalize(random.wide());
        x = glm::normalize(glm::cross(z, random.wide()));
        y = glm::cross(z, x);
    }
};

}  // namespace

TEST_CASE(
    "the boxes of paraboloids and of parabolic and hyperbolic cylinders "
    "are tight") {
    Random random;
    for (int round = 0; round < test::tries(12); ++round) {
        const Matrix m = random.matrix();
        const Axes axes(random);
        const Wide v = 3.0L * random.wide(), h = axes.z * static_cast<long double>(random(0.5, 3));
        const double r = random(0.3, 2), q = random(0.3, 2), c = random(0.05, 1);
        const Wide a = axes.x * static_cast<long double>(r), b = axes.y * static_cast<long double>(q);
        check_tight(Epa{narrow(v), narrow(h), narrow(axes.x), r, q}, m,
                    [&](long double u, long double w) { return v + w * on_circle(a, b, u) + (1 - w * w) * h; });
        // The rim of either end: the outline of both cylinders.
        const auto cylinder = [&](const auto& half_width) -> Surface {
            return [&, half_width](long double u, long double w) {
                const long double side = 1 - 2 * w;
                const long double depth = side * side;  // denser near the vertex
                const Wide across = (side < 0 ? -1.0L : 1.0L) * half_width(depth) * b;
                return v + (u < 0.5L ? Wide(0) : axes.x) + across + (1 - depth) * h;
            };
        };
        check_tight(Rpc{narrow(v), narrow(axes.x), narrow(h), q}, m,
                    cylinder([](long double depth) { return std::sqrt(depth); }));
        const long double k = static_cast<long double>(c) / glm::length(h);
        check_tight(Rhc{narrow(v), narrow(axes.x), narrow(h), q, c}, m,
                    cylinder([k](long double depth) { return std::sqrt(depth * (depth + 2 * k) / (1 + 2 * k)); }));
    }
}

TEST_CASE("the boxes of hyperboloids and elliptical tori are tight") {
    Random random;
    for (int round = 0; round < test::tries(12); ++round) {
        const Matrix m = random.matrix();
        const Axes axes(random);
        const Wide v = 3.0L * random.wide(), h = axes.z * static_cast<long double>(random(0.5, 3));
        const double r = random(0.3, 2), q = random(0.3, 2), neck = random(0.05, 0.95);
        const Wide a = axes.x * static_cast<long double>(r), b = axes.y * static_cast<long double>(q);
        check_tight(Hyp{narrow(v), narrow(h), narrow(a), q, neck}, m, [&](long double u, long double w) {
            const long double z = 2 * w - 1, n = static_cast<long double>(neck) * neck;
            return v + w * h + std::sqrt(n + (1 - n) * z * z) * on_circle(a, b, u);
        });
        const long double angle = random(-3, 3), big = random(0.1, 0.6), small = random(0.1, 0.6);
        const Wide out = std::fabs(std::sin(angle)) * axes.x + std::cos(angle) * axes.z;
        const Eto eto{narrow(v), narrow(h), narrow(big * out), 1, static_cast<double>(small)};
        check_tight(eto, m, [&](long double u, long double w) {
            const Wide p = on_circle(big * out, small * glm::cross(axes.y, out), w);
            const long double radial = 1 + glm::dot(p, axes.x);
            return v + glm::dot(p, axes.z) * axes.z + radial * on_circle(axes.x, axes.y, u);
        });
    }
}

TEST_CASE("the box of a particle is that of its two balls") {
    Random random;
    for (int round = 0; round < test::tries(12); ++round) {
        const Matrix m = random.matrix();
        const Axes axes(random);
        const Wide v = 3.0L * random.wide(), h = random.wide();
        const double r_v = random(0, 2), r_h = random(0.1, 2);
        check_tight(Part{narrow(v), narrow(h), r_v, r_h}, m, [&](long double u, long double w) {
            const long double t = w < 0.5L ? 4 * w - 1 : 4 * w - 3;
            const Wide p = std::sqrt(std::fmax(0.0L, 1 - t * t)) * on_circle(axes.x, axes.y, u) + t * axes.z;
            return w < 0.5L ? v + static_cast<long double>(r_v) * p : v + h + static_cast<long double>(r_h) * p;
        });
    }
}

TEST_CASE(
    "the box of a superellipsoid is tight, for exponents that bulge and "
    "that pinch") {
    Random random;
    for (int round = 0; round < test::tries(6); ++round) {
        const Matrix m = random.matrix();
        const Axes axes(random);
        const Wide v = 3.0L * random.wide(), a = 2.0L * axes.x, b = axes.y + 0.3L * axes.x, c = 0.5L * axes.z;
        const double n = random(0.2, 3), e = random(0.2, 3);
        const auto power = [](long double x, double exponent) {
            return std::copysign(std::pow(std::fabs(x), static_cast<long double>(exponent)), x);
        };
        check_tight(Superell{narrow(v), narrow(a), narrow(b), narrow(c), n, e}, m, [&](long double u, long double w) {
            const long double angle = 2 * static_cast<long double>(pi) * u,
                              height = static_cast<long double>(pi) * (w - 0.5L);
            return v + power(std::cos(height), n) * (power(std::cos(angle), e) * a + power(std::sin(angle), e) * b) +
                   power(std::sin(height), n) * c;
        });
    }
}

TEST_CASE("the box of a heart is tight") {
    Random random;
    // Where the ray from the centre leaves the heart.
    const auto on_heart = [](const Wide& d) {
        long double low = 0, high = 2;
        for (int step = 0; step < 60; ++step) {
            const Wide p = 0.5L * (low + high) * d;
            const long double a = p.x * p.x + 2.25L * p.y * p.y + p.z * p.z - 1, z3 = p.z * p.z * p.z;
            (a * a * a < (p.x * p.x + p.y * p.y * 9 / 80) * z3 ? low : high) = 0.5L * (low + high);
        }
        return low * d;
    };
    for (int round = 0; round < test::tries(3); ++round) {
        const Matrix m = random.matrix();
        const Axes axes(random);
        const Wide v = 3.0L * random.wide();
        const WideMatrix frame(2.0L * axes.x, axes.y + 0.3L * axes.x, 0.5L * axes.z);
        check_tight(Hrt{narrow(v), narrow(frame[0]), narrow(frame[1]), narrow(frame[2]), 1}, m,
                    [&](long double u, long double w) {
                        const long double height = static_cast<long double>(pi) * (w - 0.5L);
                        return v + frame * on_heart(std::cos(height) * on_circle(Wide(1, 0, 0), Wide(0, 1, 0), u) +
                                                    Wide(0, 0, std::sin(height)));
                    });
    }
}

TEST_CASE("the box of a metaball holds it, and not much more") {
    Random random;
    using Method = Metaball::Method;
    for (const Method method : {Method::metaball, Method::isopotential, Method::blob}) {
        const Matrix m = random.matrix();
        Metaball ball{.method = method, .threshold = 0.5};
        for (int i = 0; i < 3; ++i) ball.points.push_back({narrow(random.wide()), random(0.4, 0.9), random(0.5, 2)});
        Box around = empty_box;
        constexpr int steps = test::sanitized ? 45 : 90;
        constexpr double reach = 4;
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; j <= steps; ++j)
                for (int k = 0; k <= steps; ++k) {
                    const Wide p(reach * (2.0 * i / steps - 1), reach * (2.0 * j / steps - 1),
                                 reach * (2.0 * k / steps - 1));
                    long double sum = 0;
                    for (const Metaball::Point& point : ball.points) {
                        const Wide from = p - wide(point.position);
                        const long double x = glm::dot(from, from) / (point.strength * point.strength);
                        if (method == Method::metaball) sum += x < 1 ? (1 - x) * (1 - x) : 0;
                        if (method == Method::isopotential) sum += 1 / x;
                        if (method == Method::blob) sum += std::exp(point.softness * (1 - x));
                    }
                    if (sum >= ball.threshold) extend(around, narrow(transform_point(m, p)));
                }
        check_box(solid_box(ball, m), around, 3.6 / steps);
    }
    const Metaball alone{Method::isopotential, 4, {{{1, 2, 3}, 2, 1}}};  // a ball of radius 1
    check_box(solid_box(alone, identity), {{0, 1, 2}, {2, 3, 4}}, 1e-3);
}
