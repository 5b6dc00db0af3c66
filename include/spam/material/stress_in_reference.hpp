// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>
#include <spam/core/tensor.hpp>
#include <spam/material/hyperelastic_law.hpp>
#include <spam/material/stress_law.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace spam {

/// A law that integrates the stress (stress_law.hpp: elastic, or one that yields, creeps, heats up and breaks) for
/// solids that keep their reference configuration. With L = F_dot F^-1 the velocity gradient and J = det F,
///     sigma_dot = law(L^t, sigma),   P = J sigma F^-t,   rho_0 e_dot = P : F_dot,
/// sigma, e and what the law remembers in y. The work is that of the forces, so that E is kept; laws that heat up
/// find e as they do in smooth particles. Conservation: tests/rhs/plastic_solids.cpp.
template <class Law, int Dim>
requires StressLaw<Law, Dim>
class StressInReference {
  public:
    /// `density`: of the reference configuration. `stiffness`: the modulus in which penalties are measured
    /// (penalty_modulus()). Throws InputError for numbers that are not above 0.
    StressInReference(const Law& law, double density, double stiffness)
        : law_(law),
          density_(density),
          stiffness_(stiffness) {
        for (const auto& [name, value] :
             {std::pair{"density", density}, std::pair{"stiffness", stiffness}})
            if (!(value > 0.0) || !std::isfinite(value))
                throw InputError(fmt::format("{}: {:g} must be a positive number", name, value));
    }

    double stiffness() const { return stiffness_; }
    std::string describe() const { return law_.describe() + ", stress by its rate"; }
    std::vector<Field> history() const {
        std::vector<Field> fields{Field::stress, Field::energy};
        if constexpr (LawWithHistory<Law, Dim>)
            for (const Field& field : law_.history()) fields.push_back(field);
        return fields;
    }

    /// The stress that counts is what the law returns that in y to.
    template <class Returned>
    struct InState {
        Returned returned;
        const double *stress_in_y, *energy_in_y;
        double density;

        SymTensor<Dim> sigma(std::size_t i) const {
            constexpr std::size_t size = SymTensor<Dim>::size;
            return returned(i, numbers_at<SymTensor<Dim>>(stress_in_y + size * i));
        }
        Mat<Dim> stress(std::size_t i, const Mat<Dim>& F) const { return of(sigma(i), F); }
        /// P of this sigma.
        static Mat<Dim> of(const SymTensor<Dim>& s, const Mat<Dim>& F) {
            const double J = determinant(F);
            const Mat<Dim> back = inverse(F);
            Mat<Dim> P;
            for (int a = 0; a < Dim; ++a)
                for (int b = 0; b < Dim; ++b)
                    for (int c = 0; c < Dim; ++c) P(a, b) += J * s(a, c) * back(b, c);
            if (!(J > 0.0)) P(0, 0) = std::numeric_limits<double>::quiet_NaN();
            return P;
        }
        double energy(std::size_t i, const Mat<Dim>&) const { return density * energy_in_y[i]; }
    };
    auto in_state(double t, const ConstState<Dim>& state) const {
        const auto with = [&](auto returned) {
            return InState<decltype(returned)>{std::move(returned), state.stress().data(),
                                               state.find(Field::energy), density_};
        };
        if constexpr (ReturningLaw<Law, Dim>)
            return with(law_.return_map(t, state));
        else
            return with([](std::size_t, const SymTensor<Dim>& trial) { return trial; });
    }

    auto rates(double t, const ConstState<Dim>& state, const State<Dim>& rate) const {
        const auto with = [&](auto rate_of) {
            return [now = in_state(t, state), rate_of = std::move(rate_of), density = density_,
                    s_dot = rate.find(Field::stress), e_dot = rate.find(Field::energy)](
                       std::size_t i, const Mat<Dim>& F, const Mat<Dim>& F_dot) {
                const SymTensor<Dim> sigma = now.sigma(i);
                const Mat<Dim> back = inverse(F), P = now.of(sigma, F);
                Mat<Dim> grad_v;
                double power = 0.0;
                for (int a = 0; a < Dim; ++a)
                    for (int b = 0; b < Dim; ++b) {
                        for (int c = 0; c < Dim; ++c) grad_v(a, b) += F_dot(b, c) * back(c, a);
                        power += P(a, b) * F_dot(a, b);
                    }
                const SymTensor<Dim> found = rate_of(i, grad_v, sigma);
                std::copy(found.c.begin(), found.c.end(), s_dot + found.c.size() * i);
                e_dot[i] = power / density;
            };
        };
        if constexpr (LawWithRates<Law, Dim>)
            return with(law_.rates(state, rate));
        else
            return with(
                [law = law_](std::size_t, const Mat<Dim>& grad_v, const SymTensor<Dim>& sigma) {
                    return law.stress_rate(grad_v, sigma);
                });
    }

    bool settle([[maybe_unused]] double t, [[maybe_unused]] std::size_t i, const Mat<Dim>&,
                [[maybe_unused]] const State<Dim>& state) const {
        if constexpr (LawWithHistory<Law, Dim>) return law_.settle(t, i, state);
        return false;
    }

  private:
    Law law_;
    double density_, stiffness_;
};

}  // namespace spam
