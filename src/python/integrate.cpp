// SPDX-License-Identifier: GPL-3.0-or-later
// Room integrate: any ordinary differential equation by any method.
#include "bindings.hpp"
#include "simulation.hpp"
#include <spam/core/error.hpp>
#include <spam/core/nvector.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam::python {
namespace {

/// dy/dt by f(t, y). The interpreter is held all the time: whatever is computed is f.
class PythonOde {
  public:
    PythonOde(const py::function& f, std::size_t n, double atol) : f_(f) {
        ode.rates = [this](double t, std::span<const double> y, std::span<double> y_dot) {
            if (pending_.failed() || !ask(t, y, y_dot))
                std::fill(y_dot.begin(), y_dot.end(), std::numeric_limits<double>::quiet_NaN());
        };
        ode.failure = [] { return std::string(); };
        ode.entry_name = [](std::size_t k) { return fmt::format("y[{}]", k); };
        ode.absolute_tolerance.assign(n, atol);
        ode.blocks = {{"y", 0, n}};
        ode.inseparable = "f does not say which entries are positions and which velocities";
        ode.no_energy = "f does not tell an energy";
    }
    PythonOde(const PythonOde&) = delete;
    PythonOde& operator=(const PythonOde&) = delete;

    Ode ode;
    void raise() { pending_.raise(); }
    bool failed() const { return pending_.failed(); }

  private:
    bool ask(double t, std::span<const double> y, std::span<double> y_dot) {
        try {
            const py::object value = f_(t, array_of(y));  // an array of its own, which f may keep
            const auto rates = Doubles::ensure(value);
            if (!rates) {
                PyErr_Clear();
                throw InputError("f: returned no array of numbers");
            }
            if (rates.ndim() != 1 || static_cast<std::size_t>(rates.size()) != y.size())
                expect_shape(rates, {static_cast<py::ssize_t>(y.size())}, "f");
            std::copy_n(rates.data(), rates.size(), y_dot.begin());
            return true;
        } catch (...) {
            pending_.keep();
            return false;
        }
    }

    py::function f_;
    Pending pending_;
};

struct Path {
    std::vector<double> t, y;
};

void check_times(const std::vector<double>& times, double t0) {
    double before = t0;
    for (const double t : times) {
        if (!std::isfinite(t) || t < before)
            throw InputError(fmt::format("times: {} is not after {}", t, before));
        before = t;
    }
    if (times.empty() || times.back() <= t0)
        throw InputError(fmt::format("t_end: is not after t0 = {}", t0));
}

py::dict integrate(const py::function& f, const py::object& y0, double t0,
                   const std::vector<double>& times, bool every_step, const std::string& method,
                   const py::dict& given) {
    const Doubles start = doubles_of(y0, "y0");
    expect_shape(start, {-1}, "y0");
    if (start.size() == 0) throw InputError("y0: is empty; give one number at least");
    if (!std::isfinite(t0)) throw InputError(fmt::format("t0: {} is not finite", t0));
    check_times(times, t0);
    const IntegratorOptions options = options_of(method, given);
    const auto n = static_cast<std::size_t>(start.size());
    PythonOde python(f, n, options.atol);
    python.ode.time_scale = std::min(1.0, times.back() - t0);
    const SundialsContext context;
    Vector y(n, context);
    std::copy_n(start.data(), n, y.span().begin());
    const auto integrator = make_integrator(options, python.ode, y, t0, context);
    Path path;
    const auto keep = [&] {
        path.t.push_back(integrator->t());
        path.y.insert(path.y.end(), y.span().begin(), y.span().end());
    };
    if (every_step) keep();
    try {
        for (const double t : times) {
            // A method of fixed steps shortens the one that reaches a time, and goes on with whole ones.
            while (integrator->t() < t) {
                integrator->step(t);
                if (python.failed()) throw GuardStop("f has failed");
                if (PyErr_CheckSignals() != 0) throw py::error_already_set();
                if (every_step) keep();
            }
            if (!every_step) keep();
        }
    } catch (const GuardStop&) {
        python.raise();
        throw;
    }
    const auto& s = integrator->statistics();
    const Doubles rows({static_cast<py::ssize_t>(path.t.size()), static_cast<py::ssize_t>(n)},
                       path.y.data());
    return py::dict(py::arg("t") = array_of(path.t), py::arg("y") = rows,
                    py::arg("steps") = s.steps, py::arg("rejected_steps") = s.rejected_steps,
                    py::arg("rhs_evaluations") = s.rhs_evaluations,
                    py::arg("last_step") = s.last_step);
}

}  // namespace

void bind_integrate(py::module_& module) {
    using namespace py::literals;
    module.def("integrate", &integrate, "f"_a, "y0"_a, "t0"_a, "times"_a, "every_step"_a,
               "method"_a, "options"_a);
}

}  // namespace spam::python
