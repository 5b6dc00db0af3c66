// SPDX-License-Identifier: GPL-3.0-or-later
#include "torque_factors_in_space.hpp"

#include <algorithm>

namespace spam {
namespace {

Vec<3> space_vector(const double* field, std::size_t i) {
    return numbers_at<Vec<3>>(field + 3 * i);
}

TorqueMoments moments_from(const std::array<double, torque_moments>& numbers) {
    return {numbers_at<Vec<3>>(numbers.data()), numbers_at<SymTensor<3>>(&numbers[3])};
}

}  // namespace

/// Of what the sweep has found, half: it has met every pair twice.
TorqueMoments TorqueFactors<3>::moments_of(std::size_t i, const Vec<3>& theta) const {
    TorqueMoments m;
    const double* const found = &moments_[torque_moments * i];
    for (int a = 0; a < 3; ++a) m.torque[a] = 0.5 * found[a];
    if (by_pair_) {
        for (std::size_t c = 0; c < 6; ++c) m.spread.c[c] = 0.5 * found[3 + c];
        return m;
    }
    const TorqueDirection<double> direction(m.torque);
    m.torque = exponential(-dot(theta, direction.n)) * m.torque;
    for (int a = 0; a < 3; ++a)
        for (int b = a; b < 3; ++b) m.spread(a, b) = m.torque[a] * direction.n[b];
    return m;
}

/// Of every group, with its multiplier of now.
auto TorqueFactors<3>::sums(const Groups& groups) -> std::span<const Numbers> {
    ++search_.sums;
    return sums_.of(groups.group, groups.count, [&, this](std::size_t i) {
        const TorqueMoments m =
            moments_of(i, balances_[static_cast<std::size_t>(groups.group[i])].theta());
        Numbers numbers;
        std::copy(m.torque.c.begin(), m.torque.c.end(), numbers.begin());
        std::copy(m.spread.c.begin(), m.spread.c.end(), numbers.begin() + 3);
        return numbers;
    });
}

void TorqueFactors<3>::balance(const Groups& groups, const double* u, const double* v) {
    balances_.assign(groups.count, {});
    const auto at_zero = sums(groups);
    // sum m u x v vanishes for v and Monaghan's average: not to be mistaken for what its rounding leaves.
    X_.assign(groups.count, {});
    if (own_rate_) {
        const auto rates = rates_.of(groups.group, groups.count, [&](std::size_t i) {
            return (groups.mass[i] * cross(space_vector(u, i), space_vector(v, i))).c;
        });
        for (std::size_t g = 0; g < groups.count; ++g) X_[g].c = rates[g];
    }
    for (std::size_t g = 0; g < groups.count; ++g)
        balances_[g].begin(moments_from(at_zero[g]), X_[g]);
    ++search_.balances;
    const auto done = [](const TorqueBalance& b) { return b.done(); };
    wants_sums_ = !std::all_of(balances_.begin(), balances_.end(), done);
    if (by_pair_) return;
    while (wants_sums_) go_on(groups);
    parallel_for(factor_.size(), [&, this](std::size_t i) {
        const TorqueBalance& of_group = balances_[static_cast<std::size_t>(groups.group[i])];
        const TorqueDirection<double> direction(space_vector(&moments_[torque_moments * i], 0));
        factor_[i] = exponential(-dot(of_group.theta(), direction.n));
    });
}

void TorqueFactors<3>::go_on(const Groups& groups) {
    const auto at_theta = sums(groups);
    wants_sums_ = false;
    for (std::size_t g = 0; g < groups.count; ++g) {
        TorqueBalance& of_group = balances_[g];
        if (!of_group.done()) of_group.next(moments_from(at_theta[g]));
        wants_sums_ = wants_sums_ || !of_group.done();
    }
}

void TorqueFactors<3>::write(std::size_t i, std::int32_t group, double* number) const {
    number[0] = number[1] = by_pair_ ? 1.0 : factor_[i];
    const Vec<3> theta = by_pair_ ? balances_[static_cast<std::size_t>(group)].theta() : Vec<3>{};
    std::copy(theta.c.begin(), theta.c.end(), number + 3);
}

void TorqueFactors<3>::remember(Memory<3>& memory) {
    static constexpr FieldKind sums_kind{"torque_sums", Rank::scalar, Role::memory, "1"};
    memory.run(sums_kind, search_.balances, search_.sums);
}

TorqueSearch TorqueFactors<3>::search() const {
    TorqueSearch search = search_;
    for (const TorqueBalance& of_group : balances_)
        search.residual = std::max(search.residual, of_group.residual());
    return search;
}

}  // namespace spam
