// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/parallel.hpp>
#include <spam/core/state.hpp>
#include <spam/material/stress_law.hpp>

#include <memory>
#include <span>
#include <string>

namespace spam {

/// Any stress law as a value. One virtual call per right-hand side; the loop over particles behind
/// it is compiled for the law. Implicit, so that a model can be given the law itself.
template <int Dim>
class Material {
  public:
    template <StressLaw<Dim> Law>
    Material(const Law& law) : loop_(std::make_shared<LoopOver<Law>>(law)) {}

    /// sigma_dot of every particle from its velocity gradient and its stress in `state`.
    void stress_rates(std::span<const Mat<Dim>> grad_v, const ConstState<Dim>& state,
                      const State<Dim>& rate) const {
        loop_->run(grad_v, state, rate);
    }
    std::string describe() const { return loop_->describe(); }

  private:
    struct Loop {
        virtual ~Loop() = default;
        virtual void run(std::span<const Mat<Dim>>, const ConstState<Dim>&,
                         const State<Dim>&) const = 0;
        virtual std::string describe() const = 0;
    };

    template <class Law>
    struct LoopOver final : Loop {
        explicit LoopOver(const Law& l) : law(l) {}

        void run(std::span<const Mat<Dim>> grad_v, const ConstState<Dim>& state,
                 const State<Dim>& rate) const override {
            const double* const from = state.stress().data();
            double* const to = rate.stress().data();
            const Law own = law;  // a copy that the stores below cannot be suspected to change
            // flatten: a law is a small function, a call would cost as much as it does
            parallel_for(
                grad_v.size(), [&](std::size_t i) __attribute__((flatten)) {
                    constexpr auto n = static_cast<std::size_t>(symmetric_size(Dim));
                    const Mat<Dim> gradient = grad_v[i];
                    SymTensor<Dim> sigma;
                    for (std::size_t k = 0; k < n; ++k) sigma.c[k] = from[n * i + k];
                    const SymTensor<Dim> sigma_dot = own.stress_rate(gradient, sigma);
                    for (std::size_t k = 0; k < n; ++k) to[n * i + k] = sigma_dot.c[k];
                });
        }
        std::string describe() const override { return law.describe(); }
        Law law;
    };

    std::shared_ptr<const Loop> loop_;
};

}  // namespace spam
