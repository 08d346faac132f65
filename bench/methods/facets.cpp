#include "facets.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <unordered_map>
#include <utility>

#include "compile/linear.hpp"
#include "compile/solids/meshes/mesh_repair.hpp"
#include "compile/solids/polyhedron.hpp"
#include "loft.hpp"
#include "scene/vector.hpp"

namespace csgrt::bench {
namespace {

using std::numbers::pi;
using Corner = std::array<std::uint32_t, 3>;

[[noreturn]] void refuse(const std::string& why) { throw Error(Status::usage, why); }

/// A convex polyhedron, as loops of corners, counterclockwise when seen from outside.
struct Polyhedron {
    std::vector<Vec3> corners;
    std::vector<std::vector<std::uint32_t>> faces;

    explicit Polyhedron(const Box& b) {
        for (unsigned i = 0; i < 8; ++i)
            corners.push_back({i & 1 ? b.high.x : b.low.x, i & 2 ? b.high.y : b.low.y, i & 4 ? b.high.z : b.low.z});
        faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    }

    /// Keeps what is inside of the plane. What is within rounding of it counts as inside.
    void cut(const Plane& plane, double rounding) {
        std::vector<double> above;
        for (const Vec3& p : corners) {
            const double height = dot(plane.normal, p) - plane.distance;
            above.push_back(std::abs(height) <= rounding ? 0 : height);
        }
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings;
        const auto crossing = [&](std::uint32_t a, std::uint32_t b) {
            if (above[a] == 0) return a;
            if (above[b] == 0) return b;
            if (a > b) std::swap(a, b);
            const auto [found, is_new] = crossings.try_emplace({a, b}, static_cast<std::uint32_t>(corners.size()));
            if (is_new) {
                corners.push_back(corners[a] + (above[a] / (above[a] - above[b])) * (corners[b] - corners[a]));
                above.push_back(0);
            }
            return found->second;
        };
        std::vector<std::vector<std::uint32_t>> kept;
        std::map<std::uint32_t, std::uint32_t> rim;  // of the new face, from each corner to the next
        for (const auto& face : faces) {
            std::vector<std::uint32_t> loop;
            std::uint32_t leaves = 0, enters = 0;
            bool is_cut = false;
            for (std::size_t i = 0; i < face.size(); ++i) {
                const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
                if (above[a] <= 0) loop.push_back(a);
                if (above[a] <= 0 && above[b] > 0) {
                    leaves = crossing(a, b);
                    if (loop.back() != leaves) loop.push_back(leaves);
                    is_cut = true;
                } else if (above[a] > 0 && above[b] <= 0) {
                    enters = crossing(a, b);
                    if (enters != b) loop.push_back(enters);
                    is_cut = true;
                }
            }
            if (loop.size() >= 3) kept.push_back(loop);
            if (is_cut && leaves != enters && loop.size() >= 2) rim[enters] = leaves;
        }
        faces = std::move(kept);
        if (rim.empty()) return;
        std::vector<std::uint32_t> loop;
        for (std::uint32_t at = rim.begin()->first; loop.size() < rim.size(); at = rim.at(at)) loop.push_back(at);
        if (loop.size() >= 3) faces.push_back(loop);
    }

    Triangles mesh() const {
        Triangles mesh{corners, {}};
        for (const auto& face : faces)
            for (std::size_t i = 1; i + 1 < face.size(); ++i) mesh.triangle(face[0], face[i], face[i + 1]);
        return mesh;
    }
};

/// Without vertices that no triangle has, equal ones as one, and triangles that this closes to nothing.
Triangles welded(const Triangles& mesh) {
    Triangles result;
    std::map<std::array<double, 3>, std::uint32_t> known;
    const auto number = [&](std::uint32_t v) {
        const Vec3& p = mesh.vertices[v];
        const auto [at, is_new] =
            known.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0}, static_cast<std::uint32_t>(result.vertices.size()));
        if (is_new) result.vertices.push_back(p);
        return at->second;
    };
    for (const Corner& face : mesh.faces) {
        const std::uint32_t a = number(face[0]), b = number(face[1]), c = number(face[2]);
        if (a != b && b != c && c != a) result.triangle(a, b, c);
    }
    return result;
}

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

