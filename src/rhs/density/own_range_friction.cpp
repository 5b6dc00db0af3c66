// SPDX-License-Identifier: GPL-3.0-or-later
// Friction and conduction where ranges follow the density: what pairs read, and how fast they act.
#include "../smooth_particles/fluids.hpp"
#include "../smooth_particles/resting_body.hpp"
#include "../sweeps/packed_particles.hpp"
#include <spam/physics/variable_range.hpp>
#include <spam/rhs/own_ranges.hpp>

#include <algorithm>

namespace spam {

/// What forces read, and friction and conduction.
template <int Dim>
void OwnRanges<Dim>::load_friction(const Now& now) {
    using R = RubbingRangeRecord<Dim>;
    constexpr int from = R::template at<column::Pull>;
    static_assert(R::template at<column::HalfSlope> == from + 1 &&
                  R::template at<column::InverseDensity> == from + 2 &&
                  R::template at<column::Temperature> == from + 3);
    const double* const rho = now.state.density().data();
    packed_->template write<R>(from, 4 + pair_factors, [&](std::size_t i, double* number) {
        const double h = range_[i];
        number[0] = pull_[i];
        number[1] = 0.5 / (h * h * range_power<Dim>(h));
        number[2] = 1.0 / rho[i];
        number[3] = temperature_.empty() ? 0.0 : temperature_[i];
        write_pair_factors<R, Dim, from + 4>(of(i), number + 4);
    });
}

/// As that of one range (FluidConstitution::damping), where sum m |w'|/r goes with rho/h^2.
template <int Dim>
double OwnRanges<Dim>::fastest_damping_in(std::span<const double> y) const {
    if (!rest_) return 0.0;
    const std::size_t n = range_.size();
    std::vector<double> rho(n, rest_->density), e(n, 0.0);
    if (!y.empty()) {
        const ConstState<Dim> state = this->state_of(y);
        std::copy_n(state.density().data(), n, rho.data());
        std::copy_n(state.energy().data(), n, e.data());
    }
    const double usual = resting_range();
    double fastest = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double wider = range_of(i, rho[i]) / usual;
        const double slope = rest_->slope * rho[i] / (rest_->density * wider * wider);
        fastest = std::max(
            fastest, 2.0 * pair_damping(of(i), Dim, rho[i], e[i]) * slope / (rho[i] * rho[i]));
    }
    return fastest;
}

#define SPAM_INSTANTIATE(D)                                \
    template void OwnRanges<D>::load_friction(const Now&); \
    template double OwnRanges<D>::fastest_damping_in(std::span<const double>) const;
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
