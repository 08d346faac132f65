#include "compile/flatten/solid_parts.hpp"

#include <cmath>

#include "scene/solids/arb_form.hpp"
#include "scene/vector.hpp"

namespace csgrt {

namespace {

/// The sine of an angle: two directions with a smaller angle count as one straight line.
constexpr double straight = 1e-9;
/// The length of a part of a pipe, relative to its width, below which the part is left out.
constexpr double shortest = 1e-9;

Vec3 across(const Vec3& axis) {
    const Vec3 u = unit(axis);
    const double x = std::abs(u.x), y = std::abs(u.y), z = std::abs(u.z);
    const Vec3 side = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    return unit(cross(u, side));
}

Tgc round_cone(const Vec3& v, const Vec3& h, double radius, double top_radius) {
    const Vec3 a = across(h), b = cross(unit(h), a);
    return {v, h, radius * a, radius * b, top_radius * a, top_radius * b};
}

/// A round bend from `from` to `to`, on the circle around `center`. The pipe meets the circle at right angles to the
/// radius.
struct Bend {
    Vec3 center, axis;
    double radius;
    Vec3 from, to;   ///< ends of the centre line
    Vec3 into, out;  ///< unit directions of the pipe at `from` and `to`
};

SolidPart bend_part(const Bend& bend, double tube) {
    return {Tor{bend.center, bend.axis, bend.radius, tube},
            {{-1 * bend.into, -dot(bend.into, bend.from)}, {bend.out, dot(bend.out, bend.to)}}};
}

/// The collector makes a tube of its parts: the union of the outer parts minus the union of the inner parts.
class Collector {
public:
    void outer(SolidPart part) { add(std::move(part), outer_); }
    void inner(SolidPart part) { add(std::move(part), inner_); }

    SolidParts take() {
        FlatTree& tree = result_.tree;
        const auto united = [&](const std::vector<std::uint32_t>& numbers) {
            for (const std::uint32_t number : numbers) tree.nodes.push_back({Operator::leaf, 0, number});
            if (numbers.size() > 1)
                tree.nodes.push_back({Operator::union_, static_cast<std::uint32_t>(numbers.size()), 0});
        };
        united(outer_);
        united(inner_);
        if (!inner_.empty()) tree.nodes.push_back({Operator::difference, 2, 0});
        return std::move(result_);
    }

private:
    void add(SolidPart part, std::vector<std::uint32_t>& list) {
        list.push_back(static_cast<std::uint32_t>(result_.parts.size()));
        result_.parts.push_back(std::move(part));
    }

    SolidParts result_;
    std::vector<std::uint32_t> outer_, inner_;
};

SolidParts parts_of_pipe(const Pipe& pipe) {
    Collector collector;
    Vec3 at = pipe.points.front().position;  // the beginning of the straight part
    for (std::size_t i = 0; i + 1 < pipe.points.size(); ++i) {
        const Pipe::Point &p = pipe.points[i], &q = pipe.points[i + 1];
        const Vec3 into = unit(q.position - p.position);
        std::optional<Bend> bend;
        Vec3 to = q.position;
        if (i + 2 < pipe.points.size()) {
            const Vec3 out = unit(pipe.points[i + 2].position - q.position);
            const Vec3 normal = cross(into, out);
            const double sine = length(normal), cosine = dot(into, out);
            if (sine > straight) {
                // bend x tan(half the angle); if the pipe turns nearly back, 1 + cosine has few digits
                const double tangent = q.bend * (cosine > -0.5 ? sine / (1 + cosine) : (1 - cosine) / sine);
                const Vec3 inward = cross(unit(normal), into);
                to = q.position - tangent * into;
                bend = Bend{to + q.bend * inward, unit(normal), q.bend, to, q.position + tangent * out, into, out};
            }
        }
        const Vec3 h = to - at;
        if (dot(h, into) > shortest * (p.outer + q.outer)) {
            collector.outer({round_cone(at, h, p.outer / 2, q.outer / 2), {}});
            if (p.inner > 0 || q.inner > 0) collector.inner({round_cone(at, h, p.inner / 2, q.inner / 2), {}});
        }
        if (bend) {
            collector.outer(bend_part(*bend, q.outer / 2));
            if (q.inner > 0) collector.inner(bend_part(*bend, q.inner / 2));
        }
        at = bend ? bend->to : to;
    }
    return collector.take();
}

SolidParts parts_of_cline(const Cline& cline) {
    Collector collector;
    collector.outer({round_cone(cline.v, cline.h, cline.radius, cline.radius), {}});
    const double bore = cline.radius - cline.thickness;
    if (cline.thickness > 0 && bore > 0) collector.inner({round_cone(cline.v, cline.h, bore, bore), {}});
    return collector.take();
}

/// The surface of a concave arb's faces.
SolidParts parts_of_concave(const Arb& arb) {
    Nmg surface;
    surface.vertices.assign(arb.vertices.begin(), arb.vertices.end());
    for (auto& outline : outlines_of(arb)) surface.faces.push_back({std::move(outline)});
    Collector collector;
    collector.outer({std::move(surface), {}});
    return collector.take();
}

}  // namespace

SolidParts parts_of(const Shape& shape) {
    if (const auto* arb = std::get_if<Arb>(&shape)) return parts_of_concave(*arb);
    if (const auto* pipe = std::get_if<Pipe>(&shape)) return parts_of_pipe(*pipe);
    if (const auto* cline = std::get_if<Cline>(&shape)) return parts_of_cline(*cline);
    return {};
}

}  // namespace csgrt
