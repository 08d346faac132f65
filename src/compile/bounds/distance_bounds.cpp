#include "distance_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace csgrt {
namespace {

bool has_body(const kernel::SolidRecord& record) { return record.type != SOLID_ARB && record.type != SOLID_HALF; }

/// L's largest singular value: the root of the largest eigenvalue of M = L' L, by Cardano's formula in its
/// trigonometric form, and a little more for its rounding.
double largest_stretch(const double* l) {
    double m[3][3];
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) m[i][k] = l[i] * l[k] + l[3 + i] * l[3 + k] + l[6 + i] * l[6 + k];
    const double mean = (m[0][0] + m[1][1] + m[2][2]) / 3;
    const double a = m[0][0] - mean, b = m[1][1] - mean, c = m[2][2] - mean;
    const double off2 = m[0][1] * m[0][1] + m[0][2] * m[0][2] + m[1][2] * m[1][2];
    const double spread = std::sqrt((a * a + b * b + c * c + 2 * off2) / 6);
    if (!(spread > 0)) return std::sqrt(mean) * (1 + 1e-9);
    const double determinant = a * (b * c - m[1][2] * m[1][2]) - m[0][1] * (m[0][1] * c - m[1][2] * m[0][2]) +
                               m[0][2] * (m[0][1] * m[1][2] - b * m[0][2]);
    const double cosine = std::clamp(0.5 * determinant / (spread * spread * spread), -1.0, 1.0);
    // The arc cosine's error near -1 and 1 is the root of its argument's, and the cosine's of a third of it its square.
    return std::sqrt(mean + 2 * spread * std::cos(std::acos(cosine) / 3)) * (1 + 1e-7);
}

/// max(|x|, |y|) as the p-norm grows with p; what the norm is at most on the unit circle.
double norm_slope(double p) { return p >= 2 ? 1 : std::pow(2, 1 / p - 0.5); }

bool is_paraboloid(const double* p) { return p[14] == 0 && p[15] != 0; }

/// The steepest slope of rho - k z: across the axis that of rho, along it k. The two are added like perpendicular ones
/// if the axis is perpendicular to the sections, as rows of L are then.
double slope_of_cone(const double* l, double k) {
    const auto dot = [&](int i, int j) { return l[i] * l[j] + l[i + 1] * l[j + 1] + l[i + 2] * l[j + 2]; };
    const double xx = dot(0, 0), yy = dot(3, 3), xy = dot(0, 3), zz = dot(6, 6);
    const double across = std::sqrt(0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy)),
                 along = std::sqrt(zz) * std::abs(k);
    const bool is_right =
        std::abs(dot(0, 6)) <= 1e-9 * std::sqrt(xx * zz) && std::abs(dot(3, 6)) <= 1e-9 * std::sqrt(yy * zz);
    return (is_right ? std::hypot(across, along) : across + along) * (1 + 1e-9);
}

/// The steepest slope of a body's function, in millimetres; infinite: it has none.
double slope(const kernel::SolidRecord& record, const double* p) {
    double s = 1;  // in the body's coordinates
    switch (record.type) {
        case SOLID_TGC:
            if (p[16] == 0) return slope_of_cone(p + 3, p[13]);
            break;
        case SOLID_ELL:
        case SOLID_TOR:
        case SOLID_PART:
            break;
        case SOLID_EHY:
            s = std::sqrt(1 + 0.25 / (1 + 2 * p[12]));
            break;
        case SOLID_QUADRIC:
            s = is_paraboloid(p) ? 2 : std::sqrt(1 - p[14]);
            break;
        case SOLID_ETO:
            s = std::sqrt(0.5 * (p[12] + p[14]) + std::hypot(0.5 * (p[12] - p[14]), p[13]));
            break;
        case SOLID_SUPERELL:
            if (p[12] >= 1 && p[14] >= 1) {
                s = norm_slope(p[12]) * norm_slope(p[14]);
                break;
            }
            [[fallthrough]];
        default:
            return HUGE_VAL;
    }
    return (1 + 1e-12) * s * largest_stretch(p + 3);
}

/// Whether the body is convex, and its function, too.
bool has_convex_body(const kernel::SolidRecord& record, const double* p) {
    switch (record.type) {
        case SOLID_TGC:
            return p[16] == 0;
        case SOLID_QUADRIC:
            return is_paraboloid(p);
        default:
            return record.type != SOLID_TOR && record.type != SOLID_ETO;
    }
}

