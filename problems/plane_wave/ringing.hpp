// SPDX-License-Identifier: GPL-3.0-or-later
// A standing wave as long as a periodic lattice, in the plane or in space, and what is known of it beforehand.
#pragma once

#include "input.hpp"

namespace plane_wave {

/// Where the particles of a wave were at its rows, for the one that is perturbed.
template <int Dim>
struct Track {
    std::vector<double> t;
    std::vector<Points<Dim>> x;
    double distance = 0.0;  ///< of the latter, now
};

template <int Dim>
struct Ringing : Variant<Dim, SmoothParticleModel<Dim>> {
    PlaneWave wave{};  ///< in space too along y, with displacements along x or y
    /// Of the lattice without it, torques left free.
    std::shared_ptr<const LatticeModes<Dim>> modes{};
    std::shared_ptr<Track<Dim>> track{};  ///< of it or, where it is perturbed, of the other one
    bool perturbed = false;

    bool transverse() const { return wave.polarization == Polarization::transverse; }
    double wavelength() const { return this->model->box().length(1); }
    /// With this part of its wave vector.
    double omega_lattice(double part = 1.0) const {
        return modes->frequency(part * wave.k * Point<Dim>::Unit(1),
                                Point<Dim>::Unit(transverse() ? 0 : 1));
    }
    double period_continuum() const { return 2.0 * std::numbers::pi / wave.frequency(); }
    double period_lattice() const { return 2.0 * std::numbers::pi / omega_lattice(); }
};

template <int Dim>
Ringing<Dim> ringing(const Parameters& p, Polarization polarization, int cells, double amplitude,
                     const Scheme& scheme) {
    if constexpr (Dim == 2) {
        const auto [wave, solid, modes] = standing_wave(polarization, cells, amplitude, scheme);
        return {{{}, {}, {}, solid.model, solid.y0}, wave, modes};
    } else {
        const auto law = ElasticSolid::triangular_lattice();
        Scheme free = scheme;
        free.angular_momentum = AngularMomentum::free;
        const auto small = smallest_cubic_solid(p.lattice, law, free, 0.0);
        const int across = static_cast<int>(2.0 * scheme.range / p.height()) + 1;
        const auto solid = cubic_solid(p.lattice, {across, cells, across}, law, scheme, 0.0);
        const auto in_cell = static_cast<double>(cubic_lattice(p.lattice, {1, 1, 1}).cols());
        Ringing<Dim> one{{{}, {}, {}, solid.model, solid.y0},
                         {polarization, amplitude, 2.0 * std::numbers::pi / (cells * p.height()),
                          in_cell / std::pow(p.height(), 3), law},
                         std::make_shared<const LatticeModes<3>>(*small.model, small.y0)};
        // It begins in the lattice at rest, whose stresses are exact, with the largest velocities.
        const double speed = one.omega_lattice() * amplitude;
        const State<3> state(one.model->layout(), one.y0);
        state.velocity().row(one.transverse() ? 0 : 1) =
            speed * (one.wave.k * state.position().row(1)).array().sin();
        one.model->layout().set_scale(Field::velocity, speed);
        one.model->layout().set_scale(Field::energy, speed * speed);
        return one;
    }
}

/// How blocks of a transverse wave in the plane turn, and the torques of its particles.
void find_turning(Session& session, const Parameters& p, const Ringing<2>& one);

}  // namespace plane_wave
