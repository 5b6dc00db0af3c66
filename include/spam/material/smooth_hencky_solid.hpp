// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/hencky_solid.hpp>

namespace spam {

/// The solid of logarithmic strain (hencky_solid.hpp) in rate form, as SmoothYield is the elastic one: with n
/// the deviator of tau of length one and D the rate of strain,
///     (Cp^-1)_dot = -2 l F^-1 n b F^-t,   l = <n:D> max(0, (q/Y - 1 + width)/width),
/// so that b grows by what is elastic in D alone. What flow takes from the energy, l n:tau, is integrated as plastic
/// work. Nothing is settled, and every method serves.
template <class Surface>
class SmoothHenckySolid {
    static constexpr int dim = Surface::dim;

  public:
    /// Throws InputError for constants that make no sense.
    SmoothHenckySolid(const Surface& surface, const LinearHardening& flow, double width = 0.1)
        : surface_(surface),
          flow_(flow),
          width_(valid_yield_width(width)) {
        flow_.validate();
    }

    double stiffness() const { return penalty_modulus(surface_.lambda, surface_.eta); }
    std::string describe() const {
        return fmt::format(
            "logarithmic strain, yielding smoothly {}, lambda = {:.6g}, eta = {:.6g}, {}, width {:g}",
            Surface::name(), surface_.lambda, surface_.eta, flow_.describe(), width_);
    }
    std::vector<Field> history() const {
        std::vector<Field> fields{field_kind::flowing_plastic_strain,
                                  field_kind::flowing_plastic_metric,
                                  field_kind::flowing_plastic_work};
        if (Surface::across) fields.emplace_back(field_kind::flowing_plastic_metric_zz);
        return fields;
    }
    bool settle(std::size_t, const Mat<dim>&, const State<dim>&) const { return false; }

    struct InState {
        SmoothHenckySolid law;
        const double *strain, *metric, *metric_zz, *work;

        LogarithmicStrain<dim> elastic(std::size_t i, const Mat<dim>& F) const {
            return LogarithmicStrain<dim>::of(F, metric + SymTensor<dim>().c.size() * i,
                                              Surface::across ? metric_zz[i] : 0.0);
        }
        Mat<dim> stress(std::size_t i, const Mat<dim>& F) const {
            return elastic(i, F).stress(law.surface_.lambda, law.surface_.eta, F);
        }
        double energy(std::size_t i, const Mat<dim>& F) const {
            return elastic(i, F).energy(law.surface_.lambda, law.surface_.eta) + work[i];
        }
    };
    InState in_state(const ConstState<dim>& state) const {
        return {*this, state.find(field_kind::flowing_plastic_strain),
                state.find(field_kind::flowing_plastic_metric),
                Surface::across ? state.find(field_kind::flowing_plastic_metric_zz) : nullptr,
                state.find(field_kind::flowing_plastic_work)};
    }

    auto rates(const ConstState<dim>& state, const State<dim>& rate) const {
        return [*this, now = in_state(state), rate](std::size_t i, const Mat<dim>& F,
                                                    const Mat<dim>& F_dot) {
            const LogarithmicStrain<dim> e = now.elastic(i, F);
            const double two_eta = 2.0 * surface_.eta;
            const auto parts = Surface::parts(two_eta * e.strain, two_eta * e.zz);
            const double Y = flow_.yield_stress({now.strain[i]});
            const double near = (parts.q / Y - 1.0 + width_) / width_;
            if (!(near > 0.0)) return;  // rates are 0 before
            // n, which has the axes of b, and n:D with D of F_dot F^-1.
            const double to_n = std::sqrt(Surface::k) / parts.q;
            const SymTensor<dim> n = to_n * parts.deviator;
            const Mat<dim> back = inverse(F);
            double n_D = 0.0;
            for (int a = 0; a < dim; ++a)
                for (int b = 0; b < dim; ++b)
                    for (int c = 0; c < dim; ++c) n_D += n(a, b) * F_dot(a, c) * back(c, b);
            if (!(n_D > 0.0)) return;
            const double l = n_D * near;
            // n b is symmetric.
            const SymTensor<dim> b = exponential_of_twice(e.strain);
            SymTensor<dim> flow;
            for (int a = 0; a < dim; ++a)
                for (int c = a; c < dim; ++c)
                    for (int d = 0; d < dim; ++d) flow(a, c) += -2.0 * l * n(a, d) * b(d, c);
            const SymTensor<dim> metric = transformed(back, flow);
            std::copy(metric.c.begin(), metric.c.end(),
                      rate.find(field_kind::flowing_plastic_metric) + metric.c.size() * i);
            if (Surface::across)
                rate.find(field_kind::flowing_plastic_metric_zz)[i] =
                    -2.0 * l * to_n * parts.zz * std::exp(2.0 * e.zz);
            // n:tau = q/sqrt(k), which is Y times the rate of eps_p where q = Y.
            rate.find(field_kind::flowing_plastic_work)[i] = l * parts.q / std::sqrt(Surface::k);
            rate.find(field_kind::flowing_plastic_strain)[i] = l / std::sqrt(Surface::k);
        };
    }

  private:
    Surface surface_;
    LinearHardening flow_;
    double width_;
};

static_assert(HyperelasticLawWithRates<SmoothHenckySolid<PlaneVonMises>, 2> &&
              HyperelasticLawWithRates<SmoothHenckySolid<PlaneStrainVonMises>, 2> &&
              HyperelasticLawWithRates<SmoothHenckySolid<SpaceVonMises>, 3>);

}  // namespace spam
