// Rays at a surface of triangles: through its vertices and edges, along them, in the planes of its triangles.
#pragma once

#include <cmath>

#include "mesh.hpp"
#include "random.hpp"
#include "rays.hpp"

namespace csgrt::oracle {

class MeshRayMaker {
public:
    MeshRayMaker(const MeshSurface& surface, Random& random) : surface_(surface), random_(random) {}

    Ray make(RayFamily family) {
        switch (family) {
            case RayFamily::tangent:
                return grazing();
            case RayFamily::edge:
                return through_edge();
            case RayFamily::parallel:
                return along_axis();
            case RayFamily::far:
                return anywhere(random_.power(3, 6));
            case RayFamily::scaled: {
                const Ray ray = random_.coin() ? through_edge() : anywhere(3);
                return {ray.origin, to_vec3(quad(random_.power(-6, 6)) * QVec(ray.direction))};
            }
            case RayFamily::inside:
                return anywhere(random_.between(-1, 1));
            default:
                return anywhere(random_.between(1.5, 5));
        }
    }

private:
    Ray at(const QVec& target, const QVec& d, double away) const {
        return {to_vec3(target - quad(away * surface_.radius) * d), to_vec3(d)};
    }
    Ray anywhere(double away) {
        const QVec d = random_.direction();
        return at(target(), d, away);
    }
    std::size_t some_triangle() { return random_.below(surface_.size()); }
    const QVec& some_vertex() {
        const std::size_t k = random_.below(3);
        return surface_.at(some_triangle(), k);
    }
    QVec some_edge_point() {
        const std::size_t i = some_triangle(), k = random_.below(3);
        const double share = random_.coin() ? random_.unit() : 0.5;
        return surface_.at(i, k) + quad(share) * (surface_.at(i, (k + 1) % 3) - surface_.at(i, k));
    }
    /// Often within the body, now and then beside it.
    QVec target() {
        if (random_.below(8) == 0) return surface_.center + quad(surface_.radius) * random_.in_cube();
        const QVec p = some_vertex(), q = some_vertex();
        const QVec off = quad(1e-3 * surface_.radius) * random_.in_cube();
        return p + quad(random_.unit()) * (q - p) + off;
    }
    QVec direction_or(const QVec& d) { return dot(d, d) > 0 ? unit(d) : random_.direction(); }
    /// In the plane of a triangle, or a hair off it.
    Ray grazing() {
        const std::size_t i = some_triangle();
        const QVec p = surface_.at(i, 0), e = surface_.at(i, 1) - p, f = surface_.at(i, 2) - p;
        const double u = random_.between(-0.2, 1.2), b = random_.between(-1, 1), a = random_.between(-1, 1);
        QVec d = direction_or(quad(a) * e + quad(b) * f);
        QVec on = p + quad(u) * e + quad(random_.between(-0.2, 1.2 - u)) * f;
        if (random_.coin()) on = on + quad(random_.signed_power(-12, -3) * surface_.radius) * surface_.normal(i);
        if (random_.below(3) == 0) d = unit(d + random_.offset(-12, -2));
        return at(on, d, random_.between(-1, 5));
    }
    /// Through a vertex or a point of an edge: to another, along an axis, anywhere; exactly or a hair beside.
    Ray through_edge() {
        QVec p = random_.coin() ? some_vertex() : some_edge_point(), d;
        switch (random_.below(3)) {
            case 0:
                d = direction_or((random_.coin() ? some_vertex() : some_edge_point()) - p);
                break;
            case 1:
                d = random_.axis();
                break;
            default:
                d = random_.direction();
        }
        if (random_.below(3) == 0) {
            const QVec beside = random_.direction();
            p = p + quad(random_.power(-14, -3) * surface_.radius) * beside;
        }
        return at(p, d, random_.between(-1, 5));
    }
    Ray along_axis() {
        QVec d = random_.axis();
        if (random_.below(4) == 0) d = d + random_.axis();
        const QVec p = random_.coin() ? some_vertex() : random_.coin() ? some_edge_point() : target();
        const double away = random_.between(0, 5);
        return at(p, direction_or(d), away);
    }

    const MeshSurface& surface_;
    Random& random_;
};

}  // namespace csgrt::oracle
