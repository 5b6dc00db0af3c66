// SPDX-License-Identifier: GPL-3.0-or-later
#include "matter.hpp"

#include "../kernels/lattices.hpp"
#include "flowing.hpp"
#include <spam/material/embedded_atom.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/pair_potentials.hpp>

namespace breaking {
namespace {

constexpr Kernel kernel_of_atoms = Kernel::w5;  // a curvature needs a smoother one than Lucy's
constexpr double range_of_atoms = 2.5;

template <int Dim>
constexpr double lattice_density = Dim == 2 ? triangular_density : std::numbers::sqrt2;

/// Of the lattice: what there is at a site, by the weight function.
template <int Dim>
double site_density(Kernel kernel, double range) {
    const auto weight = weight_function<Dim>(spam::to_string(kernel), range);
    if constexpr (Dim == 2) {
        return kernels::relative_density<2>(kernels::triangular(), weight, Point<2>::Zero()) /
               kernels::triangular().volume();
    } else {
        double sum = 0.0;
        const Points<Dim> sites = lattice_ball<Dim>(range);
        for (const auto& site : sites.colwise()) sum += weight.value(site.norm());
        return sum;
    }
}

template <int Dim>
DensityPotentials potentials_of(const Session& session, const Matter& matter) {
    DensityPotentials potentials;
    potentials.kernel = session.given("kernel") ? session.scheme().kernel : kernel_of_atoms;
    potentials.range = session.given("range") ? session.scheme().range : range_of_atoms;
    potentials.state = EmbeddedAtom{1.0, site_density<Dim>(potentials.kernel, potentials.range)};
    potentials.surface_tension = matter.surface_tension;
    potentials.strength = matter.strength;
    if (matter.core > 0.0) potentials.core = {matter.core, matter.core_range};
    return potentials;
}

template <int Dim>
Material<Dim> yielding_solid(const Matter& matter) {
    const auto elastic = ElasticSolid::triangular_lattice();
    Failure failure;
    if (matter.failure_strain) failure.plastic_strain = *matter.failure_strain;
    return YieldingSolid(
        RadialVonMises<Dim>{elastic.lambda, elastic.eta},
        LinearHardening{matter.yield_stress.value_or(usual_yield_stress), matter.hardening},
        failure);
}

}  // namespace

double relative_step(const Matter& matter) {
    const Matter usual;
    double step = 1.0;
    if (matter.kind != MatterKind::pair_md && matter.kind != MatterKind::elements)
        step *=
            spam::relative_step({matter.core, matter.core_range}, {usual.core, usual.core_range});
    if (matter.kind == MatterKind::embedded_atom)
        step *= std::min(relative_step_of_strength(matter.strength, usual.strength),
                         relative_step_of_strength(matter.surface_tension, usual.surface_tension));
    if (matter.kind == MatterKind::material_vectors)
        step *= relative_step_of_strength(matter.penalty, usual.penalty);
    return step;
}

namespace {

FlowingSolid flowing_solid(const Matter& matter) {
    const double yield_stress = matter.yield_stress.value_or(usual_yield_stress);
    return {PolynomialSolid::like(ElasticSolid::triangular_lattice()), yield_stress,
            matter.tension_limit.value_or(yield_stress)};
}

template <int Dim>
MaterialVectorScheme vectors_of(const Session& session, const Matter& matter) {
    MaterialVectorScheme scheme{lattice_density<Dim>, session.scheme().range, matter.penalty};
    matter.bonds.apply(scheme);
    return scheme;
}

template <int Dim>
void add_terms_among(const Session& session, const Matter& matter, ParticleModel<Dim>& model,
                     std::size_t first, std::size_t count) {
    switch (matter.kind) {
        case MatterKind::pair_md:
            model.template add_term_among<Cohesion<Dim>>(first, count);
            return;
        case MatterKind::embedded_atom:
            model.template add_term_among<DensityPotentialTerm<Dim>>(
                first, count, potentials_of<Dim>(session, matter));
            return;
        case MatterKind::material_vectors:
            model.template add_term_among<MaterialVectors<Dim>>(first, count, flowing_solid(matter),
                                                                vectors_of<Dim>(session, matter));
            break;
        case MatterKind::spam:
        case MatterKind::elements:
        case MatterKind::all:
            model.template add_term_among<SmoothParticles<Dim>>(
                first, count, yielding_solid<Dim>(matter), session.scheme());
    }
    if (matter.core > 0.0)
        model.template add_term_among<Core<Dim>>(first, count,
                                                 CorePotential{matter.core, matter.core_range});
}

void refuse_impossible(const Matter& matter) {
    if (matter.kind == MatterKind::pair_md) return;
    refuse_short_core(matter.core, matter.core_range, "--core 0");
    if (matter.core > 0.0 && matter.core_range > 1.0)
        refuse(
            "core-range: {:g} is above the spacing, 1, so that neighbours would push each other "
            "away from the start; give 1 or less",
            matter.core_range);
}

}  // namespace

std::string_view to_string(MatterKind kind) {
    constexpr std::string_view names[] = {"pair_md",          "embedded_atom", "spam",
                                          "material_vectors", "elements",      "all"};
    return names[static_cast<std::size_t>(kind)];
}

std::string title_of(MatterKind kind) {
    return kind == MatterKind::pair_md            ? "pair potential"
           : kind == MatterKind::embedded_atom    ? "embedded atoms"
           : kind == MatterKind::elements         ? "finite elements"
           : kind == MatterKind::material_vectors ? "material vectors"
                                                  : "SPAM";
}

std::vector<MatterKind> kinds_of(MatterKind kind) {
    if (kind != MatterKind::all) return {kind};
    return {MatterKind::pair_md, MatterKind::embedded_atom, MatterKind::spam};
}

void add_matter_options(Problem& problem, Matter& matter, const std::vector<MatterKind>& kinds) {
    Options& options = problem.options();
    const auto only_of = [&options, &matter](const std::vector<std::string>& names,
                                             const std::vector<MatterKind>& of,
                                             const std::string& why) {
        options.only_when(
            names, {"model"},
            [&matter, of] {
                const auto asked = kinds_of(matter.kind);
                return std::any_of(asked.begin(), asked.end(), [&of](MatterKind one) {
                    return std::find(of.begin(), of.end(), one) != of.end();
                });
            },
            "has no meaning with {by}: " + why + "; leave it out");
    };
    options.choice<MatterKind>(
        "model", matter.kind, kinds,
        "molecular dynamics with a pair potential, or with potentials of the density; or smooth "
        "particles, without or with material vectors, or finite elements of a solid that yields");
    options.number("yield-stress", matter.yield_stress,
                   "stress Y at which a solid yields (default: 0.05)", between(1e-6, 1e6));
    options.number("hardening", matter.hardening,
                   "how fast Y grows with the plastic strain, H; 0 for not at all",
                   between(0.0, 1e3));
    options.number("failure-strain", matter.failure_strain,
                   "plastic strain at which a solid breaks (default: it does not)",
                   between(1e-6, 1e6));
    only_of({"yield-stress"},
            {MatterKind::spam, MatterKind::material_vectors, MatterKind::elements},
            "molecules yield by themselves");
    only_of({"hardening", "failure-strain"}, {MatterKind::spam, MatterKind::elements},
            "it is of solids with a plastic strain");
    if (std::find(kinds.begin(), kinds.end(), MatterKind::material_vectors) != kinds.end()) {
        options.number("tension-limit", matter.tension_limit,
                       "largest mean tension, beyond which material vectors tear (default: the "
                       "yield stress)",
                       between(1e-6, 1e6));
        options.number("penalty", matter.penalty,
                       "penalty kappa of material vectors against motion that no deformation "
                       "gradient sees",
                       between(0.0, 100.0));
        add_bond_options(options, matter.bonds);
        auto of_vectors = bond_option_names();
        of_vectors.insert(of_vectors.end(), {"tension-limit", "penalty"});
        only_of(of_vectors, {MatterKind::material_vectors}, "it is of material vectors");
    }
    options.number(
        "strength", matter.strength,
        "strength s_c of the curvature, which makes embedded atoms a solid",
        between(1e-6, 1.0));  // of larger ones no step of RK4 keeps the energy as promised
    options.number("surface-tension", matter.surface_tension,
                   "strength s_g of the surface tension of embedded atoms; 0 for none",
                   between(0.0, 100.0));
    only_of({"strength", "surface-tension"}, {MatterKind::embedded_atom},
            "it is of embedded atoms");
    add_core_options(options, matter.core, matter.core_range, between(0.01, 1.0), "1");
    add_disorder_options(options, matter.disorder, matter.seed,
                         "largest random displacement from the lattice at the start", 0.2, "0.01");
    only_of({"disorder", "seed"},
            {MatterKind::pair_md, MatterKind::embedded_atom, MatterKind::spam,
             MatterKind::material_vectors},
            "the mesh is regular");
    problem.use_scheme();
    only_of({"core", "core-range", "range"},
            {MatterKind::embedded_atom, MatterKind::spam, MatterKind::material_vectors},
            "it has a core or a range of its own, or none");
    only_of({"kernel"}, {MatterKind::embedded_atom, MatterKind::spam},
            "it has a weight of its own, or none");
    only_of(Problem::scheme_option_names(), {MatterKind::spam}, "it is of smooth particles");
    // The model's own where they are not given.
    for (const char* name : {"kernel", "range"})
        options.only_when({name}, {}, [&options, name] { return options.given(name); }, {});
}

template <int Dim>
Points<Dim> lattice_ball(double radius) {
    if constexpr (Dim == 2) {
        return triangular_disk(radius);
    } else {
        const double edge = cubic_edge(CubicLattice::fcc);
        const int half = static_cast<int>(std::ceil(radius / edge));
        const int cells = 2 * half + 1;
        const Points<3> sites = cubic_lattice(CubicLattice::fcc, {cells, cells, cells});
        return ball_of(sites.array() - half * edge, radius);
    }
}

template <int Dim>
std::shared_ptr<ParticleModel<Dim>> make_model(const Session& session, const Matter& matter,
                                               const std::vector<Particles<Dim>>& bodies,
                                               const std::optional<ContactScheme>& contact) {
    refuse_impossible(matter);
    auto model = std::make_shared<ParticleModel<Dim>>(joined(bodies));
    std::size_t first = 0;
    for (const Particles<Dim>& body : bodies) {
        const std::size_t count = contact ? body.size() : model->particles().size();
        add_terms_among<Dim>(session, matter, *model, first, count);
        if (!contact) break;
        first += count;
    }
    if (contact) model->template add_term<Contact<Dim>>(*contact);
    return model;
}

template <int Dim>
std::vector<double> start(ParticleModel<Dim>& model, const Points<Dim>& position, double speed) {
    auto y = initial_state<Dim>(model, lattice_density<Dim>, triangular_modulus, at_rest<Dim>());
    State<Dim>(model.layout(), y).position() = position;
    model.layout().set_scale(Field::velocity, speed);
    return y;
}

template Points<2> lattice_ball<2>(double);
template Points<3> lattice_ball<3>(double);
template std::shared_ptr<ParticleModel<2>> make_model(const Session&, const Matter&,
                                                      const std::vector<Particles<2>>&,
                                                      const std::optional<ContactScheme>&);
template std::shared_ptr<ParticleModel<3>> make_model(const Session&, const Matter&,
                                                      const std::vector<Particles<3>>&,
                                                      const std::optional<ContactScheme>&);
template std::vector<double> start(ParticleModel<2>&, const Points<2>&, double);
template std::vector<double> start(ParticleModel<3>&, const Points<3>&, double);

}  // namespace breaking
