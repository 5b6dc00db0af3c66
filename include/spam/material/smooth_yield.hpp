// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/linear_hardening.hpp>
#include <spam/material/plastic_fields.hpp>
#include <spam/material/stress_law.hpp>
#include <spam/material/von_mises.hpp>

namespace spam {

/// Yielding in rate form, smooth enough for every method and every multistep one: with n the deviator of length
/// one and D the rate of strain,
///     sigma_dot = elastic - 2 eta l n,   l = ⟨n:D⟩ max(0, (q/Y - 1 + width)/width),
/// so that q approaches Y from below and nothing is returned after steps. ⟨x⟩ = max(x, 0). The plastic strain
/// grows by l sqrt(2/3) in space, l/sqrt(2) in the plane: stress times its rate is Y times that. A limit of its
/// own: with `width` it differs from the sharp surface by the strain that q takes from (1 - width) Y to Y.
/// Explicit steps must be shorter than 2.8 width Y/(2 eta k |n:D|) (RK4; k as in RadialVonMises).
template <class Surface>
class SmoothYield {
    static constexpr int dim = Surface::dim;

  public:
    /// Throws InputError for constants that make no sense.
    SmoothYield(const Surface& surface, const LinearHardening& flow, double width = 0.1)
        : surface_(surface),
          flow_(flow),
          width_(valid_yield_width(width)) {
        flow_.validate();
    }

    /// With nothing but a stress: of a solid that has not yet flowed.
    SymTensor<dim> stress_rate(const Mat<dim>& grad_v, const SymTensor<dim>& stress) const {
        return flowing(grad_v, stress, 0.0, 0.0).stress_rate;
    }
    double sound_speed(double density) const { return surface_.elastic().sound_speed(density); }
    std::string describe() const {
        return fmt::format(
            "smoothly yielding solid {}, lambda = {:.6g}, eta = {:.6g}, {}, width {:g}",
            Surface::name(), surface_.lambda, surface_.eta, flow_.describe(), width_);
    }

    std::vector<Field> history() const {
        std::vector<Field> fields{field_kind::flowing_plastic_strain};
        if (Surface::across) fields.emplace_back(field_kind::stress_zz);
        return fields;
    }
    bool settle(double, std::size_t, const State<dim>&) const { return false; }

    auto rates(const ConstState<dim>& state, const State<dim>& rate) const {
        return [*this, eps = state.find(field_kind::flowing_plastic_strain),
                zz = Surface::across ? state.find(field_kind::stress_zz) : nullptr,
                eps_dot = rate.find(field_kind::flowing_plastic_strain),
                zz_dot = Surface::across ? rate.find(field_kind::stress_zz) : nullptr](
                   std::size_t i, const Mat<dim>& grad_v, const SymTensor<dim>& stress) {
            const Flowing f = flowing(grad_v, stress, Surface::across ? zz[i] : 0.0, eps[i]);
            eps_dot[i] = f.strain_rate;
            if (Surface::across) zz_dot[i] = f.zz_rate;
            return f.stress_rate;
        };
    }

  private:
    struct Flowing {
        SymTensor<dim> stress_rate;
        double zz_rate, strain_rate;
    };
    Flowing flowing(const Mat<dim>& grad_v, const SymTensor<dim>& stress, double zz,
                    double plastic_strain) const {
        const ElasticSolid elastic = surface_.elastic();
        Flowing f{elastic.stress_rate(grad_v, stress), elastic.lambda * grad_v.trace(), 0.0};
        const auto parts = Surface::parts(stress, zz);
        const double near =
            (parts.q / flow_.yield_stress({plastic_strain}) - 1.0 + width_) / width_;
        if (!(near > 0.0)) return f;
        // n = s sqrt(k)/q, and n:D, where D_zz = 0.
        const double to_n = std::sqrt(Surface::k) / parts.q;
        double n_D = 0.0;
        for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b) n_D += parts.deviator(a, b) * grad_v(a, b);
        n_D *= to_n;
        if (!(n_D > 0.0)) return f;
        const double l = n_D * near;
        f.stress_rate = f.stress_rate + (-2.0 * surface_.eta * l * to_n) * parts.deviator;
        f.zz_rate -= 2.0 * surface_.eta * l * to_n * parts.zz;
        f.strain_rate = l / std::sqrt(Surface::k);
        return f;
    }

    Surface surface_;
    LinearHardening flow_;
    double width_;
};

static_assert(LawWithRates<SmoothYield<PlaneVonMises>, 2> &&
              LawWithRates<SmoothYield<PlaneStrainVonMises>, 2> &&
              LawWithRates<SmoothYield<SpaceVonMises>, 3>);

}  // namespace spam
