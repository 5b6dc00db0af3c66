// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/external/friction.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

template <int Dim>
Friction<Dim>::Friction(double gamma, FrictionOf of) : gamma_(gamma),
                                                       of_(of) {
    if (!(gamma >= 0.0) || !std::isfinite(gamma))
        throw InputError(
            fmt::format("damping: {} must be a finite rate not below 0; 0.1 is usual", gamma));
}

template <int Dim>
void Friction<Dim>::prepare(const typename External<Dim>::Now& now) {
    if (of_ == FrictionOf::internal_motion)
        rigid_ = rigid_velocity_of<Dim>(now.particles.mass, now.state);
}

template <int Dim>
void Friction<Dim>::add(const typename External<Dim>::Now& now, Eigen::Index first,
                        Eigen::Index last) const {
    const auto x = now.state.position(), v = now.state.velocity();
    auto v_dot = now.rate.velocity();
    for (Eigen::Index i = first; i < last; ++i) {
        if (of_ == FrictionOf::all_motion)
            v_dot.col(i) -= gamma_ * v.col(i);
        else
            v_dot.col(i) -= gamma_ * (v.col(i) - rigid_.at(x.col(i)));
    }
}

template <int Dim>
std::string Friction<Dim>::describe() const {
    return fmt::format("friction gamma = {:g} of {}", gamma_,
                       of_ == FrictionOf::all_motion ? "all motion" : "what is not rigid motion");
}

SPAM_COMPILED(template class Friction);

}  // namespace spam
