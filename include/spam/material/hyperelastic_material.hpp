// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/hyperelastic_law.hpp>

#include <cstddef>
#include <memory>
#include <string>

namespace spam {

/// Any hyperelastic law as a value. One virtual call per few hundred particles; the loop over them
/// behind it is compiled for the law. Implicit, so that a model can be given the law itself.
template <int Dim>
class HyperelasticMaterial {
  public:
    template <HyperelasticLaw<Dim> Law>
    HyperelasticMaterial(const Law& law) : loop_(std::make_shared<LoopOver<Law>>(law)) {}

    /// P of `count` particles, rows of Dim x Dim numbers, `stride` numbers from one particle to the
    /// next, F given in the same way. False where one of them is not finite.
    bool stresses(std::size_t count, std::size_t stride, const double* F, double* P) const {
        return loop_->stresses(count, stride, F, P);
    }
    /// Per reference volume.
    double energy(const Mat<Dim>& F) const { return loop_->energy(F); }
    double stiffness() const { return loop_->stiffness(); }
    std::string describe() const { return loop_->describe(); }

  private:
    struct Loop {
        virtual ~Loop() = default;
        virtual bool stresses(std::size_t, std::size_t, const double*, double*) const = 0;
        virtual double energy(const Mat<Dim>&) const = 0;
        virtual double stiffness() const = 0;
        virtual std::string describe() const = 0;
    };

    template <class Law>
    struct LoopOver final : Loop {
        explicit LoopOver(const Law& l) : law(l) {}

        // flatten: a law is a small function, a call would cost as much as it does
        [[gnu::flatten]] bool stresses(std::size_t count, std::size_t stride, const double* F,
                                       double* P) const override {
            const Law own = law;  // a copy that the stores below cannot be suspected to change
            double zero = 0.0;    // or NaN
            for (std::size_t k = 0; k < count; ++k) {
                Mat<Dim> gradient;
                for (std::size_t c = 0; c < Dim * Dim; ++c) gradient.c[c] = F[k * stride + c];
                const Mat<Dim> stress = own.stress(gradient);
                for (std::size_t c = 0; c < Dim * Dim; ++c) {
                    P[k * stride + c] = stress.c[c];
                    zero += 0.0 * stress.c[c];
                }
            }
            return zero == 0.0;
        }
        double energy(const Mat<Dim>& F) const override { return law.energy(F); }
        double stiffness() const override { return law.stiffness(); }
        std::string describe() const override { return law.describe(); }
        Law law;
    };

    std::shared_ptr<const Loop> loop_;
};

}  // namespace spam
