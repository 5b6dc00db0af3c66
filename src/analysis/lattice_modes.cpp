// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex_modes.hpp"
#include <spam/analysis/lattice_modes.hpp>
#include <spam/core/error.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {
namespace {

constexpr double touching = 1e-9;  ///< of a spacing: distances that count as none

[[noreturn]] void refuse(const std::string& what) { throw InputError("lattice modes: " + what); }

template <int Dim>
Point<Dim> nearest_separation(const Box<Dim>& box, const Points<Dim>& wrapped, Eigen::Index from,
                              Eigen::Index to) {
    return box.nearest(wrapped.col(to) - wrapped.col(from));
}

template <int Dim>
void require_wide_box(const SmoothParticleModel<Dim>& model) {
    const double reach = coupling_reach(model.scheme());
    for (int a = 0; a < Dim; ++a) {
        if (!model.box().periodic(a)) refuse("the box must be periodic in every direction");
        if (!(model.box().length(a) > 2.0 * reach))
            refuse(
                fmt::format("a periodic length of {:g} must be above {:g}, twice the distance over "
                            "which particles interact; use more cells",
                            model.box().length(a), 2.0 * reach));
    }
}

/// Every particle must have the neighbours that particle 0 has.
template <int Dim>
void require_bravais(const SmoothParticleModel<Dim>& model, const Points<Dim>& position) {
    const PairList<Dim> list(position, model.scheme().range, model.box());
    const Points<Dim> wrapped = model.box().wrapped(position);
    const double tolerance = touching * model.particles().spacing;
    // Neighbours at the range itself count or not as their last digits will have it.
    const double inside = model.scheme().range - 2.0 * tolerance;
    const auto separations = [&](std::size_t i) {
        std::vector<Point<Dim>> all;
        for (const std::uint32_t j : list.neighbours(i)) {
            all.push_back(nearest_separation(model.box(), wrapped, static_cast<Eigen::Index>(i),
                                             static_cast<Eigen::Index>(j)));
            if (all.back().norm() > inside) all.pop_back();
        }
        return all;
    };
    const auto first = separations(0);
    for (std::size_t i = 1; i < list.size(); ++i) {
        const auto own = separations(i);
        const bool same =
            own.size() == first.size() && std::ranges::all_of(own, [&](const auto& s) {
                return std::ranges::any_of(
                    first, [&](const auto& other) { return (s - other).norm() < tolerance; });
            });
        if (!same) refuse("the particles must be a Bravais lattice, all with the same neighbours");
    }
}

template <int Dim>
void require_rest(const ConstState<Dim>& state) {
    if (!state.velocity().isZero(0.0)) refuse("the lattice must be at rest");
    const auto uniform = [](const auto& field) {
        return (field.colwise() - field.col(0)).isZero(1e-14 * (1.0 + field.cwiseAbs().maxCoeff()));
    };
    if (!uniform(state.stress())) refuse("the stress must be the same everywhere");
    if (state.has(Field::density) && !uniform(state.density()))
        refuse("the density must be the same everywhere");
}

}  // namespace

double coupling_reach(const Scheme& scheme) {
    const bool by_way_of_a_third =
        scheme.density == Density::summed || scheme.density == Density::chain_rule;
    return by_way_of_a_third ? 2.0 * scheme.range : scheme.range;
}

