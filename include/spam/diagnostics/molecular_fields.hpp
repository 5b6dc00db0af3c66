// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/diagnostics/field_interpolation.hpp>
#include <spam/rhs/pair_forces.hpp>
#include <spam/rhs/particle_model.hpp>

#include <span>
#include <vector>

namespace spam {

/// Where the stress of two molecules that act on each other is.
enum class BondStress {
    along_bonds,  ///< all along the line that joins them: momentum is balanced
    at_particles  ///< one half at either of them: the virial, which balances it only in the mean over space
};

/// Fields of molecules at places r, by a weight function w (Hardy, J. Chem. Phys. 76, 622, 1982):
///     rho   = sum_i m_i w_i,   rho u = sum_i m_i v_i w_i,   w_i = w(|r - r_i|)
///     D k T = sum_i m_i (v_i - u)^2 w_i/sum_i w_i                       k = 1
///     rho e = sum_i (m_i v_i^2/2 + phi_i) w_i                           phi_i: half of each pair's energy
///     P     = sum_i m_i (v_i - u) (v_i - u) w_i + sum_{i<j} r_ij F_ij B_ij
/// with the bond function B_ij, the mean of w along the line from i to j. Then, without forces from outside,
///     d(rho)/dt + div(rho u) = 0,   d(rho u)/dt + div(rho u u + P) = 0
/// hold exactly at every place and time. As u is that of few molecules, the temperature is too low by a part
/// sum w^2/(sum w)^2 of the true one, in the mean over an equilibrium of equal masses.
template <int Dim>
class MolecularFields {
  public:
    using Places = typename FieldInterpolation<Dim>::Places;

    /// A state of a model as it is now. Throws InputError where a force is not one of pairs, where walls act by images,
    /// and for a periodic length that is not above twice the range of the weight or of a force.
    MolecularFields(const AnyWeight<Dim>& weight, const ParticleModel<Dim>& model,
                    std::span<const double> y);

    /// At M places. Where no particle is in range, velocity and temperature are NaN.
    struct Values {
        Eigen::RowVectorXd density;      ///< M
        Points<Dim> velocity;            ///< Dim x M
        Eigen::RowVectorXd temperature;  ///< M, as an energy
        Eigen::RowVectorXd energy;       ///< M, by volume: kinetic, that of u as well, and of pairs
        Eigen::MatrixXd pressure;        ///< D (D + 1)/2 x M, in the order of SymTensor
    };
    Values at(const Places& places, BondStress stress = BondStress::along_bonds) const;
    /// D (D + 1)/2 x M: rho u u + P, what passes momentum on.
    Eigen::MatrixXd momentum_flux(const Places& places,
                                  BondStress stress = BondStress::along_bonds) const;

  private:
    struct Bond {
        Point<Dim> middle, r_ij;
        double force_over_r;
    };
    Eigen::MatrixXd sums(const Places& places, BondStress stress) const;
    void add_bonds(const Point<Dim>& place, double* flux) const;

    AnyWeight<Dim> weight_;
    Box<Dim> box_;
    FieldInterpolation<Dim> particles_;
    Eigen::MatrixXd moments_;  ///< of particles, by mass
    std::vector<Bond> bonds_;  ///< with a force, in ascending x of their middles
    double reach_;             ///< of the range and half the longest bond
};

SPAM_COMPILED(extern template class MolecularFields);

}  // namespace spam
