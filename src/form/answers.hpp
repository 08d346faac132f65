// Descriptions of the public structs that calls return, and of further arguments (requests.hpp describes settings and
// views). A JSON key with a point is a member of an inner object: "ms.load".
#pragma once

#include <csgrt/device.hpp>
#include <csgrt/model.hpp>
#include <csgrt/partitions.hpp>
#include <csgrt/rays.hpp>
#include <csgrt/statistics.hpp>
#include <csgrt/view.hpp>

#include "form/names.hpp"

namespace csgrt::form {

template <>
inline constexpr auto of<Ray> = Form{
    plain("ray"),
    required("origin", &Ray::origin, vector, "Millimetres."),
    required("direction", &Ray::direction, vector, "Of any length but 0."),
};

template <>
inline constexpr auto of<RayRange> = Form{
    plain("range"),
    optional("t_near", &RayRange::t_near, number, "In lengths of the ray's direction."),
    optional("t_far", &RayRange::t_far, number, "In lengths of the ray's direction."),
};

template <>
inline constexpr auto of<RayGrid> = Form{
    plain("ray_grid"),
    required("origin", &RayGrid::origin, vector, "Millimetres."),
    required("direction", &RayGrid::direction, vector),
    required("right", &RayGrid::right, vector, "From a ray to the next one in its row."),
    required("up", &RayGrid::up, vector, "From a ray to the next one in its column."),
    required("columns", &RayGrid::columns, integer),
    required("rows", &RayGrid::rows, integer),
    required("is_pinhole", &RayGrid::is_pinhole, flag),
};

template <>
inline constexpr auto of<Slice> = Form{
    plain("slice"),
    required("center", &Slice::center, vector, "Millimetres."),
    required("right", &Slice::right, vector, "From a pixel to the next one in its row, millimetres."),
    required("up", &Slice::up, vector, "From a pixel to the next one in its column, millimetres."),
    required("width", &Slice::width, integer, "Pixels."),
    required("height", &Slice::height, integer, "Pixels."),
    optional("hidden", &Slice::hidden, flag, "False: regions that pictures do not show (State) are left out."),
};

template <>
inline constexpr auto of<PixelRectangle> = Form{
    plain("pixel_rectangle"),
    required("left", &PixelRectangle::left, integer),
    required("top", &PixelRectangle::top, integer),
    required("width", &PixelRectangle::width, integer),
    required("height", &PixelRectangle::height, integer),
};

/// In C each member is a bit, in this order. `is_off`: a set bit means false.
template <>
inline constexpr auto of<Fields> = Form{
    plain("field"),
    optional("solids", &Fields::solids, flag, "The solids on whose surfaces the boundaries are."),
    optional("normals", &Fields::normals, flag, "Unit normals at the boundaries, outward from the region."),
    optional("overlaps", &Fields::overlaps, flag, "The parts of rays that several regions claim."),
    optional("hidden", &Fields::hidden, flag,
             "False: regions that pictures do not show (State) are left out. First hits never have them.",
             {.is_off = true}),
};

template <>
inline constexpr auto of<DeviceInfo> = Form{
    plain("device_info"),
    required("name", &DeviceInfo::name, text),
    required("platform", &DeviceInfo::platform, text),
    required("version", &DeviceInfo::version, text),
    required("driver", &DeviceInfo::driver, text),
    required("type", &DeviceInfo::type, text, "\"cpu\", \"gpu\" or \"accelerator\"."),
    required("memory", &DeviceInfo::memory, amount, "Bytes of the device's memory."),
    required("max_allocation", &DeviceInfo::max_allocation, amount, "Largest number of bytes of one buffer."),
    required("compute_units", &DeviceInfo::compute_units, amount),
    required("fp64", &DeviceInfo::fp64, flag, "Whether it computes in double precision."),
};

template <>
inline constexpr auto of<RegionInfo> = Form{
    plain("region_info"),
    required("path", &RegionInfo::path, text,
             "\"/top/.../region\": the members on the way down, by their names. No other region has the same path, "
             "and edits of other regions do not change it: it is the key of the region in a later Model."),
    required("fastgen", &RegionInfo::fastgen, Named{&fastgen_names}, "None, plate or volume, as in FASTGEN."),
    required("region_id", &RegionInfo::region_id, integer, "BRL-CAD's number of the region, which is not its index."),
    required("air", &RegionInfo::air, integer, "BRL-CAD's number of the air; other than 0: a region of air."),
    required("material_id", &RegionInfo::material_id, integer, "BRL-CAD's number of the material."),
    required("los", &RegionInfo::los, integer, "BRL-CAD's attribute los, percent; kept for conversion."),
    required("color", &RegionInfo::color, vector, "Display values: red, green, blue; 0 to 1."),
    required("finish", &RegionInfo::finish, special),
    required("state", &RegionInfo::state, Named{&state_names}, "Whether pictures show it."),
    required("bounds", &RegionInfo::bounds, box, "Millimetres; as BRL-CAD computes it, so not always tight."),
};

template <>
inline constexpr auto of<SolidInfo> = Form{
    plain("solid_info"),
    required("name", &SolidInfo::name, text, "Name of the object."),
    required("type", &SolidInfo::type, text, "BRL-CAD's name of the type: ell, tgc, arb8, and so on."),
    required("piece", &SolidInfo::piece, amount, "Index, from 0, among the solids into which csgrt cuts a pipe."),
};

template <>
inline constexpr auto of<ChildInfo> = Form{
    plain("child_info"),
    required("path", &ChildInfo::path, text,
             "The way down to it, \"/top/.../name\": what Edit and placement_of() take."),
    required("name", &ChildInfo::name, text, "The last part of the path."),
    required("object", &ChildInfo::object, text, "The object's name, which several members may have."),
    required("type", &ChildInfo::type, text,
             "\"combination\", \"region\", or BRL-CAD's name of the solid's type: ell, tgc, and so on."),
    required("op", &ChildInfo::op, Named{&operator_names},
             "What joins it to the children before it, as BRL-CAD lists a tree; a union for the first."),
};

using Milliseconds = decltype(Statistics::ms);
constexpr auto milliseconds(Key key, double Milliseconds::*member, const char* help = "") {
    return required(key, Inside{&Statistics::ms, member}, number, help);
}

/// JSON has width and height as one member, `size`.
template <>
inline constexpr auto of<Statistics> = Form{
    plain("statistics"),
    required("device", &Statistics::device, text, "The device that computed, or \"reference\"."),
    required("awaited_device", &Statistics::awaited_device, text,
             "The device that is made ready at the time of this call and will replace `device`: its name, "
             "\"gpu\" while none is found, empty if none is awaited."),
    required("precision", &Statistics::precision, text, "\"double\", \"single\" or \"quad\"."),
    required("method", &Statistics::method, text, "The numerical method, in a few words."),
    required("tolerance", &Statistics::tolerance, number,
             "The tolerance in millimetres, which Settings::tolerance_rule gave."),
    required("width", &Statistics::width, integer, "Width of the picture, pixels; 0 for rays."),
    required("height", &Statistics::height, integer, "Height of the picture, pixels; 0 for rays."),
    required("rays", &Statistics::rays, amount),
    required("ends", &Statistics::ends, amount, "Number of boundaries of segments along all rays."),
    required("segments", &Statistics::segments, amount, "Intervals of rays inside single solids."),
    required(Key{"partitions.used", "", "partitions_used"}, &Statistics::partitions_used, amount,
             "Intervals between neighbouring boundaries that are inside any solid."),
    required(Key{"partitions.allocated", "", "partitions_allocated"}, &Statistics::partitions_allocated, amount,
             "Number of partitions for which memory was allocated."),
    required("overlaps", &Statistics::overlaps, amount, "Partitions that several regions of the same rank claim."),
    required("device_bytes", &Statistics::device_bytes, amount, "Memory in use on all devices."),
    required("segment_bytes", &Statistics::segment_bytes, amount, "Memory for segments, all batches."),
    required("partition_bytes", &Statistics::partition_bytes, amount, "Memory for partitions, all batches."),
    required("batches", &Statistics::batches, amount, "Number of batches of rays."),
    milliseconds({"ms.load", "", "ms_load"}, &Milliseconds::load,
                 "Reading the scene's file. Only the command line sets this member."),
    milliseconds({"ms.compile", "", "ms_compile"}, &Milliseconds::compile, "Compiling the scene."),
    milliseconds({"ms.build", "", "ms_build"}, &Milliseconds::build,
                 "Finding devices and compiling all kernels so far. A call that waits for this does not count the wait "
                 "as `frame`."),
    milliseconds({"ms.count_segments", "", "ms_count_segments"}, &Milliseconds::count_segments),
    milliseconds({"ms.scan", "", "ms_scan"}, &Milliseconds::scan),
    milliseconds({"ms.store_segments", "", "ms_store_segments"}, &Milliseconds::store_segments),
    milliseconds({"ms.weave", "", "ms_weave"}, &Milliseconds::weave),
    milliseconds({"ms.evaluate", "", "ms_evaluate"}, &Milliseconds::evaluate),
    milliseconds({"ms.shade", "", "ms_shade"}, &Milliseconds::shade),
    milliseconds({"ms.rows", "", "ms_rows"}, &Milliseconds::rows),
    milliseconds({"ms.cull_tiles", "", "ms_cull_tiles"}, &Milliseconds::cull_tiles),
    milliseconds({"ms.first_hits", "", "ms_first_hits"}, &Milliseconds::first_hits),
    milliseconds({"ms.kernels", "", "ms_kernels"}, &Milliseconds::kernels,
                 "Time in which kernels ran on a device, one or several at once."),
    milliseconds({"ms.frame", "", "ms_frame"}, &Milliseconds::frame, "The whole call, on the host's clock."),
    milliseconds({"ms.write", "", "ms_write"}, &Milliseconds::write,
                 "Writing the picture's file. Only the command line sets this member."),
};

}  // namespace csgrt::form
