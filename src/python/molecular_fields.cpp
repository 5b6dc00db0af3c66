// SPDX-License-Identifier: GPL-3.0-or-later
// Room diagnostics: fields of molecules.
#include "bindings.hpp"
#include "held_model.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/molecular_fields.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

namespace spam::python {

using namespace py::literals;

namespace {

/// (M, C) of C x M, or (M) where C is 1.
Doubles rows_of(const Eigen::MatrixXd& values, bool scalar = false) {
    Doubles array(scalar ? std::vector<py::ssize_t>{values.cols()}
                         : std::vector<py::ssize_t>{values.cols(), values.rows()});
    std::copy_n(values.data(), values.size(), array.mutable_data());
    return array;
}

template <int Dim>
void bind(py::module_& module) {
    module.def(
        "molecular_fields",
        [](HeldModel<Dim>& held, const py::object& y, const py::object& places,
           const std::string& kernel, std::optional<double> range) {
            const double h = range.value_or(3.0 * held.model->particles().spacing);
            if (!std::isfinite(h))
                throw InputError(fmt::format("range: {} is not a finite length", h));
            const std::vector<double> state = held.checked(y);
            const Points<Dim> at = points_of<Dim>(places, "places");
            const typename HeldModel<Dim>::Use use(held);
            const auto values =
                MolecularFields<Dim>(weight_function<Dim>(kernel, h), *held.model, state).at(at);
            return py::dict("density"_a = rows_of(values.density, true),
                            "velocity"_a = rows_of(values.velocity),
                            "temperature"_a = rows_of(values.temperature, true),
                            "energy"_a = rows_of(values.energy, true),
                            "pressure"_a = rows_of(values.pressure));
        },
        "model"_a, "y"_a, "places"_a, "kernel"_a, "range"_a);
}

}  // namespace

void bind_molecular_fields(py::module_& module) {
    bind<1>(module);
    bind<2>(module);
    bind<3>(module);
}

}  // namespace spam::python
