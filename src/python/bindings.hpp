// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

/// One function per room bound, in the order in which the types are needed.
namespace spam::python {

void bind_process(pybind11::module_& module);
void bind_setup(pybind11::module_& module);
void bind_materials(pybind11::module_& module);
void bind_externals(pybind11::module_& module);
void bind_scheme(pybind11::module_& module);
void bind_models(pybind11::module_& module);
void bind_makers(pybind11::module_& module);
void bind_elements(pybind11::module_& module);
void bind_molecular_fields(pybind11::module_& module);
void bind_simulation(pybind11::module_& module);
void bind_integrate(pybind11::module_& module);

}  // namespace spam::python
