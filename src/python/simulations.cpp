// SPDX-License-Identifier: GPL-3.0-or-later
// Room problem: a model that is stepped.
#include "bindings.hpp"
#include "simulation.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/integrate/methods.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

namespace spam::python {

using namespace py::literals;

namespace {

/// No option may silently do nothing.
void refuse_idle(const IntegratorOptions& options, const py::dict& given) {
    for (const char* name :
         {"rtol", "atol", "min_step", "max_step", "initial_step", "controller", "safety"}) {
        if (!given.contains(name) || py::object(given[name]).is_none()) continue;
        if (options.dt)
            throw InputError(fmt::format(
                "{}: dt asks for fixed steps, {} for adaptive ones; leave one out", name, name));
        const bool of_arkode =
            name == std::string_view("controller") || name == std::string_view("safety");
        if (of_arkode && !options.method.starts_with("arkode:"))
            throw InputError(
                fmt::format("{}: {} has its own step-size control, the option is for "
                            "arkode:<table> only; leave it out",
                            name, options.method));
    }
}

}  // namespace

IntegratorOptions options_of(const std::string& method, const py::dict& given) {
    IntegratorOptions options;
    options.method = method;
    const auto number = [&](const char* name, auto& into) {
        if (!given.contains(name) || py::object(given[name]).is_none()) return;
        const py::object value = given[name];
        const double x = PyFloat_AsDouble(value.ptr());
        if (x == -1.0 && PyErr_Occurred()) {
            PyErr_Clear();
            throw InputError(fmt::format("{}: is no number", name));
        }
        if (!std::isfinite(x)) throw InputError(fmt::format("{}: {} is not finite", name, x));
        into = x;
    };
    number("dt", options.dt);
    number("rtol", options.rtol);
    number("atol", options.atol);
    number("min_step", options.min_step);
    number("max_step", options.max_step);
    number("initial_step", options.initial_step);
    number("safety", options.safety);
    std::optional<double> most;
    number("max_steps", most);
    if (most) {
        if (*most < 1.0 || *most != std::floor(*most))
            throw InputError(fmt::format("max_steps: {} is not allowed; use 1 or more", *most));
        options.max_steps = static_cast<std::size_t>(*most);
    }
    if (given.contains("controller") && !py::object(given["controller"]).is_none())
        options.controller = py::str(given["controller"]);
    if (given.contains("relaxation")) options.relaxation = py::bool_(given["relaxation"]);
    static const std::vector<std::string> known{"dt",         "rtol",         "atol",   "min_step",
                                                "max_step",   "initial_step", "safety", "max_steps",
                                                "controller", "relaxation"};
    for (const auto& [key, value] : given) {
        const std::string name = py::str(key);
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw InputError(fmt::format("'{}' is no option of an integrator{}", one_line(name),
                                         suggestion(name, known)));
    }
    refuse_idle(options, given);
    options.validate();
    return options;
}

namespace {

/// What a view of y belongs to: its model and motion, also when the particles have become others.
template <int Dim>
py::object owner_of(const Simulation<Dim>& simulation) {
    using Kept = std::shared_ptr<const void>;
    return py::capsule(new Kept(simulation.keeper()),
                       [](void* kept) { delete static_cast<Kept*>(kept); });
}

template <int Dim>
void bind(py::module_& module, const char* name) {
    using One = Simulation<Dim>;
    py::class_<One, std::shared_ptr<One>>(module, name, "Use spam_mechanics.Simulation.")
        .def(py::init([](std::shared_ptr<HeldModel<Dim>> model, const py::object& y0,
                         const std::string& method, const py::dict& options, double t0,
                         int threads) {
            if (!std::isfinite(t0))
                throw InputError(fmt::format("t0: {} is not a finite time", t0));
            return std::make_shared<One>(std::move(model), y0, options_of(method, options), t0,
                                         threads);
        }))
        .def_property_readonly("t", &One::t)
        .def_property_readonly("model", [](const One& one) { return one.held(); })
        .def_property_readonly("y",
                               [](const One& one) {
                                   const auto y = one.y();
                                   return view_of(y.data(), y.size(), 1, true, owner_of(one));
                               })
        .def("view",
             [](const One& one, const std::string& field) {
                 for (const auto& block : one.held()->model->layout().blocks())
                     if (block.name() == field)
                         return view_of(one.y().data() + block.offset,
                                        block.size / block.components, block.components,
                                        block.field.rank() == Rank::scalar, owner_of(one));
                 throw py::attribute_error("y has no field '" + one_line(field) + "'");
             })
        .def_property_readonly("own", &One::own)
        .def("step", &One::step)
        .def("run",
             [](One& self, double t_end, double every, double snapshot_every,
                std::vector<std::pair<std::string, py::function>> columns, py::object on_row,
                py::object on_snapshot, py::object revise, py::object enough,
                std::optional<RezoningChoice> rezone) {
                 self.run({t_end, every, snapshot_every, std::move(columns), on_row, on_snapshot,
                           revise, enough, std::move(rezone)});
             })
        .def("replace", &One::replace)
        .def("rows", &One::rows)
        .def("drifts", &One::drifts)
        .def("remarks", &One::remarks)
        .def("statistics", &One::statistics);
}

}  // namespace

void bind_simulation(py::module_& module) {
    using Limits = RezoningChoice::Limits;
    py::class_<RezoningChoice>(
        module, "Rezoning",
        "How the number of particles changes in Simulation.run(rezone=...): every so much time (time) particles that\n"
        "stand for too much are split, and groups of those that stand for too little merged into two. Mass, momentum,\n"
        "angular momentum and energy are kept. Of each criterion two limits, (split, merge): a particle is split where\n"
        "one asks for it, and may be merged where all that are given allow it.\n\n"
        "`volume`: m/rho above the first, below the second; `neighbours` within the range: below (0: never), above;\n"
        "`gradient`: |grad rho| range/rho, above, below. `range` (length; 0: that of the laws) of the criteria;\n"
        "`in_two`: two children, not 2^D.")
        .def(py::init([](double every, const Limits& volume, const Limits& neighbours,
                         const Limits& gradient, double range, bool in_two) {
                 return RezoningChoice{every, volume, neighbours, gradient, range, in_two};
             }),
             "every"_a, "volume"_a = py::none(), "neighbours"_a = py::none(),
             "gradient"_a = py::none(), "range"_a = 0.0, "in_two"_a = false);
    bind<1>(module, "Simulation1");
    bind<2>(module, "Simulation2");
    bind<3>(module, "Simulation3");
    module.def(
        "methods",
        [] {
            py::dict methods;
            for (const auto& one : integration_methods())
                methods[py::str(one.name)] = py::dict(
                    "order"_a = one.order, "adaptive"_a = one.adaptive, "fixed"_a = one.fixed,
                    "separable"_a = one.separable, "multistep"_a = one.multistep);
            return methods;
        },
        "Every method of integration: name -> order, adaptive, fixed (by dt), separable (only where dx/dt = v\n"
        "and dv/dt depends on x alone), multistep.");
}

}  // namespace spam::python
