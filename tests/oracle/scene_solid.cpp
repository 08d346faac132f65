#include "scene_solid.hpp"

#include <optional>
#include <utility>
#include <variant>

#include "extruded_cells.hpp"
#include "concave_arb.hpp"
#include "extruded.hpp"
#include "mesh_answer.hpp"
#include "filtered_solid.hpp"
#include "revolved.hpp"
#include "perturbation.hpp"
#include "solids/all.hpp"

namespace csgrt::oracle {

namespace {

/// Larger than the distance from which on intersect() and along() say that a ray misses the solid.
template <class AnySolid>
BoundingSphere bounding_sphere_of(const AnySolid& solid) {
    const double rounding = 2 * margin * ulps * double_epsilon * solid.condition;
    return {to_vec3(solid.center), 1.002 * solid.radius + rounding * (solid.placement + solid.radius), rounding};
}

/// The answers of perturbed rays as certain and possible spans.
Answer along(const ExactSolid& solid, const Ray& ray) {
    const QVec d = ray.direction, to_center = solid.center - QVec(ray.origin);
    const quad nearest = dot(to_center, d) / dot(d, d);
    if (length(to_center - nearest * d) > quad(1.001 * solid.radius)) return {};
    const double speed = to_double(length(d));
    const PerturbedAnswer perturbed = perturb(solid, ray);
    const double moved = precision * solid.condition * solid.radius + perturbed.delta;

    Answer answer;
    answer.tie = perturbed.tie;
    answer.delta = perturbed.delta;
    const auto spans_of = [](const ExactIntervals& intervals) {
        Spans spans;
        for (const ExactInterval& i : intervals) spans.push_back({{i.in.t, 0}, {i.out.t, 0}});
        return join(std::move(spans));
    };
    answer.inner = answer.outer = spans_of(perturbed.exact);
    for (const ExactIntervals& other : perturbed.perturbed) {
        answer.inner = intersect(answer.inner, spans_of(other));
        answer.outer = unite(answer.outer, spans_of(other));
    }
    for (std::size_t i = 0; i < perturbed.exact.size(); ++i) {
        Interval interval;
        for (const bool in : {true, false}) {
            const auto end = [&](const ExactIntervals& set) { return in ? set[i].in : set[i].out; };
            const ExactEnd exact = end(perturbed.exact);
            End& e = in ? interval.in : interval.out;
            e.t = to_double(exact.t);
            const double rounding = 4 * double_epsilon * std::abs(e.t);
            if (perturbed.tie) {  // and what a graze may add beyond the rays that were tried
                e.tolerance = (1e-9 * solid.radius + moved) / speed + rounding;
                continue;
            }
            quad shift = 0, turn = 0;
            for (const ExactIntervals& other : perturbed.perturbed) {
                shift = larger(shift, absolute(end(other).t - exact.t));
                turn = larger(turn, length(end(other).normal - exact.normal));
            }
            const double grown = moved / perturbed.delta;
            e.tolerance = std::max(to_double(shift) * grown, moved / speed) + rounding;
            if (turn < quad(1e-9)) e.normal = to_vec3(exact.normal);
        }
        answer.intervals.push_back(interval);
    }
    return answer;
}

}  // namespace

SceneSolid scene_solid(ImplicitSolid&& implicit, bool filtered) {
    const auto solid = std::make_shared<ImplicitSolid>(std::move(implicit));
    const BoundingSphere bounds = solid->bounded ? bounding_sphere_of(*solid) : BoundingSphere{};
    if (!filtered) return {[solid](const Ray& ray) { return intersect(*solid, ray); }, bounds, solid};
    const auto answer = [solid, filter = std::make_shared<FilteredSolid>(solid)](const Ray& ray) {
        std::optional<Answer> certain = (*filter)(ray);
        return certain ? std::move(*certain) : intersect(*solid, ray);
    };
    return {answer, bounds, solid};
}

SceneSolid scene_solid(const Shape& shape, const QAffine& place, double skin, bool filtered) {
    const auto exact = [](ExactSolid solid) -> SceneSolid {
        const BoundingSphere bounds = bounding_sphere_of(solid);
        return {[solid = std::move(solid)](const Ray& ray) { return along(solid, ray); }, bounds};
    };
    const auto meshed = [&](const Parts& parts) -> SceneSolid {
        const auto mesh = std::make_shared<MeshSolid>(parts, place);
        return {[mesh](const Ray& ray) { return mesh->along(ray); }, mesh->bounds()};
    };
    if (const auto* bot = std::get_if<Bot>(&shape)) {
        if (bot->mode == Bot::Mode::volume) return meshed(parts_of(*bot));
        const auto plates = std::make_shared<PlateSolid>(*bot, place, skin);
        return {[plates](const Ray& r) { return plates->along(r); }, plates->bounds()};
    }
    if (const auto* arb = std::get_if<Arb>(&shape); arb != nullptr && is_concave(*arb)) return meshed(parts_of(*arb));
    if (const auto* ars = std::get_if<Ars>(&shape)) return meshed(parts_of(*ars));
    if (const auto* nmg = std::get_if<Nmg>(&shape)) return meshed(parts_of(*nmg));
    if (const auto* vol = std::get_if<Vol>(&shape)) return meshed(parts_of(*vol));
    if (const auto* dsp = std::get_if<Dsp>(&shape)) return meshed(parts_of(*dsp));
    if (const auto* ebm = std::get_if<Ebm>(&shape)) return exact(extruded_cells(*ebm, place));
    if (const auto* extrude = std::get_if<Extrude>(&shape)) return exact(extruded(*extrude, place));
    if (const auto* revolve = std::get_if<Revolve>(&shape)) return exact(revolved(*revolve, place));
    return scene_solid(implicit(shape, place), filtered);
}

}  // namespace csgrt::oracle
