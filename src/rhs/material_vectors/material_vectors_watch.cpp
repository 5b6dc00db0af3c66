// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the penalty is enough for the tension of a run.
#include "material_vector_parts.hpp"
#include <spam/core/symmetric_eigen.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

template <int Dim>
double MaterialVectors<Dim>::safe_tension() const {
    return safe_tension(parts_->least_share);
}

template <int Dim>
double MaterialVectors<Dim>::safe_tension(double share) const {
    return scheme_.safe_tension(material_.stiffness(), this->particles().spacing) * share;
}

/// The largest principal stress of each particle; of one that is not whole less than any.
template <int Dim>
std::vector<double> MaterialVectors<Dim>::tensions(std::span<const double> y) const {
    const ConstState<Dim> state = this->state_of(y);
    std::vector<double> largest(parts_->numbers.size());
    parts_->each_fit(state.position().data(), [&](std::size_t k, const Fit& now) {
        const double J = determinant(now.F);
        Mat<Dim> P;
        largest[k] = -HUGE_VAL;
        if (Wholeness::of(now.K, parts_->N0).th < 1.0 || !(J > 0.0) ||
            !material_.stresses({&parts_->numbers[k], 1}, P.c.size(), now.F.c.data(), P.c.data(),
                                state))
            return;
        SymTensor<Dim> cauchy;  // P F^t/J
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b)
                for (int c = 0; c < Dim; ++c) cauchy(a, b) += P(a, c) * now.F(b, c) / J;
        const Vec<Dim> principal = symmetric_eigen(cauchy).value;
        for (int a = 0; a < Dim; ++a) largest[k] = std::max(largest[k], principal[a]);
    });
    return largest;
}

template <int Dim>
double MaterialVectors<Dim>::largest_tension(std::span<const double> y) const {
    double most = -HUGE_VAL;
    for (const double of_one : tensions(y)) most = std::max(most, of_one);
    return spam::Parts::here().most(most);
}

template <int Dim>
std::vector<Remark> MaterialVectors<Dim>::watch(double, std::span<const double> y) {
    Parts& p = *parts_;
    std::vector<Remark> remarks;
    tell_breaks(remarks);
    if (p.warned || p.watched++ % 32 != 0) return remarks;
    // The one that bears least of what it has: of several laws not the largest tension.
    const auto tension = tensions(y);
    double most = -HUGE_VAL, share = 0.0;
    for (std::size_t k = 0; k < tension.size(); ++k) most = std::max(most, tension[k] / p.share[k]);
    const double largest = spam::Parts::here().most(most);
    if (!(largest > safe_tension(1.0))) return remarks;
    for (std::size_t k = 0; k < tension.size(); ++k)
        if (tension[k] / p.share[k] == largest) share = std::max(share, p.share[k]);
    share = spam::Parts::here().most(share);
    p.warned = true;
    remarks.push_back(
        {fmt::format("tension above the {:.3g} that penalty kappa = {:g} keeps stable",
                     safe_tension(share), scheme_.penalty),
         largest * share, false, true});
    return remarks;
}

#define SPAM_INSTANTIATE(D)                                                                   \
    template double MaterialVectors<D>::safe_tension() const;                                 \
    template double MaterialVectors<D>::safe_tension(double) const;                           \
    template std::vector<double> MaterialVectors<D>::tensions(std::span<const double>) const; \
    template double MaterialVectors<D>::largest_tension(std::span<const double>) const;       \
    template std::vector<Remark> MaterialVectors<D>::watch(double, std::span<const double>);
SPAM_INSTANTIATE(2)
SPAM_INSTANTIATE(3)

}  // namespace spam
