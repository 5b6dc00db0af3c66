// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/linear_hardening.hpp>
#include <spam/material/plane_stress_return.hpp>
#include <spam/material/plastic_fields.hpp>
#include <spam/material/stress_law.hpp>
#include <spam/material/von_mises.hpp>

#include <algorithm>
#include <concepts>

namespace spam {

/// An elastic solid whose stress does not leave a yield surface: sigma_dot is the elastic law's, and of what
/// it makes of the stress the closest point on the surface counts, in every right-hand side (ReturningLaw).
/// After a step that is the stress, and the plastic strain grows by what the return took. The energy equation
/// needs no further term: the work of the returned stress is all the work there is, elastic and plastic.
///
/// `Surface`: PlaneVonMises, PlaneStrainVonMises, PlaneStressVonMises or SpaceVonMises; `Flow`: any FlowStress.
/// One step's error of the return is not seen by an embedded method's estimate of errors.
template <class Surface, class Flow = LinearHardening>
class YieldingSolid {
    static_assert(!Flow::thermal ||
                      std::is_same_v<Surface, RadialVonMises<Surface::dim, Surface::across>>,
                  "the elastic energy of plane stress is not that of a mean stress and q alone");
    static constexpr int dim = Surface::dim;
    static constexpr bool in_lanes =
        std::same_as<Surface, PlaneStressVonMises> && std::same_as<Flow, LinearHardening>;

  public:
    /// Throws InputError for constants that make no sense.
    YieldingSolid(const Surface& surface, const Flow& flow, const Failure& failure = {})
        : surface_(surface),
          flow_(flow),
          failure_(failure) {
        flow_.validate();
        failure_.validate();
    }

    SymTensor<dim> stress_rate(const Mat<dim>& grad_v, const SymTensor<dim>& stress) const {
        return surface_.elastic().stress_rate(grad_v, stress);
    }
    double sound_speed(double density) const { return surface_.elastic().sound_speed(density); }

    std::string describe() const {
        return fmt::format("yielding solid {}, lambda = {:.6g}, eta = {:.6g}, {}{}",
                           Surface::name(), surface_.lambda, surface_.eta, flow_.describe(),
                           failure_.describe());
    }

    std::vector<Field> history() const {
        std::vector<Field> fields{field_kind::plastic_strain};
        if (Surface::across) fields.emplace_back(field_kind::stress_zz);
        if (Flow::rate_dependent) fields.emplace_back(field_kind::settled_at);
        if (failure_.possible()) fields.emplace_back(field_kind::broken);
        return fields;
    }

    auto return_map(double t, const ConstState<dim>& state) const {
        return [*this, memory = Memory(t, state)](std::size_t i, const SymTensor<dim>& trial) {
            return returned(memory, i, trial).stress;
        };
    }

    /// What return_map() finds for the particles [first, first + count), many at once: in plane stress each
    /// is a root, a chain of operations that wait for each other.
    void return_block(double, const ConstState<dim>& state, std::size_t first, std::size_t count,
                      double* to) const requires in_lanes {
        const double* const from = state.stress().data();
        return_plane_stress(surface_, flow_, count, state.find(field_kind::plastic_strain) + first,
                            from + 3 * first, to + 3 * first);
        if (!failure_.possible()) return;
        const Memory memory(0.0, state);
        for (std::size_t i = first; i < first + count; ++i) {
            if (memory.broken[i] == 0.0) continue;
            const SymTensor<dim> left =
                broken({{from[3 * i], from[3 * i + 1], from[3 * i + 2]}}, 0.0).stress;
            std::copy(left.c.begin(), left.c.end(), to + 3 * i);
        }
    }

    /// sigma_zz_dot = lambda div v.
    auto rates(const ConstState<dim>&, const State<dim>& rate) const requires(Surface::across) {
        return [elastic = surface_.elastic(), zz_dot = rate.find(field_kind::stress_zz)](
                   std::size_t i, const Mat<dim>& grad_v, const SymTensor<dim>& stress) {
            zz_dot[i] = elastic.lambda * grad_v.trace();
            return elastic.stress_rate(grad_v, stress);
        };
    }

