// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/exact_sum.hpp>
#include <spam/diagnostics/total_energy.hpp>
#include <spam/rhs/particle_model.hpp>

#include <algorithm>

namespace spam {

template <int Dim>
std::string why_no_energy(const Model<Dim>& model) {
    if (model.promises().energy == Promise::not_kept) return "the scheme does not keep it";
    const auto& layout = model.layout();
    if (layout.has(Field::work)) return "externals change it";
    if (layout.elements() > 0) return "elements hold a part of it";
    const bool potential = layout.blocks().size() == 2 && layout.has(Field::position);
    if (!layout.has(Field::velocity) || !(layout.has(Field::energy) || potential))
        return "y holds neither energies nor positions and velocities alone";
    if (const auto* made_of = dynamic_cast<const ParticleModel<Dim>*>(&model);
        made_of != nullptr && layout.has(Field::energy))
        for (const auto& term : made_of->terms())
            if (term->nature().potential && !term->nature().own_heat)
                return "a potential holds a part of it beside the energies of particles";
    return {};
}

template <int Dim>
double total_energy(const Model<Dim>& model, std::span<const double> y) {
    const auto v = ConstState<Dim>(model.layout(), y).velocity();
    const auto& mass = model.particles().mass;
    return model.internal_energy(y) + exact_sum(mass.size(), [&](std::size_t i) {
               return 0.5 * mass[i] * v.col(static_cast<Eigen::Index>(i)).squaredNorm();
           });
}

template <int Dim>
std::size_t energy_gradient(Model<Dim>& model, double t, std::span<const double> y,
                            std::span<double> gradient) {
    const ConstState<Dim> state(model.layout(), y);
    const State<Dim> slope(model.layout(), gradient);
    const auto& mass = model.particles().mass;
    const Eigen::Map<const Eigen::RowVectorXd> m(mass.data(),
                                                 static_cast<Eigen::Index>(mass.size()));
    const bool potential = !state.has(Field::energy);
    if (potential) {
        model.rates(t, y, gradient);
        slope.position() = -(slope.velocity() * m.asDiagonal());
    } else {
        std::fill(gradient.begin(), gradient.end(), 0.0);
        slope.energy() = m;
    }
    slope.velocity() = state.velocity() * m.asDiagonal();
    return potential ? 1 : 0;
}

#define SPAM_INSTANTIATE(D)                                                          \
    template std::string why_no_energy(const Model<D>&);                             \
    template double total_energy(const Model<D>&, std::span<const double>);          \
    template std::size_t energy_gradient(Model<D>&, double, std::span<const double>, \
                                         std::span<double>);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
