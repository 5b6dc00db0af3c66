// SPDX-License-Identifier: GPL-3.0-or-later
#include "packed_particles.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spam {
namespace {

/// Of a list that no machine's memory holds, or a sum that takes minutes.
constexpr double most_pairs = 2e9;

}  // namespace

/// Returns how many particles have moved too far for the list.
template <int Dim>
std::size_t PackedParticles<Dim>::pack(const PackedFields& fields, bool density_only) {
    const PackCount count =
        make_records_.write({fields, list_.order(), &list_.home(), list_.displacement(), stride_},
                            density_only, records_.data());
    invalid_ = count.invalid;
    return count.far;
}

template <int Dim>
bool PackedParticles<Dim>::follow(std::size_t n, const PackedFields& fields) {
    // Most often nobody has gone too far, and packing has read all positions anyway.
    ++served_;
    if (list_.size() == n && pack(fields, false) == 0) return refresh(), true;
    const Eigen::Map<const Points<Dim>> x(fields.x, Dim, static_cast<Eigen::Index>(n));
    if (list_.serves(x)) return refresh(), true;
    if (!x.allFinite()) return false;
    if (list_.builds() > 0 && list_.skin() > 0.0) choose_skin();
    list_.build(x);
    records_.resize(list_.slots() * stride_);
    pack(fields, false);
    refresh();
    return true;
}

template <int Dim>
std::vector<double> PackedParticles<Dim>::summed_density(Sweep<Dim> sum, std::size_t n,
                                                         const PackedFields& fields) {
    std::vector<double> rho(n, std::numeric_limits<double>::quiet_NaN());
    if (!follow(n, fields)) return rho;
    SweepOutput<Dim> out;
    out.rho = rho.data();
    sum(input(), out);
    return rho;
}

template <int Dim>
void PackedParticles<Dim>::load_density(const PackedFields& fields) {
    pack(fields, true);
    refresh();
}

template <int Dim>
double valid_range(double range, double spacing, std::size_t particles) {
    if (!(range > spacing) || !(range < 1e6 * spacing))
        throw InputError(fmt::format(
            "range: {} must lie above the particle spacing {} (else no particle has a neighbour) "
            "and below 1e6 spacings; 2 to 4 spacings are usual",
            range, spacing));
    constexpr double ball[] = {2.0, std::numbers::pi, 4.0 / 3.0 * std::numbers::pi};
    const auto n = static_cast<double>(particles);
    const double pairs = 0.5 * n * std::min(n, ball[Dim - 1] * std::pow(range / spacing, Dim));
    if (pairs > most_pairs)
        throw InputError(fmt::format(
            "range: {} makes some {:.0e} pairs of {} particles, and more than {:.0e} cannot be "
            "summed over; give a shorter range (2 to 4 spacings are usual) or fewer particles",
            range, pairs, particles, most_pairs));
    return range;
}

/// By what the list that is used up has served: never by the clock, or no run could be repeated.
template <int Dim>
void PackedParticles<Dim>::choose_skin() {
    if (served_ < 8) share_ = std::min(1.25 * share_, most_share);
    if (served_ > 60) share_ = std::max(share_ / 1.25, least_share);
    list_.set_skin(share_ * weight_.range());
    served_ = 0;
}

template double valid_range<1>(double, double, std::size_t);
template double valid_range<2>(double, double, std::size_t);
template double valid_range<3>(double, double, std::size_t);
template class PackedParticles<1>;
template class PackedParticles<2>;
template class PackedParticles<3>;

}  // namespace spam
