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
/// Density. Along the path of a particle that moves with u, rho_dot = -rho div v + (u - v).grad rho, and the
/// last is small where the fluid is hardly compressed. But particles that flow crowd again and again, what the
/// continuity equation sees, and shifting parts them again, what it does not: by it alone densities rise without
/// limit (5 % in twenty turns of a cavity, whose pressure then disorders the particles). So shifting adds
///     2 (u_i - v_i) . sum_j m_j grad_i w_ij
/// to rho_dot. Then sum m rho changes exactly as sum m_i m_j w_ij does while particles move with u, and stays
/// bounded with it: the second part is -rho div(u - v) + div(rho (u - v)) in pairs (Sun et al. 2019) of equal
/// densities, of second order in the disorder, where the rate of the summed density is of first.
/// Images behind no-slip walls stand where mirrors put them and move otherwise, so that densities there still
/// drift (in the cavity by .1 % each L/U): sum them.
/// With the summed density rho follows u by itself. Then shifting does no work but takes pressure away, and
/// what it takes stays in e. The density by the chain rule is the summed one.
///
/// What it neglects. A particle that is shifted takes its v and e along; the matter there has others, by
/// (u - v).grad. (Taylor-Green vortices, 50 x 50: that changes the error of velocities from .018 to .016.) The
/// convective force of Adami et al., rho v (u - v), is antisymmetric but not Galilean covariant; (u - v).grad v
/// is covariant and would not keep sum m v: none is both, for particles whose masses are fixed.
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
        Vec<Dim, T> gradient;  ///< sum_j m_j grad_i w_ij
    };
    template <class T>
    struct Result {
        Vec<Dim, T> u;
        T rho_dot;  ///< what shifting takes from the density
    };
    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        sums.crowding += mean.over(j.m, i.rho, j.rho) * pair.grad_w;
        sums.gradient += j.m * pair.grad_w;
    }
    template <class T, class Record>
    Result<T> result(const Record& i, const Sums<T>& sums) const {
        const Vec<Dim, T> shift = T(-coefficient) * sums.crowding;
        return {i.v + shift, T(2.0) * dot(shift, sums.gradient)};
    }
    /// On top of the density's rate, which a pass before it has stored.
    template <class To, class T>
    static void store(const To& to, const Result<T>& found) {
        to.set(to.out.x_dot, found.u);
        if (to.out.rho_dot != nullptr) to.add(to.out.rho_dot, found.rho_dot);
    }
};

}  // namespace spam
