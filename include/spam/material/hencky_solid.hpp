// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/symmetric_eigen.hpp>
#include <spam/material/hyperelastic_law.hpp>
#include <spam/material/linear_hardening.hpp>
#include <spam/material/plastic_fields.hpp>
#include <spam/material/von_mises.hpp>

#include <limits>

namespace spam {

/// ln(b)/2 of a positive symmetric tensor.
template <int Dim>
SymTensor<Dim> half_logarithm(const SymTensor<Dim>& b) {
    if constexpr (Dim == 2) {
        // With m the mean of the two values and r half their difference: ln(det b)/4, and atanh(r/m)/(2 r)
        // times the deviator, by a series where r is small.
        const double m = 0.5 * (b(0, 0) + b(1, 1)), d = 0.5 * (b(0, 0) - b(1, 1)), o = b(0, 1);
        const double r2 = d * d + o * o, x2 = r2 / (m * m);
        double ratio = 0.0;  // atanh(x)/x
        if (x2 < 0.01) {
            const double x4 = x2 * x2;
            ratio = (1.0 + x2 * (1.0 / 3.0)) + x4 * ((1.0 / 5.0 + x2 * (1.0 / 7.0)) +
                                                     x4 * ((1.0 / 9.0 + x2 * (1.0 / 11.0)) +
                                                           x4 * (1.0 / 13.0 + x2 * (1.0 / 15.0))));
        } else {
            const double x = std::sqrt(x2);
            ratio = std::atanh(x) / x;
        }
        const double mean = 0.25 * std::log(m * m - r2), f = 0.5 * ratio / m;
        SymTensor<2> e;
        e(0, 0) = mean + f * d;
        e(1, 1) = mean - f * d;
        e(0, 1) = f * o;
        return e;
    } else {
        auto values = symmetric_eigen(b);
        for (double& value : values.value.c) value = 0.5 * std::log(value);
        return from_eigen(values.value, values.vectors);
    }
}

/// exp(2 e)
template <int Dim>
SymTensor<Dim> exponential_of_twice(const SymTensor<Dim>& e) {
    auto values = symmetric_eigen(e);
    for (double& value : values.value.c) value = std::exp(2.0 * value);
    return from_eigen(values.value, values.vectors);
}

/// Logarithmic strain of what is elastic in F: with the plastic metric Cp^-1, b = F Cp^-1 F^t, e = ln(b)/2.
template <int Dim>
struct LogarithmicStrain {
    SymTensor<Dim> strain;
    double zz = 0.0;

    /// `metric`: Cp^-1 - 1, as y holds it; metric_zz likewise, 0 where there is none. NaN where F is turned
    /// inside out.
    static LogarithmicStrain of(const Mat<Dim>& F, const double* metric, double metric_zz) {
        LogarithmicStrain e;
        if (!(determinant(F) > 0.0)) {
            e.strain(0, 0) = std::numeric_limits<double>::quiet_NaN();
            return e;
        }
        auto inverse_Cp = numbers_at<SymTensor<Dim>>(metric);
        for (int a = 0; a < Dim; ++a) inverse_Cp(a, a) += 1.0;
        e.strain = half_logarithm(transformed(F, inverse_Cp));
        if (metric_zz != 0.0) e.zz = 0.5 * std::log1p(metric_zz);
        return e;
    }
    double trace() const {
        double sum = zz;
        for (int a = 0; a < Dim; ++a) sum += strain(a, a);
        return sum;
    }
    /// lambda (tr e)^2/2 + eta e:e
    double energy(double lambda, double eta) const {
        double square = zz * zz;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) square += strain(a, b) * strain(a, b);
        return 0.5 * lambda * trace() * trace() + eta * square;
    }
    /// P = tau F^-t, tau = lambda tr e + 2 eta e.
    Mat<Dim> stress(double lambda, double eta, const Mat<Dim>& F) const {
        SymTensor<Dim> tau = (2.0 * eta) * strain;
        for (int a = 0; a < Dim; ++a) tau(a, a) += lambda * trace();
        const Mat<Dim> back = inverse(F);
        Mat<Dim> P;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b)
                for (int c = 0; c < Dim; ++c) P(a, b) += tau(a, c) * back(b, c);
        return P;
    }
};

/// Hooke's law between the logarithmic strain and Kirchhoff's stress, with von Mises' surface: yielding at
/// any deformation (Simo 1992). With b = F Cp^-1 F^t, Cp^-1 the plastic metric,
///     e = ln(b)/2,   tau = lambda tr e + 2 eta e,   P = tau F^-t,   W = lambda (tr e)^2/2 + eta e:e,
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

    double stiffness() const { return penalty_modulus(surface_.lambda, surface_.eta); }
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
        SymTensor<dim> metric = transformed(inverse(F), exponential_of_twice(e.strain));
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
        const auto parts =
            Surface::parts((2.0 * surface_.eta) * e.strain, 2.0 * surface_.eta * e.zz);
        const double excess = parts.q - flow_.yield_stress({now.strain[i]});
        if (!(excess > 0.0)) return e;
        e.flow = flow_at(parts.q, excess, now.strain[i]);
        const double less = surface_.modulus() * e.flow / parts.q / (2.0 * surface_.eta);
        e.strain = e.strain + (-less) * parts.deviator;
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
