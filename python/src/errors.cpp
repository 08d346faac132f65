// csgrt::Error becomes csgrt.Error, whose class is in Python (csgrt/_values.py).
#include "values.hpp"

namespace csgrt::python {
namespace {

constexpr std::pair<Status, const char*> status_names[] = {
    {Status::usage, "usage"},         {Status::scene, "scene"},
    {Status::no_device, "no_device"}, {Status::out_of_memory, "out_of_memory"},
    {Status::file, "file"},           {Status::device_fault, "device_fault"},
    {Status::differs, "differs"},     {Status::interrupted, "interrupted"},
};

void raise(const Error& error) {
    const char* status = "";
    for (const auto& [value, name] : status_names)
        if (value == error.status()) status = name;
    nb::list diagnostics;
    for (const Diagnostic& d : error.diagnostics())
        diagnostics.append(nb::make_tuple(place_row(d.place), d.message, d.suggestion, d.excerpt));
    const nb::object type = nb::module_::import_("csgrt._values").attr("Error");
    PyErr_SetObject(type.ptr(), type(nb::str(error.what()), status, diagnostics).ptr());
}

}  // namespace

nb::tuple place_row(const Place& place) {
    return nb::make_tuple(place.file, place.line, place.column, place.offset, place.pointer);
}

void bind_errors(nb::module_&) {
    nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
        try {
            std::rethrow_exception(thrown);
        } catch (const Error& error) {
            // A signal that ended the call has left its own exception.
            if (!PyErr_Occurred()) raise(error);
        }
    });
}

}  // namespace csgrt::python
