// How csgrt computes and what a picture shows, as classes whose attributes are the members of the C++ structs.
#include "values.hpp"

namespace csgrt::python {
namespace {

/// A member whose values have names in C++ (csgrt/method.hpp), which Python's attribute takes.
template <class Value, std::size_t count>
void named(nb::class_<Settings>& bound, const char* name, Value Settings::*member,
           const std::pair<std::string_view, Value> (&names)[count], const char* doc) {
    bound.def_prop_rw(
        name, [&names, member](const Settings& s) { return std::string(name_of(names, s.*member)); },
        [&names, member, name](Settings& s, const std::string& given) {
            const auto refusal = [](const std::string& text) { return nb::value_error(text.c_str()); };
            s.*member = value_of(names, name, given, refusal);
        },
        doc, nb::for_getter(nb::sig(("def " + std::string(name) + "(self) -> " + literal(names)).c_str())),
        nb::for_setter(
            nb::sig(("def " + std::string(name) + "(self, arg: " + literal(names) + ", /) -> None").c_str())));
}

}  // namespace

void bind_settings(nb::module_& module) {
    nb::class_<Settings> settings(module, "Settings",
                                  "How csgrt computes. load(), parse() and Scene take any of these "
                                  "attributes as a keyword.");
    settings.def(nb::init<>())
        .def_prop_rw(
            "device", [](const Settings& s) { return s.device; },
            [](Settings& s, const nb::object& choice) { s.device = nb::str(choice).c_str(); },
            nb::for_setter(nb::sig("def device(self, arg: csgrt._values.DeviceChoice, /) -> None")),
            "A number in devices(), \"cpu\", \"gpu\", \"gpus\" or part of a name; \"\": a GPU, else the processor")
        .def_rw("reference", &Settings::reference, "The CPU reference computes, and no device")
        .def_rw("wait_for_device", &Settings::wait_for_device, "Calls wait until a GPU's kernels are compiled")
        .def_rw("device_timeout", &Settings::device_timeout, "Seconds until a device without an answer is lost")
        .def_rw("max_memory", &Settings::max_memory, "Bytes of memory on each device; 0: what it has")
        .def_rw("max_instances", &Settings::max_instances, "Most solids as often as trees use them; 0: csgrt's limit")
        .def_rw("threads", &Settings::threads, "That work on processors at a time; 0: one for each")
        .def_rw("check", &Settings::check, "The reference traces every n-th batch as well; 0: none")
        .def_rw("tolerance", &Settings::tolerance, "Millimetres; negative: the scene's")
        .def_rw("air", &Settings::air, "Regions of air are part of the model")
        .def_rw("skip_unsupported", &Settings::skip_unsupported, "Solids of unknown types are left out, with a warning")
        .def_rw("display_shading", &Settings::display_shading, "Shade display values, as BRL-CAD does");
    named(settings, "precision", &Settings::precision, precision_names, "double or single");
    named(settings, "tolerance_rule", &Settings::tolerance_rule, tolerance_names, "surfaces, relative or none");

    nb::class_<Camera>(module, "Camera", "From where a picture is taken. Millimetres, degrees.")
        .def_rw("azimuth", &Camera::azimuth, "Of the direction to the eye: from +x about z")
        .def_rw("elevation", &Camera::elevation, "Of the same direction: above the xy plane")
        .def_rw("perspective", &Camera::perspective, "Vertical angle of view; 0: orthographic")
        .def_rw("center", &Camera::center, nb::none(), "The point in the picture's middle; None: of the model's box")
        .def_rw("view_size", &Camera::view_size, nb::none(), "Height of the view at the center; None: the diagonal")
        .def_rw("eye", &Camera::eye, nb::none(), "In place of azimuth and elevation")
        .def_rw("look_at", &Camera::look_at, nb::none(), "Another name of center")
        .def_rw("up", &Camera::up, nb::none(), "The direction that points up in the picture; None: +z");

    using Planes = std::vector<std::pair<Vec3, double>>;
    nb::class_<View>(module, "View", "What a picture shows.")
        .def(nb::init<>())
        .def_rw("width", &View::width)
        .def_rw("height", &View::height)
        .def_rw("camera", &View::camera)
        .def_rw("every_partition", &View::every_partition, "Everything along each ray, not first hits alone")
        .def_rw("samples", &View::samples, "Rays a pixel, 1 to 256")
        .def_rw("transparent", &View::transparent, "0 in all of R G B A where a ray hits nothing")
        .def_rw("channels", &View::channels)
        .def_prop_rw(
            "clip",
            [](const View& view) {
                Planes planes;
                for (const Plane& p : view.clip) planes.emplace_back(p.normal, p.distance);
                return planes;
            },
            [](View& view, const Planes& planes) {
                view.clip.clear();
                for (const auto& [normal, distance] : planes) view.clip.push_back({normal, distance});
            },
            "Up to six planes (normal, distance from the origin, mm): what is beyond any is gone");
}

}  // namespace csgrt::python