/// A cone or cylinder whose semi-axes a(z) and b(z) taper differently, all of it within x^2 + y^2 <= 1. With h the
/// lesser of the two, g = |(x h / a, y h / b)| - h has the slope 1 across the axis. Along it one of the quotients
/// changes, by no more than (|a'| + |b'|) / max(a, b), times x or y: so these are taken from the nearest point of the
/// unit circle. (a and b are never both 0: they would taper alike.)
double two_tapers(const double* p, double x, double y, double z) {
    const double rho = std::sqrt(x * x + y * y), within = rho > 1 ? 1 / rho : 1, at = std::clamp(z, -1.0, 1.0);
    const double a = std::max(0.0, p[12] + p[13] * at), b = std::max(0.0, p[14] + p[15] * at), h = std::min(a, b);
    const double u = within * x * (h == a ? 1 : h / a), v = within * y * (h == b ? 1 : h / b);
    // max(a, b) is least at an end, or where a = b.
    double least = std::min(std::max(p[12] - p[13], p[14] - p[15]), std::max(p[12] + p[13], p[14] + p[15]));
    const double meet = (p[14] - p[12]) / (p[13] - p[15]);
    if (std::abs(meet) < 1) least = std::min(least, p[12] + p[13] * meet);
    const double along = (std::abs(p[13]) + std::abs(p[15])) / least + std::max(std::abs(p[13]), std::abs(p[15]));
    return std::max((std::sqrt(u * u + v * v) - h) / std::hypot(1, along), rho - 1);
}

/// The body's function.
double local(const kernel::SolidRecord& record, const double* p, double x, double y, double z) {
    switch (record.type) {
        case SOLID_ELL:
            return std::sqrt(x * x + y * y + z * z) - 1;
        case SOLID_TGC:
            if (p[16] != 0) return two_tapers(p, x, y, z);
            return std::sqrt(x * x + y * y) - (p[12] + p[13] * z);  // from the axis, less the radius there
        case SOLID_TOR: {
            const double radial = std::sqrt(x * x + y * y) - 1;
            return std::sqrt(radial * radial + z * z) - p[12];
        }
        case SOLID_EHY: {  // sqrt(rho^2 + k c^2) - sqrt(k) zeta
            const double root_k = std::sqrt(1 / (1 + 2 * p[12])), gap = root_k * p[12];
            return std::sqrt(x * x + y * y + gap * gap) - root_k * (p[12] + 0.5 * (1 - z));
        }
        case SOLID_QUADRIC: {
            const double rho2 = p[12] * x * x + p[13] * y * y;
            // A paraboloid: the distance from the focus, less that from the directrix, w below the vertex.
            if (is_paraboloid(p)) {
                const double w = 1 - z;
                return std::sqrt(rho2 + (w - 0.25) * (w - 0.25)) - (w + 0.25);
            }
            const double root_k = std::sqrt(-p[14]);
            if (p[12] == 0) {  // hyperbolic cylinder: y^2 + k c^2 - k (z + c)^2, c = linear / (2 qz)
                const double c = p[15] / (2 * p[14]), gap = root_k * c;
                return std::sqrt(rho2 + gap * gap) - root_k * std::abs(z + c);
            }
            return std::sqrt(rho2) - std::sqrt(-p[14] * z * z - p[16]);  // hyperboloid of one sheet
        }
        case SOLID_ETO: {
            const double radial = std::sqrt(x * x + y * y) - 1;
            const double form = p[12] * radial * radial + 2 * p[13] * radial * z + p[14] * z * z;
            return std::sqrt(std::max(0.0, form)) - 1;
        }
        case SOLID_PART: {
            const double rho = std::sqrt(x * x + y * y);
            const auto ball = [&](double center, double radius) {
                return std::sqrt(rho * rho + (z - center) * (z - center)) - radius;
            };
            if (!(p[18] < p[19])) return std::min(ball(p[12], p[13]), ball(p[14], p[15]));
            // Along the cone's side, in its section: nearest to one ball, to the side, or to the other.
            const double secant = std::hypot(1, p[17]), along = (p[17] * rho + z);
            const auto foot = [&](double at) { return p[17] * (p[16] + p[17] * at) + at; };
            if (along <= foot(p[18])) return ball(p[12], p[13]);
            if (along >= foot(p[19])) return ball(p[14], p[15]);
            return (rho - p[16] - p[17] * z) / secant;
        }
        default: {  // SOLID_SUPERELL: a norm, less 1
            const double q = std::pow(std::pow(std::abs(x), p[12]) + std::pow(std::abs(y), p[12]), p[13]);
            return std::pow(q + std::pow(std::abs(z), p[14]), 1 / p[14]) - 1;
        }
    }
}

