#include "rays.hpp"

#include <cmath>
#include <variant>

#include "solids/metaball.hpp"
#include "solids/polyhedron.hpp"

namespace csgrt::oracle {

namespace {

struct FeatureFinder {
    Features& features;

    /// In the solid's own frame.
    void point(quad x, quad y, quad z) const { features.points.push_back({x, y, z}); }
    void direction(quad x, quad y, quad z) const { features.directions.push_back({x, y, z}); }
    void axes() const { direction(1, 0, 0), direction(0, 1, 0), direction(0, 0, 1); }

    void operator()(const Ell&) const {
        for (const double s : {-1, 1}) point(s, 0, 0), point(0, s, 0), point(0, 0, s);
        point(0, 0, 0);
        axes();
    }
    void operator()(const Tgc& tgc) const {
        const quad a = length(tgc.a), b = length(tgc.b), c = length(tgc.c), d = length(tgc.d);
        const quad x0 = a / larger(a, c), x1 = c / larger(a, c), y0 = b / larger(b, d), y1 = d / larger(b, d);
        for (const double s : {-1, 1}) {
            point(s * x0, 0, 0), point(0, s * y0, 0), point(s * x1, 0, 1), point(0, s * y1, 1);
            direction(s * (x1 - x0), 0, 1), direction(0, s * (y1 - y0), 1);  // generators: parallel to the flank
        }
        point(0, 0, 0), point(0, 0, 1);
        axes();
    }
    void operator()(const Tor& tor) const {
        const quad k = quad(tor.r_h) / tor.r_a;
        for (const double s : {-1, 1})
            for (const double r : {-1, 1})
                point(s * (1 + r * k), 0, 0), point(0, s * (1 + r * k), 0), point(s, 0, r * k);
        point(0, 0, 0), point(0, 0, k), point(0, 0, -k);
        axes();
        const quad across = root(1 - k * k);  // Villarceau's direction: touches the
                                              // tube on both sides of the hole
        direction(across, 0, k), direction(across, 0, -k);
    }
    void operator()(const Ehy& ehy) const {
        const quad h = length(ehy.h), c = ehy.c, steep = h / root(h * h + 2 * h * c);
        for (const double s : {-1, 1}) {
            point(s, 0, 1), point(0, s, 1);
            direction(s * steep, 0, 1), direction(0, s * steep, 1);  // along the asymptotes
        }
        point(0, 0, 0), point(0, 0, 1);
        axes();
    }
    void operator()(const Part& part) const {
        const quad h = length(part.h), unit = larger(h, larger(part.r_v, part.r_h));
        const quad top = h / unit, v = part.r_v / unit, r = part.r_h / unit, sine = h > 0 ? (v - r) / top : quad(0);
        for (const double s : {-1, 1}) {
            point(s * v, 0, 0), point(0, s * r, top);
            if (sine * sine < 1) {  // the circles of touch, and a generator
                const quad cosine = root(1 - sine * sine);
                point(s * v * cosine, 0, v * sine), point(s * r * cosine, 0, top + r * sine);
                direction(-s * sine, 0, cosine);
            }
        }
        point(0, 0, -v), point(0, 0, top + r), point(0, 0, 0);
        axes();
    }
    void operator()(const Epa&) const {
        for (const double s : {-1, 1}) point(s, 0, 0), point(0, s, 0), direction(s, 0, 2), direction(0, s, 2);
        point(0, 0, 0), point(0, 0, 1);
        axes();
    }
    void operator()(const Rpc&) const { cylinder(1); }
    void operator()(const Rhc& rhc) const { cylinder(1 / root(1 + 2 * rhc.c / length(rhc.b))); }
    /// `steep`: of the asymptotes, or some other direction across.
    void cylinder(quad steep) const {
        for (const double x : {0, 1})
            for (const double y : {-1, 1}) point(x, y, 0), point(x, 0, 1), direction(0, y * steep, 1);
        axes();
    }
    void operator()(const Hyp& hyp) const {
        const quad neck = hyp.neck, steep = root(1 - neck * neck);
        for (const double s : {-1, 1}) {
            point(s, 0, 1), point(0, s, -1), point(s * neck, 0, 0), point(0, s * neck, 0);
            direction(s * steep, 0, 1), direction(0, s * steep, 1);  // along the cone of asymptotes
        }
        point(0, 0, 0);
        axes();
    }
    void operator()(const Eto& eto) const {
        const QVec axis = unit(eto.n), c = (1 / quad(eto.r)) * QVec(eto.c);
        const quad up = dot(c, axis), out = length(c - up * axis), d = quad(eto.r_d) / (length(c) * quad(eto.r));
        for (const double s : {-1, 1})
            for (const double t : {-1, 1})
                point(s * (1 + t * out), 0, t * up), point(0, s * (1 - t * d * up), t * d * out);
        point(0, 0, 0), point(1, 0, 0), point(0, -1, 0);
        direction(out, 0, up), direction(-up, 0, out);
        axes();
    }
    void operator()(const Superell&) const {
        for (const double s : {-1, 1}) {
            point(s, 0, 0), point(0, s, 0), point(0, 0, s);
            direction(1, s, 0), direction(0, 1, s), direction(s, 0, 1);
        }
        point(0, 0, 0);
        axes();
    }
    void operator()(const Hrt&) const {
        for (const double s : {-1, 1}) point(0, 0, s), point(s, 0, 0), point(0, quad(2 * s) / 3, 0), point(s, 0, 0.75);
        direction(1, 0, 1), direction(0, 2, 3);
        axes();
    }
    void operator()(const Metaball& ball) const {
        const MetaballFunction f = metaball_function(ball).first;
        for (std::size_t i = 0; i < f.points.size(); ++i) {
            const QVec p = f.points[i].at, q = f.points[(i + 1) % f.points.size()].at;
            point(p.x, p.y, p.z), point((p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2);
            direction(p.x - q.x, p.y - q.y, p.z - q.z);
        }
        axes();
    }
    void operator()(const Half& half) const {
        const QVec n = half.plane.normal, across = any_across(n);
        features.points = {{}, across, cross(n, across)};
        features.directions = {across, cross(n, across), n};
    }
    void vertices(const std::vector<QVec>& vertices) const {
        QVec mean;
        for (const QVec& p : vertices) mean = mean + (1 / quad(static_cast<double>(vertices.size()))) * p;
        for (const QVec& p : vertices) features.points.push_back(p - mean);
        for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
            features.directions.push_back(vertices[i + 1] - vertices[i]);
    }
    void operator()(const Arb& arb) const { vertices({arb.vertices.begin(), arb.vertices.end()}); }
    void operator()(const Arbn& arbn) const { vertices(vertices_of(arbn.planes)); }
    template <class Other>
    void operator()(const Other&) const {}
};

}  // namespace

Features features_of(const Shape& shape, const ImplicitSolid& solid) {
    Features features;
    std::visit(FeatureFinder{features}, shape);
    for (QVec& p : features.points) p = solid.to_world.point(p);
    for (QVec& d : features.directions) d = solid.to_world.direction(d);
    std::erase_if(features.directions, [](const QVec& d) { return !(dot(d, d) > 0); });
    return features;
}

Ray edge_ray(const Features& features, const quad& size, Random& random) {
    const auto pick = [&](const std::vector<QVec>& from) -> const QVec& { return from[random.below(from.size())]; };
    QVec p = pick(features.points);
    if (random.coin()) {
        const QVec way = pick(features.points) - p;
        p = p + quad(random.unit()) * way;
    }
    QVec d;
    switch (random.below(4)) {
        case 0:
            d = pick(features.points) - p;
            break;
        case 1:
            d = random.axis();
            break;
        case 2:
            d = random.direction();
            break;
        default:
            d = pick(features.directions);
    }
    if (!(dot(d, d) > 0)) d = random.axis();
    d = unit(d);
    if (random.coin()) p = p + random.offset(-12, -1, size);
    if (random.below(4) == 0) d = unit(d + random.offset(-12, -1));
    const quad sign = random.sign();
    return {to_vec3(p - quad(random.between(-1, 5)) * size * d), to_vec3(sign * d)};
}

RayMaker::RayMaker(const Shape& shape, const ImplicitSolid& solid, Random& random)
    : solid_(solid),
      features_(features_of(shape, solid)),
      random_(random),
      size_(solid.bounded ? solid.radius : 1 + 0.1 * solid.size) {
    for (int tries = 0; tries < 40 && touched_.size() < 8; ++tries) {
        const Answer answer = intersect(solid_, ordinary(4));
        for (const Interval& i : answer.intervals)
            for (const End& e : {i.in, i.out})
                if (std::isfinite(e.t) && !answer.tie) touched_.push_back({last_.point(e.t), e.normal});
    }
}

Ray RayMaker::make(RayFamily family) {
    switch (family) {
        case RayFamily::tangent:
            return tangent();
        case RayFamily::edge:
            return edge_ray(features_, size(), random_);
        case RayFamily::parallel:
            return parallel();
        case RayFamily::far:
            return ordinary(1e5);
        case RayFamily::scaled: {
            Ray ray = any();
            const quad s = random_.power(-6, 6);
            return rounded(ray.origin, s * QVec(ray.direction));
        }
        case RayFamily::inside:
            return inside();
        default:
            return ordinary(random_.between(1.5, 5));
    }
}

Ray RayMaker::rounded(const QVec& o, const QVec& d) { return {to_vec3(o), to_vec3(d)}; }

QVec RayMaker::target() {
    if (random_.coin()) return solid_.center + size() * random_.in_cube();
    const QVec p = random_point(), q = random_point();
    const QVec off = quad(0.05) * size() * random_.in_cube();
    return p + quad(random_.unit()) * (q - p) + off;
}

Ray RayMaker::ordinary(double away) {
    const QVec o = solid_.center + quad(away) * size() * random_.direction();
    const Ray ray = rounded(o, unit(target() - o));
    last_ = {ray.origin, ray.direction};
    return ray;
}

Ray RayMaker::any() {
    switch (random_.below(3)) {
        case 0:
            return tangent();
        case 1:
            return edge_ray(features_, size(), random_);
        default:
            return ordinary(3);
    }
}

const QVec& RayMaker::random_point() { return features_.points[random_.below(features_.points.size())]; }

Ray RayMaker::tangent() {
    if (touched_.empty()) return ordinary(3);
    const Touched& t = touched_[random_.below(touched_.size())];
    const QVec across = any_across(t.normal), other = cross(t.normal, across);
    const double turn = random_.between(-3.2, 3.2);
    QVec d = quad(std::cos(turn)) * across + quad(std::sin(turn)) * other;
    if (!solid_.bounded) d = unit(d + quad(random_.signed_power(-12, 0)) * t.normal);
    const QVec p = t.point + quad(random_.signed_power(-12, -3)) * size() * t.normal;
    return rounded(p - quad(random_.between(0, 5)) * size() * d, d);
}

Ray RayMaker::parallel() {
    QVec d = random_.axis();
    if (random_.coin()) d = features_.directions[random_.below(features_.directions.size())];
    if (random_.below(4) == 0) {
        const QVec axis = random_.axis();
        d = d + quad(random_.unit()) * axis;
    }
    if (!(dot(d, d) > 0)) d = {1, 0, 0};
    d = unit(d);
    const quad back = quad(random_.between(0, 5)) * size();
    return rounded(target() - back * d, d);
}

Ray RayMaker::inside() {
    Ray through = ordinary(2);
    Answer answer = intersect(solid_, through);
    for (int tries = 0; tries < 20 && answer.intervals.empty(); ++tries) {
        through = ordinary(2);
        answer = intersect(solid_, through);
    }
    if (answer.intervals.empty()) return through;
    const Interval& i = answer.intervals[random_.below(answer.intervals.size())];
    const double in = std::isfinite(i.in.t) ? i.in.t : -3 * size_, out = std::isfinite(i.out.t) ? i.out.t : 3 * size_;
    const QVec d = random_.direction();
    return rounded(last_.point(random_.between(in, out)), d);
}

}  // namespace csgrt::oracle
