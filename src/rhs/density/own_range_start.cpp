// SPDX-License-Identifier: GPL-3.0-or-later
// Densities and ranges that belong to each other, of particles at given places.
#include "../smooth_particles/carried_energy.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parts.hpp>
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/physics/variable_range.hpp>
#include <spam/rhs/own_ranges.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {
namespace {

/// Masses and distances of one particle's neighbours.
struct Surroundings {
    std::vector<double> mass, r;
};

/// The h at which sum_j m_j W(r_j/h) is `wanted`; it grows with h. By Newton's method, kept between
/// bounds. Infinite where it lies beyond `most`.
template <int Dim>
double solve_range(const Surroundings& near, const GeneralWeight<Dim>& unit, double wanted,
                   double start, double most) {
    const auto sums = [&](double h) {
        double value = -wanted, slope = 0.0;
        for (std::size_t k = 0; k < near.r.size(); ++k) {
            const double u = near.r[k] / h;
            value += near.mass[k] * unit.value(u);
            slope += near.mass[k] * u * u * unit.minus_slope_over_r(u) / h;
        }
        return std::pair(value, slope);
    };
    if (sums(most).first < 0.0) return std::numeric_limits<double>::infinity();
    double low = 0.0, high = most, h = std::min(start, most);
    for (int step = 0; step < 200; ++step) {
        const auto [value, slope] = sums(h);
        (value < 0.0 ? low : high) = h;
        double next = slope > 0.0 ? h - value / slope : low;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (std::abs(next - h) <= 1e-15 * h) return next;
        h = next;
    }
    return h;
}

}  // namespace

template <int Dim>
std::vector<double> OwnRanges<Dim>::solve_densities(const Points<Dim>& position) const {
    const auto& mass = this->particles().mass;
    using R = PointRecord<Dim>;
    const double start = scheme_.range * this->particles().spacing, most = most_range();
    std::vector<double> rho(mass.size());
    bool found = false;
    for (double reach = 1.2 * start; !found; reach *= 1.5) {
        const double look = std::min(reach, 0.999 * most);
        Neighbourhood<Dim> listed(look, ListUse::once, this->box(), 1, R::numbers, R::kinds);
        listed.build(position);
        listed.template write<R>(0, R::numbers, [&](std::size_t i, double* record) {
            std::copy_n(position.data() + Dim * i, Dim, record);
            record[Dim] = mass[i];
        });
        const auto at = [&](std::size_t slot) {
            return Eigen::Map<const Point<Dim>>(listed.record(slot));
        };
        found = true;
        for (std::size_t slot = 0; slot < rho.size() && found; ++slot) {
            const std::size_t i = listed.list().order()[slot];
            Surroundings near;
            for (const std::uint32_t entry : listed.list().entries(slot)) {
                near.mass.push_back(listed.record(entry / R::numbers)[Dim]);
                near.r.push_back((at(entry / R::numbers) - at(slot)).norm());
            }
            const double h = solve_range<Dim>(
                near, unit_, mass[i] * range_power<Dim>(scheme_.range), start, look);
            found = std::isfinite(h);
            rho[i] = mass[i] * range_power<Dim>(scheme_.range / h);
        }
        found = !Parts::here().any(!found);
        if (!found && (look < reach || reach > 1e6 * start))
            throw InputError(fmt::format(
                "range: with {:g} (m/rho)^(1/D) a particle finds too few neighbours within {:g}, half of "
                "the periodic box or the distance of two walls; enlarge the box or shorten --range",
                scheme_.range, most));
    }
    return rho;
}

template <int Dim>
std::vector<double> OwnRanges<Dim>::start(const Points<Dim>& position, const Points<Dim>& velocity,
                                          double T) {
    expect_start<Dim>(*this, position, velocity);
    return fluid_start<Dim>(
        this->model(), [&](std::size_t i) -> const AnyEquationOfState& { return of(i).state; },
        position, velocity, solve_densities(position), T);
}

#define SPAM_INSTANTIATE(D)                                                             \
    template std::vector<double> OwnRanges<D>::solve_densities(const Points<D>&) const; \
    template std::vector<double> OwnRanges<D>::start(const Points<D>&, const Points<D>&, double);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
