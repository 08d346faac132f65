#include "ray_forms.hpp"

#include <map>

#include "compile/bounds/distance_bounds.hpp"

namespace csgrt::bench {
namespace {

Polynomial linear(const Interval& at_zero, const Interval& rate) {
    Polynomial p;
    p.degree = 1;
    p.c[0] = at_zero;
    p.c[1] = rate;
    return p;
}
Polynomial constant(const Interval& value) {
    Polynomial p;
    p.c[0] = value;
    return p;
}
Polynomial operator+(const Polynomial& a, const Polynomial& b) {
    Polynomial sum;
    sum.degree = std::max(a.degree, b.degree);
    for (int i = 0; i <= sum.degree; ++i) sum.c[i] = a.c[i] + b.c[i];
    return sum;
}
Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    Polynomial product;
    product.degree = a.degree + b.degree;
    for (int i = 0; i <= a.degree; ++i)
        for (int k = 0; k <= b.degree; ++k)
            product.c[i + k] = i + k == 0 ? a.c[0] * b.c[0] : product.c[i + k] + a.c[i] * b.c[k];
    return product;
}
Polynomial operator*(const Interval& factor, const Polynomial& a) {
    Polynomial product = a;
    for (int i = 0; i <= a.degree; ++i) product.c[i] = factor * a.c[i];
    return product;
}
Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + Interval(-1) * b; }
Polynomial squared(const Polynomial& a) {
    Polynomial p = a * a;
    p.c[0] = square(a.c[0]);
    p.c[2 * a.degree] = square(a.c[a.degree]);
    return p;
}

struct Local {
    Polynomial x, y, z;
    Interval o[3], d[3];
};