    bool settle(double t, std::size_t i, const State<dim>& state) const {
        const Memory memory(t, ConstState<dim>(state));
        SymTensor<dim> trial;
        const auto stress = state.stress().col(static_cast<Eigen::Index>(i));
        for (int c = 0; c < SymTensor<dim>::size; ++c)
            trial.c[static_cast<std::size_t>(c)] = stress[c];
        const ReturnedStress<dim> now = returned(memory, i, trial);
        const bool breaks =
            memory.broken != nullptr && memory.broken[i] == 0.0 &&
            failure_.reached(memory.plastic_strain[i] + now.strain, now.stress, mean(now));
        if (Flow::rate_dependent) state.find(field_kind::settled_at)[i] = t;
        if (breaks) state.find(field_kind::broken)[i] = 1.0;
        if (!breaks && now.strain == 0.0 && now.stress.c == trial.c) return Flow::rate_dependent;
        state.find(field_kind::plastic_strain)[i] += now.strain;
        const ReturnedStress<dim> kept = breaks ? broken(now.stress, now.zz) : now;
        for (int c = 0; c < SymTensor<dim>::size; ++c)
            state.stress()(c, static_cast<Eigen::Index>(i)) =
                kept.stress.c[static_cast<std::size_t>(c)];
        if (Surface::across) state.find(field_kind::stress_zz)[i] = kept.zz;
        return true;
    }

  private:
    /// Where the fields of the law begin; null for those it does not have.
    struct Memory {
        const double *plastic_strain, *zz, *settled_at, *broken, *energy;
        double t;
        Memory(double now, const ConstState<dim>& state)
            : plastic_strain(state.find(field_kind::plastic_strain)),
              zz(Surface::across ? state.find(field_kind::stress_zz) : nullptr),
              settled_at(Flow::rate_dependent ? state.find(field_kind::settled_at) : nullptr),
              broken(state.find(field_kind::broken)),
              energy(Flow::thermal ? state.find(Field::energy) : nullptr),
              t(now) {}
    };

    double mean(const ReturnedStress<dim>& r) const {
        double sum = r.zz;
        for (int a = 0; a < dim; ++a) sum += r.stress(a, a);
        return sum / (Surface::three ? 3.0 : 2.0);
    }

    ReturnedStress<dim> broken(const SymTensor<dim>& stress, double zz) const {
        ReturnedStress<dim> left;
        const double pressed = std::min(mean({stress, zz, 0.0}), 0.0);
        for (int a = 0; a < dim; ++a) left.stress(a, a) = pressed;
        if (Surface::across) left.zz = pressed;
        return left;
    }

    ReturnedStress<dim> returned(const Memory& memory, std::size_t i,
                                 const SymTensor<dim>& trial) const {
        const double zz = Surface::across ? memory.zz[i] : 0.0;
        if (memory.broken != nullptr && memory.broken[i] != 0.0 && failure_.possible())
            return broken(trial, zz);
        const double strain = memory.plastic_strain[i];
        const double passed = Flow::rate_dependent ? memory.t - memory.settled_at[i] : 0.0;
        // At the beginning of a step there has been no time to flow.
        if (Flow::rate_dependent && !(passed > 0.0)) return {trial, zz, 0.0};
        const auto yield_stress = [&](double d, [[maybe_unused]] double elastic_energy) {
            FlowState state{strain + d};
            if constexpr (Flow::rate_dependent) state.rate = d / passed;
            if constexpr (Flow::thermal)
                state.temperature =
                    flow_.T_room +
                    (memory.energy[i] - elastic_energy / flow_.density) / flow_.heat_capacity;
            state.modulus = surface_.modulus();
            return flow_.yield_stress(state);
        };
        const double slope = Flow::linear ? yield_stress(1.0, 0.0) - yield_stress(0.0, 0.0)
                                          : std::numeric_limits<double>::quiet_NaN();
        return surface_.returned(trial, zz, slope, yield_stress);
    }

    Surface surface_;
    Flow flow_;
    Failure failure_;
};

static_assert(ReturningLaw<YieldingSolid<PlaneVonMises>, 2> &&
              ReturningLaw<YieldingSolid<PlaneStrainVonMises>, 2> &&
              LawWithRates<YieldingSolid<PlaneStrainVonMises>, 2> &&
              ReturningLaw<YieldingSolid<PlaneStressVonMises>, 2> &&
              ReturningLaw<YieldingSolid<SpaceVonMises>, 3>);

}  // namespace spam
