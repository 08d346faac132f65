// How csgrt computes and what a picture shows, as classes: the attributes, and what is said of them, are those of the
// descriptions (src/form/requests.hpp).
#include <form/camera.hpp>
#include <form/check.hpp>
#include <form/measure.hpp>

#include <nanobind/stl/set.h>

#include "values.hpp"

namespace csgrt::python {
namespace {

/// A member whose values have names in C++ (form/names.hpp), which Python's attribute takes.
template <class S, class Value, class Names>
void named(nb::class_<S>& bound, const char* name, Value S::*member, const Names& names, const char* doc) {
    bound.def_prop_rw(
        name, [&names, member](const S& s) { return std::string(name_of(names, s.*member)); },
        [&names, member, name = std::string(name)](S& s, const std::string& given) {
            const auto refusal = [](const std::string& text) { return nb::value_error(text.c_str()); };
            s.*member = value_of(names, name.c_str(), given, refusal);
        },
        doc, nb::for_getter(nb::sig(("def " + std::string(name) + "(self) -> " + literal(names)).c_str())),
        nb::for_setter(
            nb::sig(("def " + std::string(name) + "(self, arg: " + literal(names) + ", /) -> None").c_str())));
}

using Planes = std::vector<std::pair<Vec3, double>>;  ///< (normal, distance)
using Pairs = std::vector<std::pair<std::string, std::string>>;

template <class S, class Member>
void bind_member(nb::class_<S>& bound, const Member& member) {
    using Value = std::remove_cvref_t<decltype(std::declval<S&>().*member.at)>;
    const std::string text(member.key.member);
    const char* const name = text.c_str();
    std::string sentence = form::whole_sentence(member, S{}.*member.at);
    if constexpr (std::is_same_v<Value, std::vector<Plane>>) sentence += " A list of (normal, distance).";
    if constexpr (std::is_same_v<Value, std::vector<Density>>)
        sentence += " A dict of g/cm^3 by the numbers of materials or by paths.";
    if constexpr (std::is_same_v<Value, std::vector<AllowedOverlap>>)
        sentence += " A list of pairs of patterns of paths, or the path of a file that has one.";
    const char* const doc = sentence.c_str();  // nanobind copies it
    const auto at = member.at;
    if constexpr (std::is_same_v<Value, std::function<bool(double)>> ||
                  std::is_same_v<Value, std::optional<PixelRectangle>>) {
        // Ctrl-C ends a call; a part of a picture is a slice of its array.
    } else if constexpr (std::is_enum_v<Value>) {
        named(bound, name, at, *member.kind.names, doc);
    } else if constexpr (std::is_same_v<Value, std::string>) {
        bound.def_prop_rw(
            name, [at](const S& s) { return s.*at; },
            [at](S& s, const nb::object& choice) { s.*at = nb::str(choice).c_str(); },
            nb::for_setter(nb::sig("def device(self, arg: csgrt._values.DeviceChoice, /) -> None")), doc);
    } else if constexpr (std::is_same_v<Value, std::vector<Plane>>) {
        bound.def_prop_rw(
            name,
            [at](const S& s) {
                Planes planes;
                for (const Plane& p : s.*at) planes.emplace_back(p.normal, p.distance);
                return planes;
            },
            [at](S& s, const Planes& planes) {
                (s.*at).clear();
                for (const auto& [normal, distance] : planes) (s.*at).push_back({normal, distance});
            },
            doc);
    } else if constexpr (std::is_same_v<Value, std::vector<Density>>) {
        bound.def_prop_rw(
            name,
            [at](const S& s) {
                nb::dict rows;
                for (const Density& row : s.*at)
                    rows[row.path.empty() ? nb::object(nb::int_(row.material_id)) : nb::str(row.path.c_str())] =
                        row.density;
                return rows;
            },
            [at](S& s, const nb::dict& rows) {
                (s.*at).clear();
                for (const auto& [key, density] : rows) {
                    Density row;
                    const bool is_row = nb::try_cast(density, row.density) &&
                                        (nb::try_cast(key, row.material_id) || nb::try_cast(key, row.path));
                    if (!is_row) throw nb::type_error("no density of a material or a path");
                    (s.*at).push_back(std::move(row));
                }
            },
            nb::for_getter(nb::sig("def densities(self) -> dict[int | str, float]")),
            nb::for_setter(nb::sig("def densities(self, arg: dict[int | str, float], /) -> None")), doc);
    } else if constexpr (std::is_same_v<Value, std::vector<AllowedOverlap>>) {
        bound.def_prop_rw(
            name,
            [at](const S& s) {
                Pairs pairs;
                for (const AllowedOverlap& row : s.*at) pairs.emplace_back(row.first, row.second);
                return pairs;
            },
            [at](S& s, const nb::object& given) {
                if (nb::isinstance<nb::str>(given) || nb::hasattr(given, "__fspath__")) {
                    s.*at = load_allowed_overlaps(nb::cast<std::string>(nb::steal(PyOS_FSPath(given.ptr()))));
                    return;
                }
                Pairs pairs;
                bool is_list = nb::try_cast(given, pairs);
                if (is_list)  // "ab" is a pair of letters, too
                    for (const nb::handle row : given) is_list &= !nb::isinstance<nb::str>(row);
                if (!is_list) throw nb::type_error("no pairs of patterns");
                (s.*at).clear();
                for (const auto& [first, second] : pairs) (s.*at).push_back({first, second});
            },
            nb::for_getter(nb::sig("def allowed(self) -> list[tuple[str, str]]")),
            nb::for_setter(nb::sig("def allowed(self, arg: csgrt._values.AllowedPairs, /) -> None")), doc);
    } else if constexpr (std::is_same_v<Value, std::optional<Vec3>> || std::is_same_v<Value, std::optional<double>>) {
        bound.def_rw(name, at, nb::none(), doc);
    } else {
        bound.def_rw(name, at, doc);
    }
}

template <class S>
nb::class_<S> bind(nb::module_& module, const char* name, const char* doc) {
    nb::class_<S> bound(module, name, doc);
    form::for_members(form::of<S>, [&](const auto& member) { bind_member(bound, member); });
    return bound;
}

}  // namespace

void bind_settings(nb::module_& module) {
    bind<Settings>(module, "Settings",
                   "How csgrt computes. load(), parse() and Scene take any of these attributes as a keyword.")
        .def(nb::init<>());
    bind<Camera>(module, "Camera", "From where a picture is taken. Millimetres, degrees.")
        .def(nb::init<>())
        .def("_merged", [](const Camera& camera, const Camera& given, const std::set<std::string>& members) {
            const auto is_given = [&](std::string_view member) { return members.contains(std::string(member)); };
            if (const CameraConflict* conflict = conflict_of(given, is_given))
                throw nb::value_error(text_of(*conflict).c_str());
            return merged(camera, given, is_given);
        });
    bind<MeasureRequest>(module, "MeasureRequest", "What Scene.measure() shall reach, and at what cost.")
        .def(nb::init<>());
    bind<CheckRequest>(module, "CheckRequest", "What Scene.check() looks for.").def(nb::init<>());
    bind<View>(module, "View", "What a picture shows.").def(nb::init<>());
}

}  // namespace csgrt::python
