#include "scene_solid.hpp"

#include <optional>
#include <utility>
#include <variant>

#include "celled.hpp"
#include "concave_arb.hpp"
#include "extruded.hpp"
#include "mesh_answer.hpp"
#include "quick.hpp"
#include "revolved.hpp"
#include "shaken.hpp"
#include "solids/all.hpp"

namespace csgrt::oracle {

namespace {

/// As far as a ray must be from it for intersect() and along() to say that it misses, and more.
template <class AnySolid>
Reach reach_of(const AnySolid& solid) {
    const double rounding = 2 * margin * ulps * double_epsilon * solid.condition;
    return {to_vec3(solid.center), 1.002 * solid.radius + rounding * (solid.placement + solid.radius), rounding};
}

/// The shaken rays of shaken.hpp as certain and possible spans.
Answer along(const ExactSolid& solid, const Ray& ray) {
    const QVec d = ray.direction, to_center = solid.center - QVec(ray.origin);
    const quad nearest = dot(to_center, d) / dot(d, d);
    if (length(to_center - nearest * d) > quad(1.001 * solid.radius)) return {};
    const double speed = to_double(length(d));
    const ShakenAnswer shaken = shake(solid, ray);
    const double moved = precision * solid.condition * solid.radius + shaken.delta;

    Answer answer;
    answer.tie = shaken.tie;
    answer.delta = shaken.delta;
    const auto spans_of = [](const ExactIntervals& intervals) {
        Spans spans;
        for (const ExactInterval& i : intervals) spans.push_back({{i.in.t, 0}, {i.out.t, 0}});
        return join(std::move(spans));
    };
    answer.inner = answer.outer = spans_of(shaken.exact);
    for (const ExactIntervals& other : shaken.shaken) {
        answer.inner = intersect(answer.inner, spans_of(other));
        answer.outer = unite(answer.outer, spans_of(other));
    }
    for (std::size_t i = 0; i < shaken.exact.size(); ++i) {
        Interval interval;
        for (const bool in : {true, false}) {
            const auto end = [&](const ExactIntervals& set) { return in ? set[i].in : set[i].out; };
            const ExactEnd exact = end(shaken.exact);
            End& e = in ? interval.in : interval.out;
            e.t = to_double(exact.t);
            const double rounding = 4 * double_epsilon * std::abs(e.t);
            if (shaken.tie) {  // and what a graze may add beyond the rays that were tried
                e.tolerance = (1e-9 * solid.radius + moved) / speed + rounding;
                continue;
            }
            quad shift = 0, turn = 0;
            for (const ExactIntervals& other : shaken.shaken) {
                shift = larger(shift, absolute(end(other).t - exact.t));
                turn = larger(turn, length(end(other).normal - exact.normal));
            }
            const double grown = moved / shaken.delta;
            e.tolerance = std::max(to_double(shift) * grown, moved / speed) + rounding;
            if (turn < quad(1e-9)) e.normal = to_vec3(exact.normal);
        }
        answer.intervals.push_back(interval);
    }
    return answer;
}

}  // namespace

SceneSolid scene_solid(ImplicitSolid&& implicit, bool quick) {
    const auto solid = std::make_shared<ImplicitSolid>(std::move(implicit));
    const Reach reach = solid->bounded ? reach_of(*solid) : Reach{};
    if (!quick) return {[solid](const Ray& ray) { return intersect(*solid, ray); }, reach, solid};
    const auto answer = [solid, filter = std::make_shared<QuickSolid>(solid)](const Ray& ray) {
        std::optional<Answer> certain = (*filter)(ray);
        return certain ? std::move(*certain) : intersect(*solid, ray);
    };
    return {answer, reach, solid};
}

SceneSolid scene_solid(const Shape& shape, const QAffine& place, double skin, bool quick) {
    const auto exact = [](ExactSolid solid) -> SceneSolid {
        const Reach reach = reach_of(solid);
        return {[solid = std::move(solid)](const Ray& ray) { return along(solid, ray); }, reach};
    };
    const auto meshed = [&](const Parts& parts) -> SceneSolid {
        const auto mesh = std::make_shared<MeshSolid>(parts, place);
        return {[mesh](const Ray& ray) { return mesh->along(ray); }, mesh->reach()};
    };
    if (const auto* bot = std::get_if<Bot>(&shape)) {
        if (bot->mode == Bot::Mode::volume) return meshed(parts_of(*bot));
        const auto plates = std::make_shared<PlateSolid>(*bot, place, skin);
        return {[plates](const Ray& r) { return plates->along(r); }, plates->reach()};
    }
    if (const auto* arb = std::get_if<Arb>(&shape); arb != nullptr && is_concave(*arb)) return meshed(parts_of(*arb));
    if (const auto* ars = std::get_if<Ars>(&shape)) return meshed(parts_of(*ars));
    if (const auto* nmg = std::get_if<Nmg>(&shape)) return meshed(parts_of(*nmg));
    if (const auto* vol = std::get_if<Vol>(&shape)) return meshed(parts_of(*vol));
    if (const auto* dsp = std::get_if<Dsp>(&shape)) return meshed(parts_of(*dsp));
    if (const auto* ebm = std::get_if<Ebm>(&shape)) return exact(celled(*ebm, place));
    if (const auto* extrude = std::get_if<Extrude>(&shape)) return exact(extruded(*extrude, place));
    if (const auto* revolve = std::get_if<Revolve>(&shape)) return exact(revolved(*revolve, place));
    return scene_solid(implicit(shape, place), quick);
}

}  // namespace csgrt::oracle
