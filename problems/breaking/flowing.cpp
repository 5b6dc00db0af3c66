// SPDX-License-Identifier: GPL-3.0-or-later
#include "flowing.hpp"

#include <spam/rhs/pair_potentials.hpp>

namespace breaking {

void add_flowing_options(Options& options, FlowingMatter& matter) {
    options.number("yield-stress", matter.yield_stress, "stress Y at which the solid yields",
                   between(1e-6, 1e6));
    options.number("tension-limit", matter.tension_limit,
                   "largest mean tension, beyond which the solid tears", between(1e-6, 1e6));
    options.number("penalty", matter.penalty,
                   "penalty kappa against motion that no deformation gradient sees",
                   between(0.0, 100.0));
    add_bond_options(options, matter.bonds);
}

std::vector<std::string> flowing_option_names() {
    auto names = bond_option_names();
    names.insert(names.end(), {"yield-stress", "tension-limit", "penalty"});
    return names;
}

MaterialVectors<2>& add_flowing_terms(ParticleModel<2>& model, const FlowingMatter& matter,
                                      const std::optional<ContactScheme>& contact) {
    const auto elastic = PolynomialSolid::like(ElasticSolid::triangular_lattice());
    MaterialVectorScheme scheme{triangular_density, matter.range, matter.penalty};
    matter.bonds.apply(scheme);
    auto& law = model.add_term<MaterialVectors<2>>(
        FlowingSolid{elastic, matter.yield_stress, matter.tension_limit}, scheme);
    if (matter.core > 0.0) model.add_term<Core<2>>(CorePotential{matter.core, matter.core_range});
    if (contact) model.add_term<Contact<2>>(*contact);
    return law;
}

}  // namespace breaking