/// Turns triangles over so that neighbours run along their edges in opposite directions. False: that cannot be.
bool orient(Triangles& mesh) {
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> at_edge;
    const auto edges = [&](std::size_t face, const auto& work) {
        for (std::size_t k = 0; k < 3; ++k) work(mesh.faces[face][k], mesh.faces[face][(k + 1) % 3]);
    };
    for (std::size_t i = 0; i < mesh.faces.size(); ++i)
        edges(i, [&](std::uint32_t a, std::uint32_t b) {
            at_edge[edge_key(std::min(a, b), std::max(a, b))].push_back(i);
        });
    for (const auto& [edge, faces] : at_edge)
        if (faces.size() != 2) return false;
    std::vector<char> done(mesh.faces.size(), 0);
    for (std::size_t seed = 0; seed < mesh.faces.size(); ++seed) {
        if (done[seed]) continue;
        std::vector<std::size_t> part{seed};
        done[seed] = 1;
        for (std::size_t i = 0; i < part.size(); ++i) {
            std::vector<std::pair<std::size_t, bool>> next;
            edges(part[i], [&](std::uint32_t a, std::uint32_t b) {
                const auto& faces = at_edge[edge_key(std::min(a, b), std::max(a, b))];
                const std::size_t other = faces[faces[0] == part[i] ? 1 : 0];
                bool is_same_way = false;
                edges(other,
                      [&](std::uint32_t c, std::uint32_t d) { is_same_way = is_same_way || (a == c && b == d); });
                next.emplace_back(other, is_same_way);
            });
            for (const auto& [other, is_same_way] : next) {
                if (done[other]) continue;
                done[other] = 1;
                if (is_same_way) std::swap(mesh.faces[other][1], mesh.faces[other][2]);
                part.push_back(other);
            }
        }
    }
    return is_closed(mesh);
}

/// How far below its vertex a hyperbola is y wide, in units of its height and of its width there. c in the same unit.
double hyperbola(double y, double c) { return (1 + 2 * c) * y * y / (c + std::sqrt(c * c + (1 + 2 * c) * y * y)); }

double signed_power(double x, double exponent) { return std::copysign(std::pow(std::abs(x), exponent), x); }

struct Faceter {
    const Matrix& matrix;
    const FacetOptions& options;

    Triangles loft(const Loft& loft) const { return mesh_of(loft, matrix, options); }
    static Vec3 on(const Vec3& x, const Vec3& y, double t) {
        // Exact at multiples of a quarter turn, so that what meets there meets.
        const double quarters = t / (pi / 2), nearest = std::round(quarters);
        if (std::abs(quarters - nearest) < 1e-12) {
            const int k = static_cast<int>(nearest) & 3;
            return k == 0 ? x : k == 1 ? y : -1 * (k == 2 ? x : y);
        }
        return std::cos(t) * x + std::sin(t) * y;
    }

