// SPDX-License-Identifier: GPL-3.0-or-later
#include "held_model.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace spam::python {

template <int Dim>
HeldModel<Dim>::Use::Use(HeldModel& held)
    : held_(held),
      nested_(held.paused_in_.load() == std::this_thread::get_id()) {
    if (!nested_ && held_.busy_.exchange(true))
        throw std::runtime_error(
            "the model is at work: another thread, or a right-hand side that has called this, uses it; "
            "make a model for each thread");
}

template <int Dim>
std::vector<double> HeldModel<Dim>::start(const py::object& velocity, double temperature) {
    const auto n = static_cast<Eigen::Index>(size());
    if (made_in_a_run_)
        throw InputError(
            "start: particles were split or merged since the model was made, which has no start any more; go on "
            "from Simulation.y, or make a model of the present positions");
    if (!std::isfinite(temperature) || temperature < 0.0)
        throw InputError(fmt::format("temperature: {} is not allowed; use 0 or more", temperature));
    Points<Dim> v = Points<Dim>::Zero(Dim, n);
    if (!velocity.is_none()) {
        const Points<Dim> given = points_of<Dim>(velocity, "velocity");
        if (given.cols() != n)
            throw InputError(
                fmt::format("velocity: is of {} particles, and the model has {}", given.cols(), n));
        for (Eigen::Index i = 0; i < n; ++i)
            v.col(i) = given.col(model->particles().id[static_cast<std::size_t>(i)]);
    }
    const Use use(*this);
    std::vector<double> y;
    {
        const py::gil_scoped_release
            others;  // rates of a state at rest may call functions of Python
        y = start_(v, temperature);
    }
    pending->raise();
    scaled_ = true;
    return y;
}

template <int Dim>
std::vector<double> HeldModel<Dim>::checked(const py::object& y0) {
    const Doubles y = doubles_of(y0, "y0");
    expect_shape(y, {static_cast<py::ssize_t>(model->layout().size())}, "y0");
    if (!scaled_) start(py::none(), 0.0);
    return {y.data(), y.data() + y.size()};
}

template <int Dim>
Doubles HeldModel<Dim>::rates(double t, const py::object& given) {
    const std::size_t size_of_y = model->layout().size();
    Doubles y;
    // As solvers call it: no more checks than these.
    if (py::isinstance<Doubles>(given))
        y = py::reinterpret_borrow<Doubles>(given);
    else
        y = doubles_of(given, "y");
    if (y.ndim() != 1 || static_cast<std::size_t>(y.size()) != size_of_y)
        expect_shape(y, {static_cast<py::ssize_t>(size_of_y)}, "y");
    Doubles y_dot(static_cast<py::ssize_t>(size_of_y));
    const std::span<const double> from(y.data(), size_of_y);
    const std::span<double> to(y_dot.mutable_data(), size_of_y);
    {
        const Use use(*this);
        if (size() > 256) {
            const py::gil_scoped_release others;
            model->rates(t, from, to);
        } else {
            model->rates(t, from, to);
        }
    }
    pending->raise();
    if (!model->failure().empty()) doubles_of(y, "y");  // is it the state itself?
    return y_dot;
}

SPAM_COMPILED(template class HeldModel);

}  // namespace spam::python
