// SPDX-License-Identifier: GPL-3.0-or-later

#include "entropy.hpp"

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

/// (D/2) ln(e_int / rho^(2/D))
template <int Dim>
double entropy(double e_int, double rho) {
    return 0.5 * Dim * std::log(e_int) - std::log(rho);
}

/// e_int - e from sums of (1, e, v, v^2) over neighbours. <v^2> - <v>^2 >= 0; where a node sees one
/// particle only the two are the same but for their rounding, which in a thin gas is more than e: its
/// logarithm would not exist.
template <int Dim>
double heat_of_motion(const Eigen::Ref<const Eigen::VectorXd>& sum, Heat heat) {
    const double v2 = sum(2 + Dim) / sum(0);
    const double mean2 = (sum.segment<Dim>(2) / sum(0)).squaredNorm();
    return 0.5 * (heat == Heat::all_motion ? v2 : std::max(0.0, v2 - mean2));
}

/// Masses of particles and images.
template <int Dim>
std::vector<double> masses(const std::vector<double>& mass, const WallImages<Dim>& images) {
    std::vector<double> all = mass;
    for (const auto owner : images.owner) all.push_back(mass[static_cast<std::size_t>(owner)]);
    return all;
}
template <int Dim>
Points<Dim> joined(const Points<Dim>& of_particles, const Points<Dim>& of_images) {
    Points<Dim> all(Dim, of_particles.cols() + of_images.cols());
    all << of_particles, of_images;
    return all;
}

}  // namespace

template <int Dim>
GasEntropy<Dim>::GasEntropy(const AnyWeight<Dim>& weight, const std::vector<double>& mass,
                            const Points<Dim>& position, const Points<Dim>& velocity,
                            const std::vector<double>& density, const std::vector<double>& energy,
                            const Box<Dim>& box)
    : images_(images_behind_walls<Dim>(box, weight.range(), position, velocity)),
      fields_(weight, masses(mass, images_), joined<Dim>(position, images_.position), box),
      position_(position),
      mass_(Eigen::VectorXd::Map(mass.data(), position.cols())),
      density_(Eigen::VectorXd::Map(density.data(), position.cols())),
      energy_(Eigen::VectorXd::Map(energy.data(), position.cols())),
      carried_(Dim + 3, position.cols() + images_.count()) {
    const Points<Dim> v = joined<Dim>(velocity, images_.velocity);
    carried_.row(0).setOnes();
    carried_.row(1) = images_.with_particles(energy_.transpose());
    carried_.template middleRows<Dim>(2) = v;
    carried_.row(2 + Dim) = v.colwise().squaredNorm();
}

template <int Dim>
const Eigen::MatrixXd& GasEntropy<Dim>::sums_at_particles() const {
    if (at_particles_.cols() != position_.cols()) at_particles_ = fields_.sum(carried_, position_);
    return at_particles_;
}

template <int Dim>
double GasEntropy<Dim>::of_particles(Heat heat) const {
    const Eigen::MatrixXd& sum = sums_at_particles();
    double total = 0.0;
    for (Eigen::Index i = 0; i < sum.cols(); ++i) {
        const double e_int = energy_(i) + heat_of_motion<Dim>(sum.col(i), heat);
        total += mass_(i) * entropy<Dim>(e_int, density_(i));
    }
    return total / mass_.sum();
}

/// energy(sums, rho): e at a node.
template <int Dim>
template <class Energy>
double GasEntropy<Dim>::integral(const FieldGrid<Dim>& grid, Heat heat,
                                 const Energy& energy) const {
    const Eigen::MatrixXd sum = fields_.sum(carried_, grid.points());
    double total = 0.0;
    for (Eigen::Index p = 0; p < sum.cols(); ++p) {
        const double rho = sum(0, p);
        if (!(rho > 0.0)) continue;
        const double e_int = energy(sum(1, p), rho) + heat_of_motion<Dim>(sum.col(p), heat);
        total += rho * entropy<Dim>(e_int, rho);
    }
    return total * grid.spacing.prod() / mass_.sum();
}

template <int Dim>
double GasEntropy<Dim>::on_grid(const FieldGrid<Dim>& grid, Heat heat,
                                const std::function<double(double rho)>& energy) const {
    return integral(grid, heat, [&](double, double rho) { return energy(rho); });
}

template <int Dim>
double GasEntropy<Dim>::on_grid(const FieldGrid<Dim>& grid, Heat heat) const {
    return integral(grid, heat, [](double rho_e, double rho) { return rho_e / rho; });
}

SPAM_COMPILED(template class GasEntropy);

}  // namespace spam