template <int Dim>
LatticeModes<Dim>::LatticeModes(SmoothParticleModel<Dim>& model, std::span<const double> y,
                                double step) {
    if (model.scheme().angular_momentum != AngularMomentum::free)
        throw InputError(
            "angular-momentum: balanced torques have no derivative at rest, where all torques vanish "
            "(a factor depends on their signs); use free");
    if (model.scheme().viscosity > 0.0)
        throw InputError(
            "viscosity: it has no derivative at rest, because it resists approach only; use 0");
    const FieldLayout<Dim>& layout = model.layout();
    const ConstState<Dim> state(layout, y);
    require_wide_box(model);
    require_rest(state);
    require_bravais(model, Points<Dim>(state.position()));

    std::vector<double> width;  // of the disturbance of each component
    for (const auto& block : layout.blocks()) {
        if (block.field == Field::energy) continue;
        double w = step;
        if (block.field == Field::position) w *= model.particles().spacing;
        if (block.field == Field::density) w *= y[block.offset];
        for (std::size_t c = 0; c < block.components; ++c) {
            components_.push_back(block.offset + c);
            width.push_back(w);
        }
    }
    const std::size_t n = components_.size();
    const auto size = static_cast<Eigen::Index>(n);
    const auto particles = static_cast<Eigen::Index>(layout.particles());

    // Rates of the components of z, all particles: n x particles.
    std::vector<double> disturbed(y.begin(), y.end()), y_dot(y.size());
    const auto rates = [&](std::size_t entry, double by) {
        disturbed[entry] = y[entry] + by;
        model.rates(0.0, disturbed, y_dot);
        ++rhs_evaluations_;
        disturbed[entry] = y[entry];
        if (!model.failure().empty()) refuse(model.failure());
        Eigen::MatrixXd z_dot(size, particles);
        Eigen::Index row = 0;
        for (const auto& block : layout.blocks()) {
            if (block.field == Field::energy) continue;
            const auto m = static_cast<Eigen::Index>(block.components);
            z_dot.middleRows(row, m) =
                Eigen::Map<const Eigen::MatrixXd>(y_dot.data() + block.offset, m, particles);
            row += m;
        }
        return z_dot;
    };
    const Eigen::MatrixXd at_rest = rates(0, 0.0);
    std::vector<Eigen::MatrixXd> columns;  // derivatives by each component of particle 0
    double largest = 0.0, kink = 0.0;
    for (std::size_t c = 0; c < n; ++c) {
        const auto centred = [&](double w) -> Eigen::MatrixXd {
            const Eigen::MatrixXd up = rates(components_[c], w), down = rates(components_[c], -w);
            kink = std::max(kink, (up + down - 2.0 * at_rest).cwiseAbs().maxCoeff() / (2.0 * w));
            return (up - down) / (2.0 * w);
        };
        const Eigen::MatrixXd wide = centred(width[c]);
        columns.push_back((4.0 * centred(0.5 * width[c]) - wide) / 3.0);
        largest = std::max(largest, columns.back().cwiseAbs().maxCoeff());
    }
    if (kink > 1e-2 * largest)
        refuse(
            "the scheme has no derivative at rest: disturbances of both signs act differently; the "
            "range may lie on a shell of neighbours where the weight function has a kink (w2: use "
            "--range 3.1 rather than 3)");

    const Points<Dim> wrapped = model.box().wrapped(Points<Dim>(state.position()));
    for (Eigen::Index j = 0; j < particles; ++j) {
        Eigen::MatrixXd block(size, size);
        for (std::size_t c = 0; c < n; ++c)
            block.col(static_cast<Eigen::Index>(c)) = columns[c].col(j);
        if (block.isZero(0.0)) continue;
        separation_.push_back(nearest_separation(model.box(), wrapped, 0, j));
        block_.push_back(std::move(block));
    }
}

template <int Dim>
Eigen::MatrixXcd LatticeModes<Dim>::jacobian(const Point<Dim>& k) const {
    const auto size = static_cast<Eigen::Index>(components_.size());
    Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(size, size);
    for (std::size_t j = 0; j < block_.size(); ++j)
        sum += std::polar(1.0, -k.dot(separation_[j])) * block_[j];
    return sum;
}

template <int Dim>
std::vector<LatticeMode<Dim>> LatticeModes<Dim>::modes(const Point<Dim>& k) const {
    const ComplexModes found = complex_modes(jacobian(k));
    std::vector<LatticeMode<Dim>> all;
    for (Eigen::Index c = 0; c < found.values.size(); ++c)  // velocities follow positions
        all.push_back({found.values[c], found.vectors.col(c).template segment<Dim>(Dim)});
    std::ranges::stable_sort(
        all, [](const auto& a, const auto& b) { return a.rate.real() > b.rate.real(); });
    return all;
}

template <int Dim>
double LatticeModes<Dim>::growth_rate(const Point<Dim>& k) const {
    return complex_modes(jacobian(k)).values.real().maxCoeff();
}

template <int Dim>
std::vector<double> LatticeModes<Dim>::frequencies(const Point<Dim>& k) const {
    const Eigen::VectorXd all = complex_modes(jacobian(k)).values.imag();
    std::vector<double> result(all.begin(), all.end());
    std::ranges::sort(result, std::greater<>());
    result.resize(Dim);
    for (double& omega : result) omega = std::max(omega, 0.0);
    return result;
}

template <int Dim>
double LatticeModes<Dim>::frequency(const Point<Dim>& k, const Point<Dim>& direction) const {
    double best = -1.0, omega = 0.0;
    for (const auto& mode : modes(k)) {
        const double length = mode.velocity.norm();
        if (length < 1e-8) continue;  // nothing moves
        const double along =
            std::abs(mode.velocity.dot(direction.template cast<std::complex<double>>())) / length;
        if (along <= best + 1e-9) continue;
        best = along;
        omega = std::abs(mode.rate.imag());
    }
    return omega;
}

template <int Dim>
Eigen::MatrixXcd LatticeModes<Dim>::acceleration_rate(const Point<Dim>& k) const {
    const Eigen::MatrixXcd J = jacobian(k);
    return J.middleRows<Dim>(Dim) * J.middleCols<Dim>(Dim);
}

SPAM_COMPILED(template class LatticeModes);

}  // namespace spam
