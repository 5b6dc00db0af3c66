// SPDX-License-Identifier: GPL-3.0-or-later
#include "callbacks.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam::python {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// An array of its own: a function that keeps it holds no memory of ours.
Doubles copy_of(const double* data, const std::vector<py::ssize_t>& shape) {
    Doubles array(shape);
    std::copy_n(data, array.size(), array.mutable_data());
    return array;
}

/// What a function has returned, as numbers of this shape; they may be NaN.
Doubles returned(const py::object& value, const std::vector<py::ssize_t>& shape, const char* what) {
    auto array = Doubles::ensure(value);
    if (!array) {
        PyErr_Clear();
        throw InputError(std::string(what) + ": returned no array of numbers");
    }
    expect_shape(array, shape, what);
    return array;
}

/// Calls `call` with the interpreter; returns whether it went well.
template <class Call>
bool asked(Pending& pending, const Call& call) {
    if (pending.failed()) return false;
    const py::gil_scoped_acquire interpreter;
    try {
        call();
        return true;
    } catch (...) {
        pending.keep();
        return false;
    }
}

}  // namespace

void Pending::keep() {
    const std::lock_guard lock(mutex_);
    if (!first_) first_ = std::current_exception();
    failed_ = true;
}

void Pending::raise() {
    if (!failed_) return;
    failed_ = false;
    std::rethrow_exception(std::exchange(first_, nullptr));
}

Function function_of(py::function f) {
    return {new py::function(std::move(f)), [](const py::function* kept) {
                const py::gil_scoped_acquire interpreter;
                delete kept;
            }};
}

double SoundSpeed::at(double density) const {
    double speed = number;
    if (f) {
        const py::gil_scoped_acquire interpreter;
        speed = (*f)(density).cast<double>();
    }
    if (!std::isfinite(speed) || speed <= 0.0)
        throw InputError(fmt::format(
            "sound_speed: {} at density {} is not allowed; use a positive number", speed, density));
    return speed;
}

template <int Dim, bool sounds>
void FunctionLaw<Dim, sounds>::stress_rates(std::span<const Mat<Dim>> grad_v,
                                            std::span<const SymTensor<Dim>> stress,
                                            std::span<SymTensor<Dim>> rate) const {
    const auto m = static_cast<py::ssize_t>(rate.size());
    const py::ssize_t components = symmetric_size(Dim);
    const bool well = asked(*pending, [&] {
        const Doubles result = returned((*f)(copy_of(grad_v.data()->c.data(), {m, Dim, Dim}),
                                             copy_of(stress.data()->c.data(), {m, components})),
                                        {m, components}, "the stress law");
        std::copy_n(result.data(), result.size(), rate.data()->c.data());
    });
    if (well) return;
    for (auto& one : rate) one.c.fill(nan);
}

template <int Dim>
void FunctionForce<Dim>::add(const typename External<Dim>::Now& now, Eigen::Index first,
                             Eigen::Index last) const {
    const auto m = last - first;
    const auto x = now.state.position(), v = now.state.velocity();
    auto v_dot = now.rate.velocity();
    const bool well = asked(*pending_, [&] {
        const Doubles a = returned((*f_)(now.t, copy_of(x.data() + Dim * first, {m, Dim}),
                                         copy_of(v.data() + Dim * first, {m, Dim})),
                                   {m, Dim}, "the force");
        v_dot.middleCols(first, m) += Eigen::Map<const Points<Dim>>(a.data(), Dim, m);
    });
    if (!well) v_dot.middleCols(first, m).setConstant(nan);
}

template struct FunctionLaw<1, false>;
template struct FunctionLaw<1, true>;
template struct FunctionLaw<2, false>;
template struct FunctionLaw<2, true>;
template struct FunctionLaw<3, false>;
template struct FunctionLaw<3, true>;
SPAM_COMPILED(template class FunctionForce);

}  // namespace spam::python
