// SPDX-License-Identifier: GPL-3.0-or-later
// Room rhs: models of particles, one class for each number of dimensions.
#include "bindings.hpp"
#include "held_model.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/shape.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace spam::python {

using namespace py::literals;

namespace {

template <int Dim>
void bind(py::module_& module, const char* name) {
    using Model = HeldModel<Dim>;
    py::class_<Model, std::shared_ptr<Model>>(
        module, name, "A model of N particles; made by SmoothParticles(), Springs(), ...")
        .def(
            "start",
            [](Model& self, const py::object& v, double T) { return array_of(self.start(v, T)); },
            "velocity"_a = py::none(), "temperature"_a = 0.0,
            "y at the start (size,): positions as given, `velocity` (N, D) in the order given, no stress. Of a\n"
            "fluid with a temperature its energy.")
        .def(
            "rates", &Model::rates, "t"_a, "y"_a,
            "dy/dt (size,) at time t, as scipy.integrate.solve_ivp wants it; y as Simulation.y, whose particles are\n"
            "in the library's order: id[i] is the number of the i-th one among those given, and\n"
            "Simulation.by_id(field) is the way back. NaN, and `failure` says why, where a state has no physical\n"
            "meaning. Raises InputError for a wrong shape.")
        .def_property_readonly("failure", [](const Model& self) { return self.model->failure(); })
        .def_property_readonly("dimensions", [](const Model&) { return Dim; })
        .def_property_readonly(
            "size", [](const Model& self) { return self.model->layout().size(); }, "Entries of y.")
        .def("__len__", &Model::size)
        .def_property_readonly(
            "id",
            [](const Model& self) {
                const auto& id = self.model->particles().id;
                py::array_t<std::int64_t> array(static_cast<py::ssize_t>(id.size()));
                std::copy(id.begin(), id.end(), array.mutable_data());
                return array;
            },
            "Which of the particles given lies where (N,): fields of a state are in this order.")
        .def_property_readonly(
            "mass", [](const Model& self) { return array_of(self.model->particles().mass); },
            "Masses (N,) in the order of `id`.")
        .def_property_readonly(
            "reference_position",
            [](const Model& self) {
                return array_of<Dim>(self.model->particles().reference_position);
            },
            "(N, D) in the order of `id`.")
        .def_property_readonly(
            "fields",
            [](const Model& self) {
                py::dict fields;
                for (const auto& block : self.model->layout().blocks())
                    fields[py::str(block.name())] =
                        py::make_tuple(block.offset, block.size, block.components);
                return fields;
            },
            "Of y: name -> (first entry, entries, components).")
        .def(
            "density",
            [](Model& self, const py::object& y) {
                const std::vector<double> checked = self.checked(y);
                const typename Model::Use use(self);
                return array_of(self.model->density(checked));
            },
            "y"_a, "(N,); empty for a model without.")
        .def(
            "shape_error",
            [](const Model& self, const py::object& x) {
                const auto& p = self.model->particles();
                const Points<Dim> position = points_of<Dim>(x, "position");
                if (position.cols() != p.reference_position.cols())
                    throw InputError(
                        fmt::format("position: is of {} particles, and the model has {}",
                                    position.cols(), p.size()));
                return shape_error<Dim>(p.reference_position, position, p.spacing);
            },
            "position"_a,
            "Distance from the best-fitting rigid motion, root mean square in spacings.")
        .def(
            "closest_pair",
            [](const Model& self, const py::object& x) {
                const Points<Dim> position = points_of<Dim>(x, "position");
                return closest_pair<Dim>(position, self.model->particles().spacing,
                                         self.model->box());
            },
            "position"_a, "Distance of the closest two particles.")
        .def("__repr__", [](const Model& self) {
            return fmt::format("<{} particles in {} dimensions: {}>", self.size(), Dim,
                               self.model->describe());
        });
}

}  // namespace

void bind_models(py::module_& module) {
    bind<1>(module, "Model1");
    bind<2>(module, "Model2");
    bind<3>(module, "Model3");
}

}  // namespace spam::python
