// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/hyperelastic_material.hpp>
#include <spam/physics/material_vectors.hpp>
#include <spam/rhs/particle_model.hpp>

#include <limits>
#include <memory>

namespace spam {

template <int Dim>
struct BondView;

/// How a solid with material vectors is summed.
struct MaterialVectorScheme {
    double density;  ///< rho_0 at the start, free of stress; sqrt(4/3) m in the triangular lattice
    double range = 3.0;  ///< h, beyond which bonds weigh nothing
    static constexpr double default_penalty = 2.0;
    /// kappa, against motion that no deformation gradient sees, in units of the stiffness of a particle's law;
    /// above 3 short waves become stiff.
    double penalty = default_penalty;
    /// Where the law yields: no misfit e_kj is longer than this times the yield strain Y/(2 eta) times
    /// |F_k X_kj|; 0: misfits do not flow. Without, plastic flow leaves misfits that harden the body; 2 or less
    /// lets particles clump.
    double bond_yield = 0.0;
    /// A pair breaks for good where the distance is more than this times one of its material vectors, and ...
    double stretch_limit = std::numeric_limits<double>::infinity();
    /// ... where the mean of the Kirchhoff stresses of its two particles pulls along it by more than this.
    double stress_limit = std::numeric_limits<double>::infinity();
    MaterialWeight weight{};  ///< of bonds, by their material vectors

    /// Estimate of the largest tension (principal Cauchy stress) under which no wave grows, for triangular lattices:
    /// with tau = tension/stiffness
    ///     kappa >= tau/(2.4 - 1.9 tau) where h is 3 spacings or more, tau/(1.6 - 1.2 tau) below that.
    /// Of the default weight: a less steep one bears less. Under 15 stresses of as many directions, from hydrostatic
    /// to shear, growth begins 1.0 to 2.4 times as high in triangular lattices, and up to a sixth lower in square
    /// ones. Greater kappa helps less and less: a lattice so much strained that shells of neighbours leave the
    /// range grows unstable anyhow. From the growth rates of BondedLattice (analysis/bonded_lattice.hpp, with its
    /// test).
    double safe_tension(double stiffness, double spacing) const {
        const bool many = range >= 3.0 * spacing * (1.0 - 1e-9);
        return penalty * stiffness *
               (many ? 2.4 / (1.0 + 1.9 * penalty) : 1.6 / (1.0 + 1.2 * penalty));
    }
};

/// What bonds that break have done so far.
struct BondBreaks {
    std::size_t pairs = 0;  ///< that have broken
    /// How often a particle's energy became larger all the same by what broke at it, and by how much in sum: one
    /// whose bonds do not span space.
    std::size_t gains = 0;
    double gained = 0.0;

    void remember(Archive& archive) { archive(pairs, gains, gained); }
};

/// A solid of smooth particles that meet new neighbours: each particle remembers a material vector for each
/// present neighbour of its body (physics/material_vectors.hpp). y = (x, v); the vectors are parameters, as a
/// neighbour list is, and change after accepted steps only:
///
///     enter   a neighbour that is new within 1.1 h, where it weighs nothing: X_kj = F_k^-1 r_kj
///     leave   beyond that, with weight 0
///     yield   of a law that flows (FlowingLaw): F_k <- F_k G, X_kj <- G^-1 X_kj, so that F X stays. Rates are those
///             of the returned stress within steps as well, and stay as they are: weights g(|X|) follow when
///             rows are made anew, where they do not add more than a thousandth of V eta to what a particle
///             stores. What flow and new weights take off the energy is heat()
///     bonds   of a law that yields, with bond_yield: where a misfit is beyond its limit, X_kj takes up the rest
///     break   beyond a stretch or a stress: both bonds of the pair weigh nothing, and none is made before
///             the particles have been seen farther apart than h (a Core keeps them from passing through each
///             other). Where the new fit F would store more, what is left at the particle is given vectors
///             X = F^-1 r of the old one
///
/// Heat never decreases: a particle whose energy would rise by one of these changes keeps its F, with vectors
/// X = F^-1 r that have no misfit to it, or, with too few neighbours for that, loses its strain. Only new weights may
/// return the small amount above.
///
/// Between such changes the motion is Hamiltonian, at the first two the energy stays as it is: p is kept exactly, L
/// and E to integrator error, and there is no tensile instability. Where a step is so long that a particle enters
/// within h, F and the energy of a whole particle stay as they are all the same, and what a particle with few
/// neighbours loses is booked as heat(). Particles of different bodies do not see each other: let them touch
/// (Contact). Bodies are those of Particles::body when the term is made.
template <int Dim>
class MaterialVectors final : public Term<Dim> {
  public:
    /// `material`: any hyperelastic law without a memory; one that is a polynomial of F (PolynomialSolid) stays
    /// smooth where particles are turned inside out. Material vectors at the start are separations of
    /// Particles::reference_position. Throws InputError for a density, range or penalty that makes no
    /// sense, a material with a memory and a periodic box not wider than 2.2 ranges.
    MaterialVectors(const Selection<Dim>& among, const HyperelasticMaterial<Dim>& material,
                    const MaterialVectorScheme& scheme);
    ~MaterialVectors() override;

