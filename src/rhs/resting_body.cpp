// SPDX-License-Identifier: GPL-3.0-or-later
#include "resting_body.hpp"

#include <spam/neighbors/pair_list.hpp>

#include <cmath>

namespace spam {

template <int Dim>
RestingBody resting_body(const Particles<Dim>& particles, const Box<Dim>& box,
                         const GeneralWeight<Dim>& weight) {
    const PairList<Dim> list(particles.reference_position, weight.range(), box);
    const auto& x = particles.reference_position;
    RestingBody sum{0.0, 0.0};
    for (std::size_t i = 0; i < list.size(); ++i)
        for (const std::uint32_t j : list.neighbours(i)) {
            double r2 = 0.0;
            for (int a = 0; a < Dim; ++a) {
                const double s = box.nearest_image(
                    a, box.wrap(a, x(a, static_cast<Eigen::Index>(i))) - box.wrap(a, x(a, j)));
                r2 += s * s;
            }
            const double m = particles.mass[j], r = std::sqrt(r2);
            sum.density += m * weight.value(r);
            if (i != j) sum.slope += m * weight.minus_slope_over_r(r);
        }
    const auto n = static_cast<double>(list.size());
    return {sum.density / n, sum.slope / n};
}

template RestingBody resting_body(const Particles<1>&, const Box<1>&, const GeneralWeight<1>&);
template RestingBody resting_body(const Particles<2>&, const Box<2>&, const GeneralWeight<2>&);
template RestingBody resting_body(const Particles<3>&, const Box<3>&, const GeneralWeight<3>&);

}  // namespace spam
