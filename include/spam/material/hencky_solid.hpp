// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/symmetric_eigen.hpp>
#include <spam/material/hyperelastic_law.hpp>
#include <spam/material/linear_hardening.hpp>
#include <spam/material/plastic_fields.hpp>
#include <spam/material/von_mises.hpp>

#include <limits>

namespace spam {

/// Logarithmic strain of what is elastic in F: with the plastic metric Cp^-1, b = F Cp^-1 F^t =
/// sum b_a n_a n_a, e_a = ln(b_a)/2.
template <int Dim>
struct LogarithmicStrain {
    Vec<Dim> strain;
    double zz = 0.0;
    Mat<Dim> vectors;  ///< n_a in column a

    /// `metric`: Cp^-1 - 1, as y holds it; metric_zz likewise, 0 where there is none. NaN where F is turned
    /// inside out.
    static LogarithmicStrain of(const Mat<Dim>& F, const double* metric, double metric_zz) {
        LogarithmicStrain e;
        if (!(determinant(F) > 0.0)) {
            e.strain[0] = std::numeric_limits<double>::quiet_NaN();
            return e;
        }
        SymTensor<Dim> inverse_Cp;
        std::copy_n(metric, inverse_Cp.c.size(), inverse_Cp.c.begin());
        for (int a = 0; a < Dim; ++a) inverse_Cp(a, a) += 1.0;
        const auto b = symmetric_eigen(transformed(F, inverse_Cp));
        e.vectors = b.vectors;
        for (int a = 0; a < Dim; ++a) e.strain[a] = 0.5 * std::log(b.value[a]);
        e.zz = 0.5 * std::log1p(metric_zz);
        return e;
    }
    double trace() const {
        double sum = zz;
        for (int a = 0; a < Dim; ++a) sum += strain[a];
        return sum;
    }
    /// lambda (tr e)^2/2 + eta e:e
    double energy(double lambda, double eta) const {
        double square = zz * zz;
        for (int a = 0; a < Dim; ++a) square += strain[a] * strain[a];
        return 0.5 * lambda * trace() * trace() + eta * square;
    }
    /// P = tau F^-t, tau = lambda tr e + 2 eta e.
    Mat<Dim> stress(double lambda, double eta, const Mat<Dim>& F) const {
        Vec<Dim> tau;
        for (int a = 0; a < Dim; ++a) tau[a] = lambda * trace() + 2.0 * eta * strain[a];
        const SymTensor<Dim> kirchhoff = from_eigen(tau, vectors);
        const Mat<Dim> back = inverse(F);
        Mat<Dim> P;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b)
                for (int c = 0; c < Dim; ++c) P(a, b) += kirchhoff(a, c) * back(b, c);
        return P;
    }
    /// 2 eta e along its own axes: as a stress it has the deviator of tau.
    SymTensor<Dim> as_stress(double eta) const {
        SymTensor<Dim> s;
        for (int a = 0; a < Dim; ++a) s(a, a) = 2.0 * eta * strain[a];
        return s;
    }
};

/// Hooke's law between the logarithmic strain and Kirchhoff's stress, with von Mises' surface: yielding at
/// any deformation (Simo 1992). With b = F Cp^-1 F^t = sum b_a n_a n_a, Cp^-1 the plastic metric,
///     e_a = ln(b_a)/2,   tau_a = lambda tr e + 2 eta e_a,   P = tau F^-t,   W = lambda (tr e)^2/2 + eta e:e,
/// the deviator of e returned to the surface q = Y as a stress is (von_mises.hpp). P is the derivative by F of
///     min over plastic flow of W + int Y d eps_p,
/// so that kinetic energy, W and plastic work together are kept to integrator error, and settling changes
/// neither stress nor energy: Cp^-1 = F^-1 b' F^-t of the returned b', plastic_work += int Y d eps_p.
///
/// `Surface`: PlaneVonMises, PlaneStrainVonMises or SpaceVonMises. `Flow`: a FlowStress that depends on the
/// plastic strain alone.
template <class Surface, class Flow = LinearHardening>
class HenckySolid {
    static_assert(
        !Flow::rate_dependent && !Flow::thermal,
        "the plastic work of a yield stress that depends on rates or heat is no potential");
    static constexpr int dim = Surface::dim;

  public:
    /// Throws InputError for constants that make no sense.
    HenckySolid(const Surface& surface, const Flow& flow) : surface_(surface), flow_(flow) {
        flow_.validate();
    }