/// The slopes of a convex body's function; 0 where it has a kink. `g`: three numbers.
void local_slope(const kernel::SolidRecord& record, const double* p, double x, double y, double z, double* g) {
    const auto set = [g](double gx, double gy, double gz, double length) {
        g[0] = length > 0 ? gx / length : 0;
        g[1] = length > 0 ? gy / length : 0;
        g[2] = length > 0 ? gz / length : 0;
    };
    const double rho = std::sqrt(x * x + y * y);
    switch (record.type) {
        case SOLID_ELL:
            return set(x, y, z, std::sqrt(x * x + y * y + z * z));
        case SOLID_TGC:
            set(x, y, 0, rho);
            g[2] = -p[13];
            return;
        case SOLID_EHY: {
            const double root_k = std::sqrt(1 / (1 + 2 * p[12])), gap = root_k * p[12];
            set(x, y, 0, std::sqrt(x * x + y * y + gap * gap));
            g[2] = 0.5 * root_k;
            return;
        }
        case SOLID_QUADRIC: {
            const double w = 1 - z, rho2 = p[12] * x * x + p[13] * y * y;
            set(p[12] * x, p[13] * y, 0.25 - w, std::sqrt(rho2 + (w - 0.25) * (w - 0.25)));
            g[2] += 1;
            return;
        }
        case SOLID_PART: {
            const auto ball = [&](double center) { set(x, y, z - center, std::hypot(rho, z - center)); };
            const auto of_ball = [&](int i) { return std::hypot(rho, z - p[i]) - p[i + 1]; };
            if (!(p[18] < p[19])) return ball(of_ball(12) <= of_ball(14) ? p[12] : p[14]);
            const double secant = std::hypot(1, p[17]), along = p[17] * rho + z;
            const auto foot = [&](double at) { return p[17] * (p[16] + p[17] * at) + at; };
            if (along <= foot(p[18])) return ball(p[12]);
            if (along >= foot(p[19])) return ball(p[14]);
            set(x, y, 0, rho * secant);
            g[2] = -p[17] / secant;
            return;
        }
        default: {
            const double a = std::pow(std::abs(x), p[12]) + std::pow(std::abs(y), p[12]), q = std::pow(a, p[13]),
                         all = q + std::pow(std::abs(z), p[14]);
            const auto power = [](double base, double of) { return base > 0 ? std::pow(base, of) : 0; };
            const double outer = power(all, 1 / p[14] - 1) / p[14], inner = outer * p[13] * power(a, p[13] - 1) * p[12];
            g[0] = std::copysign(inner * power(std::abs(x), p[12] - 1), x);
            g[1] = std::copysign(inner * power(std::abs(y), p[12] - 1), y);
            g[2] = std::copysign(outer * p[14] * power(std::abs(z), p[14] - 1), z);
        }
    }
}

}  // namespace

DistanceBounds::DistanceBounds(const CompiledScene& scene) : scene_(scene) {
    for (const kernel::SolidRecord& record : scene.solids)
        scales_.push_back(has_body(record) ? 1 / slope(record, scene.reals.data() + record.first_real) : 1);
}

double DistanceBounds::body(std::uint32_t solid, const Vec3& point, Vec3* slope) const {
    const kernel::SolidRecord& record = scene_.solids[solid];
    const double* p = scene_.reals.data() + record.first_real;
    const double dx = point.x - p[0], dy = point.y - p[1], dz = point.z - p[2];
    const double x = p[3] * dx + p[4] * dy + p[5] * dz, y = p[6] * dx + p[7] * dy + p[8] * dz,
                 z = p[9] * dx + p[10] * dy + p[11] * dz;
    if (slope) {
        double g[3];
        local_slope(record, p, x, y, z, g);
        const auto along = [&](int axis) {
            return scales_[solid] * (g[0] * p[3 + axis] + g[1] * p[6 + axis] + g[2] * p[9 + axis]);
        };
        *slope = {along(0), along(1), along(2)};
    }
    return scales_[solid] * local(record, p, x, y, z);
}

template <class Take>
void DistanceBounds::for_planes(std::uint32_t solid, const Take& take) const {
    const kernel::SolidRecord& record = scene_.solids[solid];
    for (std::uint32_t i = 0; i < record.plane_count; ++i) {
        const kernel::PlaneRef ref = scene_.words[record.first_plane + i];
        const kernel::PlaneRecord& plane = scene_.planes[ref >> 1];
        const double sign = ref & 1 ? -1 : 1;
        take(Vec3{sign * plane.nx, sign * plane.ny, sign * plane.nz}, sign * plane.d);
    }
}

double DistanceBounds::at(std::uint32_t solid, const Vec3& point) const {
    double f = has_body(scene_.solids[solid]) ? body(solid, point) : -HUGE_VAL;
    for_planes(solid,
               [&](const Vec3& n, double d) { f = std::max(f, n.x * point.x + n.y * point.y + n.z * point.z - d); });
    return f;
}

void DistanceBounds::append_pieces(std::uint32_t solid, const Vec3& point, double reach,
                                   std::vector<Piece>& pieces) const {
    const kernel::SolidRecord& record = scene_.solids[solid];
    if (const double distance = has_body(record) ? body(solid, point) : 0; has_body(record) && distance >= -reach) {
        Piece piece{.distance = distance,
                    .is_convex = has_convex_body(record, scene_.reals.data() + record.first_real)};
        if (piece.is_convex) {
            body(solid, point, &piece.slope);
        } else {
            const Box& box = scene_.solid_boxes[solid];
            const Vec3 size{box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z};
            const double step = 1e-6 * std::sqrt(size.x * size.x + size.y * size.y + size.z * size.z);
            for (double Vec3::*const axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
                Vec3 before = point, after = point;
                before.*axis -= step;
                after.*axis += step;
                piece.slope.*axis = (body(solid, after) - body(solid, before)) / (after.*axis - before.*axis);
            }
        }
        pieces.push_back(piece);
    }
    for_planes(solid, [&](const Vec3& n, double d) {
        const double distance = n.x * point.x + n.y * point.y + n.z * point.z - d;
        if (distance >= -reach) pieces.push_back({distance, n, true, true});
    });
}

}  // namespace csgrt
