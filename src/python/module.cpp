// SPDX-License-Identifier: GPL-3.0-or-later
// spam_mechanics._core, the compiled part of the Python package.
#include "bindings.hpp"
#include <spam/core/error.hpp>

namespace py = pybind11;

namespace {

/// Raises an exception of spam_mechanics.errors.
void raise(const char* name, const char* message) {
    const py::object type = py::module_::import("spam_mechanics.errors").attr(name);
    PyErr_SetString(type.ptr(), message);
}

}  // namespace

PYBIND11_MODULE(_core, module) {
    module.doc() = "The compiled part of spam_mechanics; use that.";
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const spam::InputError& error) {
            raise("InputError", error.what());
        } catch (const spam::GuardStop& error) {
            raise("GuardStop", error.what());
        } catch (const spam::OutputError& error) {
            raise("OutputError", error.what());
        }
    });
    spam::python::bind_process(module);
    spam::python::bind_setup(module);
    spam::python::bind_materials(module);
    spam::python::bind_externals(module);
    spam::python::bind_scheme(module);
    spam::python::bind_models(module);
    spam::python::bind_makers(module);
    spam::python::bind_elements(module);
    spam::python::bind_molecular_fields(module);
    spam::python::bind_simulation(module);
    spam::python::bind_integrate(module);
}
