// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parts.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <algorithm>
#include <cmath>

namespace spam {

template <int Dim>
std::vector<double> initial_state(Model<Dim>& model, double density, double modulus,
                                  const VelocityField<Dim>& velocity) {
    std::vector<double> y(model.layout().size(), 0.0);
    const State<Dim> state(model.layout(), y);
    const auto& x = model.particles().reference_position;
    state.position() = x;
    auto v = state.velocity();
    double speed = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        v.col(i) = velocity(x.col(i));
        speed = std::max(speed, v.col(i).norm());
    }
    speed = Parts::here().most(speed);
    if (state.has(Field::density)) state.density().setConstant(density);

    const double sound = std::sqrt(modulus / density);
    model.set_scales({model.particles().spacing, speed > 0.0 ? speed : sound, density, modulus});
    return y;
}

std::vector<double> lattice_state(Model<2>& model, const VelocityField<2>& velocity) {
    return initial_state<2>(model, triangular_density, triangular_modulus, velocity);
}

template std::vector<double> initial_state(Model<1>&, double, double, const VelocityField<1>&);
template std::vector<double> initial_state(Model<2>&, double, double, const VelocityField<2>&);
template std::vector<double> initial_state(Model<3>&, double, double, const VelocityField<3>&);

}  // namespace spam
