// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/pair.hpp>
#include <spam/physics/pass_constants.hpp>

namespace spam {

/// Shifting: particles of a stirred fluid move from where they crowd to where they are missing,
///     u_i = v_i - D sum_j (m_j/rho_ij) grad_i w_ij,   D = Scheme::shifting times c times h,
/// with the sound speed c of the fluid at rest and the range h: Fick's law for the concentration of particles
/// (Lind et al. 2012), the velocity of a background pressure that acts on positions alone (Adami, Hu and
/// Adams 2013: their D is p_b dt/rho), and the form of Sun et al. (2017; their D is Ma c h). It is a function
/// of the state and knows no step. Where particles stand evenly the sum is 0. A displacement of wave number
/// k decays at the rate D k^2 W(k), W the transform of the weight function: choose one with W > 0 (w4, w5).
///
/// What it keeps. Sum m v, exactly: no force is added. Sum m u = sum m v, because m_j/rho_ij is symmetric: the
/// centre of mass moves as it should. The energy, as without it: stress, work and friction use v. Angular
/// momentum: not, sum m u x v is not 0. Galilean covariance: u - v is made of positions.
///
/// What it neglects. A particle that is shifted takes its v, e and, with the density of the continuity
/// equation, rho along; the matter there has others, by (u - v).grad. Mass is then that of the equation,
/// rho_dot = -rho div v, and no longer the count of particles, whose sum wanders about it. (Taylor-Green
/// vortices, 50 x 50: both differ by .005; the terms left out change the velocities' error from .032 to .032
/// in rho and from .018 to .016 in v.) Adami's convective force, rho v (u - v), is antisymmetric but not
/// Galilean covariant, and grad v would not keep sum m v: there is none that is both, for particles whose
/// masses are fixed.
/// With the summed density particles are the mass and rho follows u. Then shifting does no work but takes
/// pressure away, and what it takes stays in e. The density by the chain rule is the summed one.
///
/// Needs a pressure that is zero on average (EmbeddedAtom): a background of pressure makes the forces of the
/// particles' disorder that shifting is to spare the momentum.
template <int Dim, class MeanDensity>
struct ShiftingTransport {
    double coefficient = 0.0;  ///< D times MeanDensity::factor
    [[no_unique_address]] MeanDensity mean{};
    static ShiftingTransport with(const PassConstants& c) {
        return {MeanDensity::factor * c.shifting, MeanDensity::of(c.mean_density)};
    }

    template <class T>
    struct Sums {
        Vec<Dim, T> crowding;  ///< by `factor`
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        sums.crowding += mean.over(j.m, i.rho, j.rho) * pair.grad_w;
    }
    template <class T, class Record>
    Vec<Dim, T> result(const Record& i, const Sums<T>& sums) const {
        return i.v - T(coefficient) * sums.crowding;
    }
    template <class To, class T>
    static void store(const To& to, const Vec<Dim, T>& u) {
        to.set(to.out.x_dot, u);
    }
};

}  // namespace spam
