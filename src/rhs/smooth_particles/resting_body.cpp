// SPDX-License-Identifier: GPL-3.0-or-later
#include "resting_body.hpp"

#include <spam/core/exact_sum.hpp>
#include <spam/core/parts.hpp>
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/physics/record.hpp>

#include <cmath>

namespace spam {

template <int Dim>
RestingBody resting_body(const Particles<Dim>& particles, const Box<Dim>& box,
                         const GeneralWeight<Dim>& weight) {
    using R = PointRecord<Dim>;
    const double* const X = particles.reference_position.data();
    Neighbourhood<Dim> near(weight.range(), ListUse::once, box, 1, R::numbers, R::kinds);
    near.build(particles.reference_position);
    near.template write<R>(0, R::numbers, [&](std::size_t i, double* record) {
        std::copy_n(X + Dim * i, Dim, record);
        record[Dim] = particles.mass[i];
    });
    const auto& list = near.list();
    const auto sums = exact_sums(list.size(), [&](std::size_t slot) {
        std::array<double, 2> of_slot{};
        for (const std::uint32_t entry : list.entries(slot)) {
            const std::size_t other = entry / R::numbers;
            double r2 = 0.0;
            for (int a = 0; a < Dim; ++a) {
                const double s = near.record(slot)[a] - near.record(other)[a];
                r2 += s * s;
            }
            const double m = near.record(other)[Dim], r = std::sqrt(r2);
            of_slot[0] += m * weight.value(r);
            if (other != slot) of_slot[1] += m * weight.minus_slope_over_r(r);
        }
        return of_slot;
    });
    const auto n = static_cast<double>(Parts::here().total(list.size()));
    return {sums[0] / n, sums[1] / n};
}

template RestingBody resting_body(const Particles<1>&, const Box<1>&, const GeneralWeight<1>&);
template RestingBody resting_body(const Particles<2>&, const Box<2>&, const GeneralWeight<2>&);
template RestingBody resting_body(const Particles<3>&, const Box<3>&, const GeneralWeight<3>&);

}  // namespace spam
