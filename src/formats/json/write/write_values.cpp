#include "formats/json/angle.hpp"
#include "formats/json/forms.hpp"
#include "formats/json/placement.hpp"
#include "formats/json/write/write_form.hpp"
#include "formats/json/write/write_object.hpp"

namespace csgrt {

using nlohmann::ordered_json;

ordered_json write_value(form::Loops, const std::vector<Nmg::Loop>& face, JsonUnit&) {
    if (face.size() == 1 && !face.front().empty()) return face.front();
    return face;
}

ordered_json write_value(form::Curves, const Sketch& sketch, JsonUnit& unit) {
    ordered_json curves = ordered_json::array();
    for (std::size_t i = 0; i < sketch.curves.size(); ++i) {
        ordered_json curve = std::visit([&](const auto& c) { return write_form(c, unit); }, sketch.curves[i]);
        const auto* arc = std::get_if<Sketch::Arc>(&sketch.curves[i]);
        if (arc != nullptr && arc->radius == -1 && !arc->center_left && !arc->clockwise)
            curve = write_form(form::Circle{arc->end, arc->start}, unit);
        const bool reversed = i < sketch.reversed.size() && sketch.reversed[i] != 0;
        if (reversed || (i == 0 && !sketch.reversed.empty())) curve["reversed"] = reversed;
        curves.push_back(std::move(curve));
    }
    return curves;
}

void write_placement(ordered_json& out, const form::Placement& kind, const Matrix& m, JsonUnit& unit) {
    if (same_bits(m, usual_placement(kind, unit.millimetres()))) return;
    ordered_json matrix = ordered_json::array();
    for (std::size_t i = 0; i < m.size(); ++i) {
        matrix.push_back(is_length(kind, i) ? unit.length(m[i]) : unit.number(m[i]));
    }
    out["matrix"] = std::move(matrix);
}

void write_turn(ordered_json& out, form::Turn, double angle, JsonUnit& unit) {
    if (const auto degrees = degrees_of(unit.number(angle))) {
        out["angle"] = *degrees;
    } else {
        out["radians"] = angle;
    }
}

namespace {

/// Writes the shape in a simple form. False if the form does not fit.
template <class S, class Simple>
bool write_as(const S& s, JsonUnit& unit, ordered_json& out) {
    if constexpr (std::is_same_v<S, Simple>) {
        out = write_form(s, unit);
        return true;
    } else {
        Simple simple;
        if (!simplify(s, simple)) return false;
        out = write_form(simple, unit);
        return true;
    }
}

template <class S, class... Forms>
ordered_json write_first(const S& s, JsonUnit& unit, const std::tuple<Forms...>*) {
    ordered_json out = ordered_json::object();
    (void)(write_as<S, Forms>(s, unit, out) || ...);
    return out;
}

}  // namespace

ordered_json json_of(const Shape& shape, JsonUnit& unit) {
    return std::visit(
        [&]<class S>(const S& s) {
            return write_first(s, unit, static_cast<const typename JsonFormsOf<S>::Types*>(nullptr));
        },
        shape);
}

}  // namespace csgrt