    using typename Term<Dim>::Now;
    using typename Term<Dim>::Ask;
    using typename Term<Dim>::Answer;
    using typename Term<Dim>::Counts;
    std::string rates(const Now& now) override;
    bool settle(double t, const State<Dim>& state) override;
    /// Its energy is that of all particles, with heat(); its density rho_0/det F, negative where a particle is turned
    /// inside out.
    Answer answer(Ask what, std::span<const double> y) const override;
    Counts counts() const override;
    void remember(Memory<Dim>& memory) override;
    /// Of particles whose bonds are others now, what they store less is heat; where it were more, F stays.
    void take_over(const Term<Dim>& before, const ConstState<Dim>& was, const Change<Dim>& change,
                   const State<Dim>& now) override;
    /// Once a run: that the tension is above the one that the penalty keeps stable. Looks at every 32nd state,
    /// because what grows takes longer than that. And when the first pairs break, and whenever twice as many have as
    /// at the last remark.
    std::vector<Remark> watch(double t, std::span<const double> y) override;
    /// The largest principal Cauchy stress of all whole particles; below 0 where all are compressed.
    double largest_tension(std::span<const double> y) const;

    const MaterialVectorScheme& scheme() const { return scheme_; }
    /// MaterialVectorScheme::safe_tension() of the least stiff of its laws.
    double safe_tension() const;
    /// Energy that changes of the table have taken out of the motion so far.
    double heat() const;
    /// The same of each particle, N numbers.
    const std::vector<double>& heat_of_particles() const;
    const BondBreaks& breaks() const;

    /// A particle's neighbour now, for observers and tests.
    struct Bond {
        std::uint32_t partner;
        Vec<Dim> X;
        double weight;
    };
    std::vector<Bond> bonds(std::span<const double> y, std::size_t k) const;

  private:
    struct Parts;
    struct Fit;
    /// Of a law with this part of the largest stiffness.
    double safe_tension(double share) const;
    std::vector<double> tensions(std::span<const double> y) const;
    std::vector<Bond> bonds_at(const double* x, std::size_t k) const;
    Fit fit(const double* x, std::size_t k) const;
    double energy_of(const Fit& fit, std::size_t k, const ConstState<Dim>& state) const;
    std::vector<double> energies(const ConstState<Dim>& state) const;
    void set_nature();
    bool close(const BondView<Dim>& view, std::size_t first, std::size_t count,
               const ConstState<Dim>& state, double* records, bool& whole);
    bool flow(const ConstState<Dim>& state);
    bool flow_of_particle(std::size_t k, const ConstState<Dim>& state);
    bool flow_of_bonds(std::size_t k, const Mat<Dim>& F, const ConstState<Dim>& state);
    bool weigh(const ConstState<Dim>& state);
    SymTensor<Dim> kirchhoff_stress(std::size_t k, const ConstState<Dim>& state) const;
    bool break_bonds(const ConstState<Dim>& state);
    double book_loss(std::size_t k, double energy, const Fit& kept, const ConstState<Dim>& state);
    bool anchor(std::size_t k, const Fit& fit, const double* x);
    void exclude(const double* x);
    void tell_breaks(std::vector<Remark>& remarks);
    bool update(const ConstState<Dim>& state);
    std::string complaint(const ConstState<Dim>& state) const;

    HyperelasticMaterial<Dim> material_;
    MaterialVectorScheme scheme_;
    std::unique_ptr<Parts> parts_;
};

extern template class MaterialVectors<2>;
extern template class MaterialVectors<3>;

/// A solid with material vectors and nothing else.
template <int Dim>
using MaterialVectorModel =
    ModelOf<Dim, MaterialVectors<Dim>, HyperelasticMaterial<Dim>, MaterialVectorScheme>;

}  // namespace spam
