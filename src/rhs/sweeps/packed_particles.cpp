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

template <int Dim>
std::size_t PackedParticles<Dim>::pack(const PackedFields& fields, bool density_only) {
    const ClusterList<Dim>& list = this->list();
    if (list.slots() == 0) return 0;
    const PackCount count = make_records_.write(
        {fields, list.order(), &list.home(), list.displacement(), this->records().stride},
        density_only, this->record(0));
    invalid_ = count.invalid;
    return count.far;
}

template <int Dim>
bool PackedParticles<Dim>::follow(std::size_t n, const PackedFields& fields) {
    const Eigen::Map<const Points<Dim>> x(fields.x, Dim, static_cast<Eigen::Index>(n));
    return Neighbourhood<Dim>::follow(
        x, [&] { return pack(fields, false); },
        fields.rho != nullptr ? make_records_.kinds.size() : make_records_.motion);
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
    if (make_records_.density)
        this->refresh(make_records_.kinds, static_cast<int>(make_records_.motion));
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

template <int Dim>
void sweep_walls(Neighbourhood<Dim>& near, const SweepInput<Dim>& in, Sweep<Dim> sweep) {
    near.for_each_wall([&](BehindWall<Dim>& wall) {
        if (!wall.load(near.list(), in.records.numbers, in.records.stride)) return;
        SweepInput<Dim> behind = in;
        behind.list = wall.view();
        SweepOutput<Dim> out;
        behind.records.numbers = out.records = wall.records();
        out.v_dot = wall.v_dot.data();
        out.e_dot = out.approach = wall.e_dot.data();
        out.x_dot = wall.not_wanted.data();
        out.rho_dot = out.x_dot + Dim * wall.lanes();
        out.spread = out.rho_dot + wall.lanes();
        sweep(behind, out);
    });
}

#define SPAM_INSTANTIATE(D)                                                          \
    template double valid_range<D>(double, double, std::size_t);                     \
    template void sweep_walls<D>(Neighbourhood<D>&, const SweepInput<D>&, Sweep<D>); \
    template class PackedParticles<D>;
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