/// The ray in the solid's own coordinates, from `shift` on.
Local local_of(const double* p, const Ray& ray, double shift) {
    const double origin[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
    const double direction[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
    Interval from[3];
    for (int i = 0; i < 3; ++i)
        from[i] = Interval(origin[i]) - Interval(p[i]) + Interval(shift) * Interval(direction[i]);
    Local l;
    for (int row = 0; row < 3; ++row)
        for (int i = 0; i < 3; ++i) {
            const Interval at = Interval(p[3 + 3 * row + i]) * from[i];
            const Interval rate = Interval(p[3 + 3 * row + i]) * Interval(direction[i]);
            l.o[row] = i == 0 ? at : l.o[row] + at;
            l.d[row] = i == 0 ? rate : l.d[row] + rate;
        }
    l.x = linear(l.o[0], l.d[0]);
    l.y = linear(l.o[1], l.d[1]);
    l.z = linear(l.o[2], l.d[2]);
    return l;
}

}  // namespace

Interval Polynomial::over(const Interval& at) const {
    const double m = 0.5 * (at.low + at.high), r = round_up(std::max(at.high - m, m - at.low));
    Interval a[most + 1];
    for (int i = 0; i <= degree; ++i) a[i] = c[i];
    for (int i = 0; i < degree; ++i)
        for (int k = degree - 1; k >= i; --k) a[k] = a[k] + Interval(m) * a[k + 1];
    Interval sum = a[0];
    double power = 1;
    for (int i = 1; i <= degree; ++i) {
        power = round_up(power * r);
        sum = sum + a[i] * Interval(i % 2 ? -power : 0, power);
    }
    return sum;
}

Interval RayForm::Powers::over(const Interval& at) const {
    const Interval x = size_of(o[0] + at * d[0]), y = size_of(o[1] + at * d[1]), z = size_of(o[2] + at * d[2]);
    return power(power(x, p) + power(y, p), q) + power(z, r) - Interval(1);
}

void RayForm::set(const CompiledScene& scene, std::uint32_t solid, const Ray& ray) {
    shift_ = 0;
    polynomials_.clear();
    group_ends_.clear();
    powers_.clear();
    const kernel::SolidRecord& record = scene.solids[solid];
    const double* p = scene.reals.data() + record.first_real;
    const bool affine = record.type != SOLID_ARB && record.type != SOLID_HALF;
    Local l;
    if (affine) {
        // To about the closest approach, so that coefficients keep their digits; exactness does not matter.
        double od = 0, dd = 0;
        for (int row = 0; row < 3; ++row) {
            const double* m = p + 3 + 3 * row;
            const double o = m[0] * (ray.origin.x - p[0]) + m[1] * (ray.origin.y - p[1]) + m[2] * (ray.origin.z - p[2]);
            const double d = m[0] * ray.direction.x + m[1] * ray.direction.y + m[2] * ray.direction.z;
            od += o * d;
            dd += d * d;
        }
        shift_ = -od / dd;
        l = local_of(p, ray, shift_);
    }
    const auto end_group = [&] {
        for (std::uint32_t i = 0; i < record.plane_count; ++i) {
            const kernel::PlaneRef ref = scene.words[record.first_plane + i];
            const kernel::PlaneRecord& plane = scene.planes[ref >> 1];
            const Interval rate = Interval(plane.nx) * Interval(ray.direction.x) +
                                  Interval(plane.ny) * Interval(ray.direction.y) +
                                  Interval(plane.nz) * Interval(ray.direction.z);
            const auto along = [&](double o, double d) { return Interval(o) + Interval(shift_) * Interval(d); };
            const Interval at = Interval(plane.nx) * along(ray.origin.x, ray.direction.x) +
                                Interval(plane.ny) * along(ray.origin.y, ray.direction.y) +
                                Interval(plane.nz) * along(ray.origin.z, ray.direction.z) - Interval(plane.d);
            const Polynomial above = linear(at, rate);
            polynomials_.push_back(ref & 1 ? Interval(-1) * above : above);
        }
        group_ends_.push_back(polynomials_.size());
    };
    switch (record.type) {
        case SOLID_ELL:
            polynomials_.push_back(squared(l.x) + squared(l.y) + squared(l.z) - constant(1));
            break;
        case SOLID_TGC: {
            const Polynomial a = constant(p[12]) + Interval(p[13]) * l.z, b = constant(p[14]) + Interval(p[15]) * l.z;
            if (p[16] == 0)
                polynomials_.push_back(squared(l.x) + squared(l.y) - squared(a));
            else
                polynomials_.push_back(squared(l.x * b) + squared(l.y * a) - squared(a * b));
            break;
        }
        case SOLID_TOR: {
            const Interval ratio2 = square(Interval(p[12]));
            const Polynomial z2 = squared(l.z);
            polynomials_.push_back(squared(squared(l.x) + squared(l.y) + z2 - constant(Interval(1) + ratio2)) +
                                   Interval(4) * (z2 - constant(ratio2)));
            break;
        }
        case SOLID_EHY: {
            // (1 + 2 c) (x^2 + y^2) - (zeta^2 - c^2), zeta > 0
            const Polynomial zeta = constant(Interval(p[12]) + Interval(0.5)) - Interval(0.5) * l.z;
            polynomials_.push_back((Interval(1) + Interval(2) * Interval(p[12])) * (squared(l.x) + squared(l.y)) -
                                   squared(zeta) + constant(square(Interval(p[12]))));
            polynomials_.push_back(Interval(-1) * zeta);
            break;
        }
        case SOLID_QUADRIC:
            polynomials_.push_back(Interval(p[12]) * squared(l.x) + Interval(p[13]) * squared(l.y) +
                                   Interval(p[14]) * squared(l.z) + Interval(p[15]) * l.z + constant(p[16]));
            break;
        case SOLID_ETO: {
            // With R = x^2 + y^2 + 1, G = gamma z^2 - 1: F(rho) F(-rho) = E^2 - rho^2 O^2, where
            // E = alpha R - 2 beta z + G, O = 2 beta z - 2 alpha.
            const Interval alpha(p[12]), beta(p[13]), gamma(p[14]);
            const Polynomial rho2 = squared(l.x) + squared(l.y);
            const Polynomial even =
                alpha * (rho2 + constant(1)) - Interval(2) * beta * l.z + gamma * squared(l.z) - constant(1);
            const Polynomial odd = Interval(2) * (beta * l.z - constant(alpha));
            polynomials_.push_back(squared(even) - rho2 * squared(odd));
            break;
        }
        case SOLID_PART: {
            const auto ball = [&](double z, double radius) {
                return squared(l.x) + squared(l.y) + squared(l.z - constant(z)) - constant(square(Interval(radius)));
            };
            polynomials_.push_back(ball(p[12], p[13]));
            end_group();
            polynomials_.push_back(ball(p[14], p[15]));
            if (p[18] < p[19]) {
                end_group();
                polynomials_.push_back(squared(l.x) + squared(l.y) - squared(constant(p[16]) + Interval(p[17]) * l.z));
                polynomials_.push_back(constant(p[18]) - l.z);
                polynomials_.push_back(l.z - constant(p[19]));
            }
            break;
        }
        case SOLID_HRT: {
            const Polynomial x2 = squared(l.x), y2 = squared(l.y), z2 = squared(l.z), z3 = z2 * l.z;
            const Polynomial ball = x2 + Interval(2.25) * y2 + z2 - constant(1);
            const Interval eightieth(round_down(9.0 / 80), round_up(9.0 / 80));
            polynomials_.push_back(squared(ball) * ball - (x2 + eightieth * y2) * z3);
            break;
        }
        case SOLID_SUPERELL:
            powers_.push_back({{l.o[0], l.o[1], l.o[2]}, {l.d[0], l.d[1], l.d[2]}, p[12], p[13], p[14]});
            break;
        default:
            break;  // SOLID_ARB, SOLID_HALF: planes only
    }
    if (powers_.empty()) end_group();
}

Interval RayForm::over(double from, double to) const {
    const Interval u(round_down(from - shift_), round_up(to - shift_));
    if (!powers_.empty()) return powers_.front().over(u);
    Interval least(HUGE_VAL, HUGE_VAL);
    std::size_t i = 0;
    for (const std::size_t end : group_ends_) {
        Interval greatest(-HUGE_VAL, -HUGE_VAL);
        for (; i < end; ++i) {
            const Interval f = polynomials_[i].over(u);
            greatest = {std::max(greatest.low, f.low), std::max(greatest.high, f.high)};
            if (greatest.low > 0) i = end - 1;  // outside is all that matters
        }
        least = {std::min(least.low, greatest.low), std::min(least.high, greatest.high)};
        if (least.high < 0) break;
    }
    return least;
}

int RayForm::sign(double from, double to) const {
    const Interval f = over(from, to);
    return f.low > 0 ? 1 : f.high < 0 ? -1 : 0;
}

const char* type_name(std::uint32_t type) {
    static const std::map<std::uint32_t, const char*> names = {
        {SOLID_ELL, "ell"},
        {SOLID_TGC, "tgc"},
        {SOLID_ARB, "arb8 or arbn"},
        {SOLID_HALF, "half"},
        {SOLID_TOR, "tor"},
        {SOLID_EHY, "ehy"},
        {SOLID_QUADRIC, "epa, rpc, rhc or hyp"},
        {SOLID_ETO, "eto"},
        {SOLID_PART, "part"},
        {SOLID_SUPERELL, "superell"},
        {SOLID_HRT, "hrt"},
        {SOLID_METABALL, "metaball"},
        {SOLID_MESH, "bot, ars, nmg, dsp or vol"},
        {SOLID_PLATE, "bot of plates"},
        {SOLID_EXTRUDE, "extrude or ebm"},
        {SOLID_REVOLVE, "revolve"},
        {SOLID_CROSSED_ETO, "eto across its axis"},
    };
    return names.at(type);
}

std::string type_without_form(const CompiledScene& scene) {
    for (const std::uint32_t type :
         {SOLID_METABALL, SOLID_MESH, SOLID_PLATE, SOLID_EXTRUDE, SOLID_REVOLVE, SOLID_CROSSED_ETO})
        if (scene.solid_types >> type & 1) return type_name(type);
    return "";
}

std::string type_without_distance(const CompiledScene& scene) {
    const DistanceBounds bounds(scene);
    for (std::uint32_t i = 0; i < scene.solids.size(); ++i)
        if (!bounds.has(i))
            return scene.solids[i].type == SOLID_SUPERELL ? "superell with an exponent above 2"
                                                          : type_name(scene.solids[i].type);
    return "";
}

}  // namespace csgrt::bench
