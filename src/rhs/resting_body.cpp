// SPDX-License-Identifier: GPL-3.0-or-later
#include "resting_body.hpp"

#include <spam/core/exact_sum.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/physics/record.hpp>

#include <cmath>

namespace spam {

template <int Dim>
RestingBody resting_body(const Particles<Dim>& particles, const Box<Dim>& box,
                         const GeneralWeight<Dim>& weight) {
    const auto& X = particles.reference_position;
    ClusterList<Dim> list(weight.range(), 0.0, box.of_images(), 1, Dim);
    list.build(X);
    std::vector<double> x(list.slots() * Dim);
    for (std::size_t slot = 0; slot < list.size(); ++slot)
        for (std::size_t a = 0; a < Dim; ++a)
            x[slot * Dim + a] =
                list.home()(list.order()[slot], a, X.data()[list.order()[slot] * Dim + a]);
    list.refresh(x.data(), RecordOf<Dim, double, column::Position>::kinds);
    const auto sums = exact_sums(list.size(), [&](std::size_t slot) {
        std::array<double, 2> of_slot{};
        for (const std::uint32_t entry : list.entries(slot)) {
            double r2 = 0.0;
            for (std::size_t a = 0; a < Dim; ++a) {
                const double s = x[slot * Dim + a] - x[entry + a];
                r2 += s * s;
            }
            const double m = particles.mass[list.particle(entry / Dim)], r = std::sqrt(r2);
            of_slot[0] += m * weight.value(r);
            if (entry != slot * Dim) of_slot[1] += m * weight.minus_slope_over_r(r);
        }
        return of_slot;
    });
    const auto n = static_cast<double>(list.size());
    return {sums[0] / n, sums[1] / n};
}

template RestingBody resting_body(const Particles<1>&, const Box<1>&, const GeneralWeight<1>&);
template RestingBody resting_body(const Particles<2>&, const Box<2>&, const GeneralWeight<2>&);
template RestingBody resting_body(const Particles<3>&, const Box<3>&, const GeneralWeight<3>&);

}  // namespace spam
