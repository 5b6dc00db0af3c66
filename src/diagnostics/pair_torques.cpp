// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/exact_sum.hpp>
#include <spam/diagnostics/pair_torques.hpp>
#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/physics/stress_force.hpp>

#include <algorithm>

namespace spam {
namespace {

std::vector<Record<2>> records(const SmoothParticleModel<2>& model, std::span<const double> y,
                               const Points<2>& wrapped) {
    const ConstState<2> state(model.layout(), y);
    const auto v = state.velocity();
    const auto sigma = state.stress();
    const auto rho = model.density(y);
    std::vector<Record<2>> all(model.particles().size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        Record<2>& record = all[i];
        for (int a = 0; a < 2; ++a) {
            record.x[a] = wrapped(a, column);
            record.v[a] = v(a, column);
        }
        record.m = model.particles().mass[i];
        record.rho = rho[i];
        for (int c = 0; c < 3; ++c)
            record.A.c[static_cast<std::size_t>(c)] = sigma(c, column) / (rho[i] * rho[i]);
    }
    return all;
}

}  // namespace

PairTorques pair_torques(const SmoothParticleModel<2>& model, std::span<const double> y) {
    const Points<2> position = ConstState<2>(model.layout(), y).position();
    const auto particle = records(model, y, model.box().wrapped(position));
    const GeneralWeight<2> weight(model.scheme().kernel, model.scheme().range);
    const PairList<2> list(position, model.scheme().range, model.box());
    PairTorques torques;
    torques.particle.assign(particle.size(), 0.0);
    for (std::size_t i = 0; i < particle.size(); ++i)
        for (const std::uint32_t j : list.neighbours(i)) {
            if (j <= i) continue;
            Vec<2> x_j = particle[j].x;
            const Vec<2> r = x_j - particle[i].x;
            const Point<2> nearest = model.box().nearest({r[0], r[1]});
            for (int a = 0; a < 2; ++a)
                if (model.box().periodic(a)) x_j[a] = particle[i].x[a] + nearest[a];
            const auto pair = make_pair<2, double>(weight, separation(particle[i].x, x_j),
                                                   particle[i], particle[j]);
            const double T = particle[i].m * particle[j].m *
                             cross(stress_force(pair, particle[i], particle[j]), pair.r_ji);
            torques.pair.push_back(T);
            torques.particle[i] += 0.5 * T;
            torques.particle[j] += 0.5 * T;
        }
    return torques;
}

double TorqueDistribution::balance_factor() const {
    return positive_sum > 0.0 && negative_sum < 0.0 ? std::sqrt(-positive_sum / negative_sum) : 1.0;
}

TorqueDistribution distribution(std::span<const double> torques) {
    TorqueDistribution result;
    ExactSum positive, negative;
    for (const double T : torques) {
        if (T > 0.0) {
            ++result.positive;
            positive += T;
        } else if (T < 0.0) {
            ++result.negative;
            negative += T;
        }
    }
    result.positive_sum = positive;
    result.negative_sum = negative;
    return result;
}

TorqueHistogram histogram(std::span<const double> torques, std::size_t bins) {
    double largest = 0.0;
    for (const double T : torques) largest = std::max(largest, std::abs(T));
    if (!(largest > 0.0)) largest = 1.0;
    TorqueHistogram result;
    result.bin_width = 2.0 * largest / static_cast<double>(bins);
    result.count.assign(bins, 0.0);
    for (std::size_t b = 0; b < bins; ++b)
        result.centre.push_back(-largest + (static_cast<double>(b) + 0.5) * result.bin_width);
    for (const double T : torques) {
        const double b = std::floor((T + largest) / result.bin_width);
        result.count[std::min(bins - 1, static_cast<std::size_t>(std::max(b, 0.0)))] += 1.0;
    }
    return result;
}

}  // namespace spam
