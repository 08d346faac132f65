// csgrt::Error becomes csgrt.Error, whose class is in Python (csgrt/_values.py).
#include <form/names.hpp>

#include "values.hpp"

namespace csgrt::python {
namespace {

void raise(const Error& error) {
    const std::string status(name_of(status_names, error.status()));
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

void bind_errors(nb::module_& module) {
    module.attr("Status") = literal(status_names);
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