    Triangles operator()(const Ell& s) const {
        Loft all{[&](double p, double t) { return s.v + on(on(s.a, s.b, t), s.c, p); }, {-pi / 2, 0, pi / 2}};
        all.first = all.last = Loft::End::point;
        return loft(all);
    }
    Triangles operator()(const Tgc& s) const {
        Loft all{
            [&](double z, double t) { return s.v + z * s.h + on((1 - z) * s.a + z * s.c, (1 - z) * s.b + z * s.d, t); },
            {0, 1}};
        const Vec3 none{};
        if (s.a == none && s.b == none) all.first = Loft::End::point;
        if (s.c == none && s.d == none) all.last = Loft::End::point;
        return loft(all);
    }
    Triangles operator()(const Tor& s) const {
        const Vec3 n = unit(s.h), x = unit(cross(n, std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
        const Vec3 y = cross(n, x);
        Loft all{[&, n, x, y](double u, double t) {
                     const Vec3 out = on(x, y, u);
                     return s.v + s.r_a * out + on(s.r_h * out, s.r_h * n, t);
                 },
                 quarters()};
        all.is_ring = true;
        return loft(all);
    }
    Triangles operator()(const Eto& s) const {
        const Vec3 n = unit(s.n), x = unit(cross(n, std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
        const Vec3 y = cross(n, x);
        const double up = dot(s.c, n), out = length(s.c - up * n), size = length(s.c);
        const double out2 = -up / size * s.r_d, up2 = out / size * s.r_d;
        if (std::hypot(out, out2) > s.r) refuse("an eto whose ellipse reaches across the axis");
        Loft all{[&, n, x, y](double u, double t) {
                     const double radius = s.r + std::cos(t) * out + std::sin(t) * out2;
                     return s.v + radius * on(x, y, u) + (std::cos(t) * up + std::sin(t) * up2) * n;
                 },
                 quarters()};
        all.is_ring = true;
        return loft(all);
    }
    Triangles operator()(const Ehy& s) const {
        const Vec3 a = s.r_1 * unit(s.a), b = s.r_2 * unit(cross(s.h, s.a));
        const double c = s.c / length(s.h);
        Loft all{[&, a, b, c](double r, double t) { return s.v + (1 - hyperbola(r, c)) * s.h + r * on(a, b, t); },
                 {0, 1}};
        all.first = Loft::End::point;
        return loft(all);
    }
    Triangles operator()(const Epa& s) const {
        const Vec3 a = s.r_1 * unit(s.a), b = s.r_2 * unit(cross(s.h, s.a));
        Loft all{[&, a, b](double r, double t) { return s.v + (1 - r * r) * s.h + r * on(a, b, t); }, {0, 1}};
        all.first = Loft::End::point;
        return loft(all);
    }
    Triangles operator()(const Hyp& s) const {
        const Vec3 b = s.b * unit(cross(s.h, s.a));
        const double neck2 = s.neck * s.neck;
        return loft({[&, b, neck2](double z, double t) {
                         return s.v + (1 + z) / 2 * s.h + std::sqrt((1 - neck2) * z * z + neck2) * on(s.a, b, t);
                     },
                     {-1, 0, 1}});
    }
    Triangles operator()(const Part& s) const {
        const double size = length(s.h), slope = (s.r_v - s.r_h) / size;
        if (!(std::abs(slope) < 1)) {
            const bool is_first = s.r_v >= s.r_h;
            const double r = is_first ? s.r_v : s.r_h;
            return (*this)(Ell{is_first ? s.v : s.v + s.h, {r, 0, 0}, {0, r, 0}, {0, 0, r}});
        }
        const Vec3 n = unit(s.h), x = unit(cross(n, std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
        const Vec3 y = cross(n, x);
        const double tilt = std::asin(slope);
        // Sections 0 to 1: the ball at v; 1 to 2: the cone; 2 to 3: the ball at v + h.
        const auto profile = [=, &s](double u) -> std::pair<double, double> {
            const auto ball = [](double center, double r, double angle) {
                return std::pair{center + r * std::sin(angle), r * std::cos(angle)};
            };
            if (u <= 1) return u == 0 ? std::pair{-s.r_v, 0.0} : ball(0, s.r_v, -pi / 2 + u * (tilt + pi / 2));
            if (u >= 2)
                return u == 3 ? std::pair{size + s.r_h, 0.0} : ball(size, s.r_h, tilt + (u - 2) * (pi / 2 - tilt));
            const auto a = ball(0, s.r_v, tilt), b = ball(size, s.r_h, tilt);
            return {a.first + (u - 1) * (b.first - a.first), a.second + (u - 1) * (b.second - a.second)};
        };
        Loft all{[&, n, x, y, profile](double u, double t) {
                     const auto [along, radius] = profile(u);
                     return s.v + along * n + radius * on(x, y, t);
                 },
                 {}};
        all.sections = s.r_v == 0   ? std::vector<double>{1, 2, 3}
                       : s.r_h == 0 ? std::vector<double>{0, 1, 2}
                                    : std::vector<double>{0, 1, 2, 3};
        all.first = all.last = Loft::End::point;
        return loft(all);
    }
    /// Rpc and rhc: an outline from one end of the base to the other, moved along h.
    Triangles trough(const Vec3& v, const Vec3& h, const Vec3& b, double r,
                     const std::function<double(double)>& below) const {
        const Vec3 side = r * unit(cross(h, b));
        Loft all{[&, side](double z, double y) { return v + z * h + y * side + (1 - below(y)) * b; }, {0, 1}};
        all.angles = {-1, 0, 1};
        all.is_round = false;
        return loft(all);
    }
    Triangles operator()(const Rpc& s) const {
        return trough(s.v, s.h, s.b, s.r, [](double y) { return y * y; });
    }
    Triangles operator()(const Rhc& s) const {
        const double c = s.c / length(s.b);
        return trough(s.v, s.h, s.b, s.r, [c](double y) { return hyperbola(y, c); });
    }
    Triangles operator()(const Superell& s) const {
        const auto power = [](double t, double exponent) {
            const Vec3 p = on({1, 0, 0}, {0, 1, 0}, t);
            return std::pair{signed_power(p.x, exponent), signed_power(p.y, exponent)};
        };
        Loft all{[&, power](double p, double t) {
                     const auto [radius, z] = power(p, s.n);
                     const auto [x, y] = power(t, s.e);
                     return s.v + radius * x * s.a + radius * y * s.b + z * s.c;
                 },
                 {-pi / 2, 0, pi / 2}};
        all.first = all.last = Loft::End::point;
        return loft(all);
    }

    Triangles operator()(const Half& s) const {
        Polyhedron all(options.around);
        all.cut(transform_plane(matrix, s.plane), rounding());
        return all.mesh();
    }
    Triangles operator()(const Arbn& s) const {
        Polyhedron all(options.around);
        for (const Plane& plane : arbn_faces(s, matrix)) all.cut(plane, rounding());
        return all.mesh();
    }
    double rounding() const { return coordinate_rounding * largest_coordinate(options.around); }

    Triangles operator()(const Arb& s) const {
        Nmg all;
        all.vertices.assign(s.vertices.begin(), s.vertices.end());
        for (const Nmg::Loop& face :
             {Nmg::Loop{0, 1, 2, 3}, {7, 6, 5, 4}, {4, 7, 3, 0}, {1, 2, 6, 5}, {0, 4, 5, 1}, {3, 2, 6, 7}}) {
            Nmg::Loop loop;  // without the corners that an arb4 to arb7 repeats
            for (const std::uint32_t v : face) {
                const auto first = std::find(all.vertices.begin(), all.vertices.end(), all.vertices[v]);
                const auto number = static_cast<std::uint32_t>(first - all.vertices.begin());
                if (std::find(loop.begin(), loop.end(), number) == loop.end()) loop.push_back(number);
            }
            if (loop.size() >= 3) all.faces.push_back({loop});
        }
        return placed(triangles_of(all), matrix);
    }
    Triangles operator()(const Bot& s) const {
        if (s.mode != Bot::Mode::volume) refuse("a bot without an inside");
        const RepairedMesh repaired = repair(s);
        if (!repaired.is_closed) refuse("a bot with open edges");
        return placed(repaired.mesh, matrix);
    }
    Triangles operator()(const Ars& s) const { return placed(triangles_of(s), matrix); }
    Triangles operator()(const Nmg& s) const { return placed(triangles_of(s), matrix); }
    Triangles operator()(const Dsp& s) const { return placed(triangles_of(s), compose(matrix, s.matrix)); }
    Triangles operator()(const Vol& s) const { return placed(triangles_of(s), compose(matrix, grid_matrix(s))); }
    template <class Other>
    Triangles operator()(const Other& s) const {
        refuse(std::string("solids of the type ") + type_name(Shape(s)));
    }

    /// What triangles make: they become neighbours where their corners are equal.
    static Triangles placed(const Triangles& mesh, const Matrix& m) {
        Triangles result = welded(mesh);
        if (!orient(result)) refuse("a mesh with an edge that has not two triangles");
        for (Vec3& p : result.vertices) p = narrow(transform_point(m, wide(p)));
        return result;
    }
};

}  // namespace

double volume(const Triangles& mesh) {
    if (mesh.vertices.empty()) return 0;
    const Vec3 from = mesh.vertices.front();
    double six = 0;
    for (const Corner& face : mesh.faces)
        six += dot(mesh.vertices[face[0]] - from, cross(mesh.vertices[face[1]] - from, mesh.vertices[face[2]] - from));
    return six / 6;
}

bool is_closed(const Triangles& mesh) {
    std::unordered_map<std::uint64_t, int> runs;
    for (const Corner& face : mesh.faces)
        for (std::size_t k = 0; k < 3; ++k) ++runs[edge_key(face[k], face[(k + 1) % 3])];
    return std::all_of(runs.begin(), runs.end(), [&](const auto& run) {
        const auto back = runs.find(run.first << 32 | run.first >> 32);
        return run.second == 1 && back != runs.end() && back->second == 1;
    });
}

Triangles box_facets(const Box& box) { return Polyhedron(box).mesh(); }

Triangles facets(const Shape& shape, const Matrix& matrix, const FacetOptions& options) {
    Triangles mesh = std::visit(Faceter{matrix, options}, static_cast<const Shape::variant&>(shape));
    if (mesh.faces.size() > options.most) refuse_size();
    if (volume(mesh) < 0)
        for (Corner& face : mesh.faces) std::swap(face[1], face[2]);
    return mesh;
}

}  // namespace csgrt::bench