    double stiffness() const { return surface_.lambda; }
    std::string describe() const {
        return fmt::format("logarithmic strain, yielding {}, lambda = {:.6g}, eta = {:.6g}, {}",
                           Surface::name(), surface_.lambda, surface_.eta, flow_.describe());
    }
    std::vector<Field> history() const {
        std::vector<Field> fields{field_kind::plastic_strain, field_kind::plastic_metric,
                                  field_kind::plastic_work};
        if (Surface::across) fields.emplace_back(field_kind::plastic_metric_zz);
        return fields;
    }

    /// What particles remember, and the law on it.
    struct InState {
        HenckySolid law;
        const double *strain, *metric, *metric_zz, *work;

        Mat<dim> stress(std::size_t i, const Mat<dim>& F) const {
            return law.elastic(*this, i, F).stress(law.surface_.lambda, law.surface_.eta, F);
        }
        double energy(std::size_t i, const Mat<dim>& F) const {
            const Elastic e = law.elastic(*this, i, F);
            return e.energy(law.surface_.lambda, law.surface_.eta) + work[i] +
                   law.flow_.work(strain[i], e.flow);
        }
    };

    InState in_state(const ConstState<dim>& state) const {
        return {*this, state.find(field_kind::plastic_strain),
                state.find(field_kind::plastic_metric),
                Surface::across ? state.find(field_kind::plastic_metric_zz) : nullptr,
                state.find(field_kind::plastic_work)};
    }

    bool settle(std::size_t i, const Mat<dim>& F, const State<dim>& state) const {
        const Elastic e = elastic(in_state(state), i, F);
        if (!(e.flow > 0.0)) return false;
        double& strain = state.find(field_kind::plastic_strain)[i];
        state.find(field_kind::plastic_work)[i] += flow_.work(strain, e.flow);
        strain += e.flow;
        // Cp^-1 - 1 = F^-1 b' F^-t - 1, b' = 1 + sum (exp(2 e_a) - 1) n_a n_a
        Vec<dim> b;
        for (int a = 0; a < dim; ++a) b[a] = std::exp(2.0 * e.strain[a]);
        SymTensor<dim> metric = transformed(inverse(F), from_eigen(b, e.vectors));
        for (int a = 0; a < dim; ++a) metric(a, a) -= 1.0;
        std::copy(metric.c.begin(), metric.c.end(),
                  state.find(field_kind::plastic_metric) + metric.c.size() * i);
        if (Surface::across) state.find(field_kind::plastic_metric_zz)[i] = std::expm1(2.0 * e.zz);
        return true;
    }

  private:
    /// Returned to the surface.
    struct Elastic : LogarithmicStrain<dim> {
        double flow = 0.0;  ///< d eps_p
    };

    Elastic elastic(const InState& now, std::size_t i, const Mat<dim>& F) const {
        Elastic e{LogarithmicStrain<dim>::of(F, now.metric + SymTensor<dim>().c.size() * i,
                                             Surface::across ? now.metric_zz[i] : 0.0)};
        const auto parts = Surface::parts(e.as_stress(surface_.eta), 2.0 * surface_.eta * e.zz);
        const double excess = parts.q - flow_.yield_stress({now.strain[i]});
        if (!(excess > 0.0)) return e;
        e.flow = flow_at(parts.q, excess, now.strain[i]);
        const double less = surface_.modulus() * e.flow / parts.q / (2.0 * surface_.eta);
        for (int a = 0; a < dim; ++a) e.strain[a] -= less * parts.deviator(a, a);
        e.zz -= less * parts.zz;
        return e;
    }

    double flow_at(double q, double excess, double strain) const {
        if constexpr (Flow::linear)
            return excess / (surface_.modulus() + flow_.yield_stress({strain + 1.0}) -
                             flow_.yield_stress({strain}));
        return falling_root(q / surface_.modulus(), [&](double d) {
            return q - surface_.modulus() * d - flow_.yield_stress({strain + d});
        });
    }

    Surface surface_;
    Flow flow_;
};

static_assert(HyperelasticLawWithMemory<HenckySolid<PlaneVonMises>, 2> &&
              HyperelasticLawWithMemory<HenckySolid<PlaneStrainVonMises>, 2> &&
              HyperelasticLawWithMemory<HenckySolid<SpaceVonMises>, 3>);

}  // namespace spam
