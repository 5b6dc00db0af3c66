// SPDX-License-Identifier: GPL-3.0-or-later
// Room external: what acts on particles from outside.
#include "bindings.hpp"
#include "choices.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/external/drag.hpp>
#include <spam/external/gravity.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace spam::python {
namespace {

template <int Dim>
Point<Dim> point_of(const std::vector<double>& given, const char* name) {
    if (given.size() != Dim)
        throw InputError(
            fmt::format("{}: has {} components, and the particles {}", name, given.size(), Dim));
    return Eigen::Map<const Point<Dim>>(given.data());
}

}  // namespace

template <int Dim>
std::unique_ptr<External<Dim>> external_of(const ExternalChoice& choice,
                                           const SharedPending& pending) {
    if (const auto* one = std::get_if<GravityChoice>(&choice))
        return std::make_unique<Gravity<Dim>>(point_of<Dim>(one->g, "g"));
    if (const auto* one = std::get_if<FrictionChoice>(&choice))
        return std::make_unique<Friction<Dim>>(one->gamma, one->of);
    if (const auto* one = std::get_if<DragChoice>(&choice)) {
        const Point<Dim> wind =
            one->wind.empty() ? Point<Dim>(Point<Dim>::Zero()) : point_of<Dim>(one->wind, "wind");
        return std::make_unique<Drag<Dim>>(one->c, one->fastest, wind);
    }
    return std::make_unique<FunctionForce<Dim>>(std::get<ForceChoice>(choice).f, pending);
}

template std::unique_ptr<External<1>> external_of<1>(const ExternalChoice&, const SharedPending&);
template std::unique_ptr<External<2>> external_of<2>(const ExternalChoice&, const SharedPending&);
template std::unique_ptr<External<3>> external_of<3>(const ExternalChoice&, const SharedPending&);

void bind_externals(py::module_& module) {
    using namespace py::literals;
    py::class_<GravityChoice>(module, "Gravity",
                              "Acceleration g (D,) of all particles (length/time^2).")
        .def(py::init<std::vector<double>>(), "g"_a);
    py::class_<FrictionChoice>(
        module, "Friction",
        "-gamma (1/time) times the velocity: of 'internal_motion', what is not rigid, or of 'all_motion'.")
        .def(py::init([](double gamma, const std::string& of) {
                 if (of != "internal_motion" && of != "all_motion")
                     throw InputError(fmt::format(
                         "of: '{}' is not known; use internal_motion or all_motion", one_line(of)));
                 return FrictionChoice{gamma, of == "all_motion" ? FrictionOf::all_motion
                                                                 : FrictionOf::internal_motion};
             }),
             "gamma"_a, "of"_a = "internal_motion");
    py::class_<DragChoice>(
        module, "Drag",
        "-c |v - wind| (v - wind); `fastest`: the largest relative speed to be expected.")
        .def(py::init<double, double, std::vector<double>>(), "c"_a, "fastest"_a,
             "wind"_a = std::vector<double>{});
    py::class_<ForceChoice>(
        module, "Force",
        "A force by mass of one's own: f(t, x (m, D), v (m, D)) -> acceleration (m, D), for up to 256 particles\n"
        "at a time. What it gives is booked: impulse, angular impulse, work.")
        .def(py::init([](py::function f) { return ForceChoice{function_of(std::move(f))}; }),
             "f"_a);
}

}  // namespace spam::python
