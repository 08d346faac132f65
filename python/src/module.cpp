// The module csgrt._core: what has no scene, and what is done before there is one.
#include "values.hpp"

namespace csgrt::python {
namespace {

using Unlocked = nb::call_guard<nb::gil_scoped_release>;

Rows device_rows() {
    std::vector<DeviceInfo> found;
    {
        nb::gil_scoped_release unlocked;
        found = devices();
    }
    Rows rows;
    for (const DeviceInfo& d : found) rows.append(row_of(d));
    return rows;
}

Numpy<double> rays_of(const RayGrid& grid) {
    auto rays = std::make_unique<std::vector<Ray>>();
    {
        nb::gil_scoped_release unlocked;
        *rays = grid.rays();
    }
    Ray* const data = rays->data();
    return array(data, {std::size_t(grid.rows), std::size_t(grid.columns)}, keeper(rays));
}

Numpy<double> parallel(const Box& box, const std::string& axis, std::pair<int, int> pixels) {
    const auto refusal = [](const std::string& text) { return nb::value_error(text.c_str()); };
    const Axis along = value_of(axis_names, "the axis of parallel rays", axis, refusal);
    return rays_of(rays_parallel(box, along, pixels.first, pixels.second));
}

Numpy<double> pinhole(double vertical_fov, const Vec3& center, const Vec3& eye, const Vec3& up, int width, int height) {
    return rays_of(rays_pinhole(vertical_fov, center, eye, up, width, height));
}

}  // namespace

NB_MODULE(_core, module) {
    using namespace nb::literals;
    nb::set_leak_warnings(false);  // a program that ends with scenes in hand is no fault
    bind_errors(module);
    bind_settings(module);
    nb::class_<Scene>(module, "Source", "A scene as it was read. A Scene takes what is in it.");
    bind_scene(module);
    module.attr("version") = version();
    module.attr("region_members") = sentences<RegionInfo>();
    module.attr("solid_members") = sentences<SolidInfo>();
    module.attr("child_members") = sentences<ChildInfo>();
    module.attr("device_members") = sentences<DeviceInfo>();
    module.attr("overlap_members") = sentences<FoundOverlap>();
    module.attr("unlisted_members") = sentences<UnlistedPair>();
    nb::dict channels;
    for (const auto& [name, bits] : channel_names) channels[std::string(name).c_str()] = bits;
    module.attr("channels") = channels;
    module.def(
        "load",
        [](const std::string& path, bool strict, std::vector<std::string> folders, const Settings& settings) {
            prepare_devices(settings);
            return load_scene(path, {.strict = strict, .file_folders = std::move(folders)});
        },
        "path"_a, "strict"_a, "file_folders"_a, "settings"_a, Unlocked());
    module.def(
        "parse",
        [](const nb::bytes& text, const std::string& name, bool strict, std::vector<std::string> folders) {
            std::string contents(text.c_str(), text.size());
            nb::gil_scoped_release unlocked;
            return parse_scene(std::move(contents), name, {.strict = strict, .file_folders = std::move(folders)});
        },
        "text"_a, "name"_a, "strict"_a, "file_folders"_a);
    module.def("device_rows", &device_rows);
    module.def("rays_parallel", &parallel, "bounds"_a, "axis"_a, "pixels"_a,
               nb::sig("def rays_parallel(bounds: csgrt._values.TwoPoints, axis: typing.Literal['x', 'y', 'z'], "
                       "pixels: tuple[int, int]) -> numpy.typing.NDArray[numpy.float64]"),
               "Parallel rays along an axis, upward, through the middles of the cells of a box's face.\n\n"
               "bounds: (low, high), mm; axis: \"x\", \"y\" or \"z\"; pixels: (columns, rows). They start 1 mm before "
               "the box.\nReturns (rows, columns, 6) float64: origin, direction. The top row has the largest z (y, if "
               "the axis is z).\nRaises csgrt.Error (usage) for an empty box.");
    module.def("rays_pinhole", &pinhole, "vertical_fov"_a, "center"_a, "eye"_a, "up"_a, "width"_a, "height"_a,
               "Rays from an eye through the middles of a picture's pixels, with unit directions.\n\n"
               "vertical_fov: degrees between the upper and lower edge; center: the point in the picture's middle, mm."
               "\nReturns (height, width, 6) float64: origin, direction. Raises csgrt.Error (usage).");
}

}  // namespace csgrt::python
