// SPDX-License-Identifier: GPL-3.0-or-later
// What each wall gives to smooth particles.
#include "packed_particles.hpp"
#include <spam/rhs/smooth_particles.hpp>

namespace spam {

/// Those that energy passes: heat through them is worth knowing one by one.
template <int Dim>
void SmoothParticles<Dim>::tell_walls_apart() {
    const std::size_t n = this->particles().size();
    for (int a = 0; a < Dim; ++a)
        for (const bool upper : {false, true})
            if (const auto& wall = this->box().wall(a, upper); !wall.open() && wall.passes_energy())
                walls_.push_back({a, upper, std::vector<double>(Dim * n), std::vector<double>(n)});
    if (!walls_.empty()) not_wanted_.resize((Dim + 1) * n);
}

/// The same sweep over the images behind one wall alone. These are neighbours of few particles, and so it
/// costs little beside the whole sweep. To be called next to that one: later sweeps find other records.
template <int Dim>
void SmoothParticles<Dim>::sweep_walls(const SweepInput<Dim>& in,
                                       void (*sweep)(const SweepInput<Dim>&,
                                                     const SweepOutput<Dim>&)) {
    for (WallRates& wall : walls_) {
        SweepInput<Dim> behind = in;
        behind.list = packed_->list().behind_wall(wall.axis, wall.upper);
        SweepOutput<Dim> out;
        out.x_dot = not_wanted_.data();
        out.rho_dot = not_wanted_.data() + Dim * this->particles().size();
        out.v_dot = wall.v_dot.data();
        out.e_dot = wall.e_dot.data();
        sweep(behind, out);
    }
}

#define SPAM_INSTANTIATE(D)                               \
    template void SmoothParticles<D>::tell_walls_apart(); \
    template void SmoothParticles<D>::sweep_walls(        \
        const SweepInput<D>&, void (*)(const SweepInput<D>&, const SweepOutput<D>&));
SPAM_INSTANTIATE(1)
SPAM_INSTANTIATE(2)
SPAM_INSTANTIATE(3)

}  // namespace spam
