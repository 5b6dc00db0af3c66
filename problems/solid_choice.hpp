// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic bodies of the three formulations, as options choose one.
#pragma once

#include "common.hpp"
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/artificial_viscosity.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/reflected_pairs.hpp>
#include <spam/rhs/total_lagrangian.hpp>

namespace spam {

/// What a scheme says of pairs, for solids that remember: the artificial viscosity and the closest approach.
template <int Dim>
void add_pair_laws(ParticleModel<Dim>& model, std::size_t first, std::size_t count,
                   const ElasticSolid& solid, double density, const Scheme& scheme) {
    if (scheme.viscosity > 0.0)
        model.template add_term_among<ArtificialViscosity<Dim>>(
            first, count,
            typename ArtificialViscosity<Dim>::Constants{scheme.viscosity, scheme.range, density,
                                                         solid.sound_speed(density),
                                                         scheme.kernel});
    if (scheme.closest_approach > 0.0)
        model.template add_term_among<ReflectedPairs<Dim>>(first, count, scheme.closest_approach);
}

/// Whether nothing damps or reflects: leapfrog is then the method for solids that remember.
inline bool undamped(const Scheme& scheme) {
    return !(scheme.viscosity > 0.0) && !(scheme.closest_approach > 0.0);
}

/// --formulation, --penalty and --viscosity.
struct SolidChoice {
    Formulation formulation = Formulation::total_lagrangian;
    std::optional<double> penalty{};    ///< kappa of the solids that remember
    std::optional<double> viscosity{};  ///< alpha
    double usual_viscosity = 0.0;       ///< of the updated solid; the others have none unless asked

    bool lagrangian() const { return formulation == Formulation::total_lagrangian; }
    bool vectors() const { return formulation == Formulation::material_vectors; }
    bool remembers() const { return lagrangian() || vectors(); }
    double kappa() const {
        return penalty.value_or(lagrangian() ? 0.1 : MaterialVectorScheme::default_penalty);
    }

    /// By what a step for the usual penalty is multiplied: a larger one is stiffer.
    double relative_step() const {
        if (lagrangian()) return relative_step_of_strength(1.0 + kappa(), 1.0 + 0.1);
        return vectors() ? relative_step_of_strength(kappa(), MaterialVectorScheme::default_penalty)
                         : 1.0;
    }
    double alpha() const { return viscosity.value_or(remembers() ? 0.0 : usual_viscosity); }
    bool damped() const { return alpha() > 0.0; }

    void add_formulation_option(Options& options) {
        options.choice<Formulation>(
            "formulation", formulation,
            {Formulation::total_lagrangian, Formulation::updated, Formulation::material_vectors},
            "sums over the initial neighbours, over the present ones, or over "
            "the present ones with a memory");
    }
    /// --formulation and --penalty beside the options of Problem::use_scheme(), of which most are those of updated
    /// particles alone; `updated`: whether there are any.
    void add_beside_scheme(Options& options, std::function<bool()> updated) {
        add_formulation_option(options);
        add_penalty_option(options);
        auto names = Problem::scheme_option_names();
        std::erase_if(names, [](const std::string& name) {
            return name == "kernel" || name == "range" || name == "viscosity" ||
                   name == "closest-approach";
        });
        options.only_when(names, {"formulation"}, std::move(updated),
                          "is of updated smooth particles; give --formulation updated, or leave it "
                          "out");
    }
    void add_penalty_option(Options& options) {
        options
            .number("penalty", penalty,
                    "penalty kappa against zero-energy modes: total_lagrangian (default 0.1), "
                    "material_vectors (default 2)",
                    between(0.0, 100.0))
            .only_when(
                {"formulation"}, [this] { return remembers(); },
                "has no meaning for --formulation updated; leave it out");
    }
    void add_constants(Options& options) {
        add_penalty_option(options);
        options.number(
            "viscosity", viscosity,
            fmt::format(
                "alpha of von Neumann's artificial viscosity (default: {:g} for updated, else 0)",
                usual_viscosity),
            between(0.0, 100.0));
    }

    /// Among `count` particles from number `first` on. `updated`: of smooth particles, but for range and viscosity.
    template <int Dim>
    void add_term(ParticleModel<Dim>& model, std::size_t first, std::size_t count,
                  const ElasticSolid& solid, double density, double range, Scheme updated) const {
        updated.range = range;
        updated.viscosity = alpha();
        if (lagrangian())
            model.template add_term_among<TotalLagrangian<Dim>>(
                first, count, StVenantKirchhoff::like(solid),
                TotalLagrangianScheme{density, range, kappa(), updated.kernel});
        else if (vectors())
            model.template add_term_among<MaterialVectors<Dim>>(
                first, count, PolynomialSolid::like(solid),
                MaterialVectorScheme{density, range, kappa()});
        else
            model.template add_term_among<SmoothParticles<Dim>>(first, count, solid, updated);
        if (remembers()) add_pair_laws(model, first, count, solid, density, updated);
    }
};

}  // namespace spam
