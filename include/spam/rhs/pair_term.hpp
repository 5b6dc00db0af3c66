// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/pair_forces.hpp>
#include <spam/rhs/sweeps.hpp>
#include <spam/rhs/term.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace spam {

template <int Dim>
class PackedParticles;

/// A law of pairs, as registered_sweeps() or a *.lanes.cpp gives it.
template <int Dim>
struct PairLaw {
    /// `force` and `energy` (half of each pair's); `density` where the law has one. Null: no potential. Their records
    /// begin with the columns of PointRecord, or of MotionRecord where velocities matter; behind these come `columns`.
    Sweeps<Dim> sweeps;
    double
        range;  ///< no pair farther apart acts on each other; infinite: every pair does, in no box with images
    std::string description;  ///< for the banner of a run
    PassConstants constants{};
    /// What the law needs of every particle besides position and mass, N numbers each (charges, sizes).
    std::vector<std::vector<double>> columns{};
    /// What each column is, in images of a particle and across the border of a periodic box; empty: plain
    /// numbers, which all images share. Those of a position are moved by the periods of the particle.
    std::vector<NumberKind> kinds{};
    Kernel kernel = Kernel::lucy;  ///< the weight function of passes that take one
    /// Of a force that takes energy from the motion, whose sweep sets e_dot as well: the field of y, by mass, that
    /// integrates it. It is part of the energy of the term; the material is not heated by it.
    std::optional<Field> heat{};
    double damping =
        0.0;  ///< by it: how fast neighbours at rest lose their relative velocity, 1/time
    /// Sets energy and force of two particles, whose numbers are those of the selection. `periods`: r_ij less the
    /// difference of their positions. Null where forces are not along r_ij (friction), or unknown.
    std::function<void(PairForce<Dim>& pair, const Point<Dim>& periods)> of_pair{};

    /// Of some of the particles.
    PairLaw of_part(std::span<const std::uint32_t> numbers) const {
        PairLaw part = *this;
        part.of_pair = {};  // by numbers of the whole
        for (std::size_t c = 0; c < columns.size(); ++c) {
            part.columns[c].clear();
            for (const auto i : numbers) part.columns[c].push_back(columns[c].at(i));
        }
        return part;
    }
};

/// Forces between pairs: by a potential of their distance, or friction.
template <int Dim>
class PairTerm : public Term<Dim>, public ForcesOfPairs<Dim> {
  public:
    /// Throws InputError for a range that is not above 0, for a periodic box narrower than a fifth of the range
    /// and for columns that are not as long as there are particles.
    PairTerm(const Selection<Dim>& among, PairLaw<Dim> law);
    ~PairTerm() override;

    using typename Term<Dim>::Now;
    using typename Term<Dim>::Ask;
    using typename Term<Dim>::Answer;
    std::string rates(const Now& now) override;
    Answer answer(Ask what, std::span<const double> y) const override;
    std::optional<std::vector<PairForce<Dim>>> pair_forces(
        std::span<const double> y) const override;

  private:
    std::size_t own_columns() const { return law_.sweeps.pack.kinds.size(); }
    double pair_energy(std::span<const double> y) const;
    std::vector<NumberKind> record_kinds() const;
    bool follow(PackedParticles<Dim>& packed, const ConstState<Dim>& state) const;
    SweepInput<Dim> input(const PackedParticles<Dim>& packed) const;

    PairLaw<Dim> law_;
    std::vector<NumberKind> kinds_;  ///< of a record, as its images need them
    std::unique_ptr<PackedParticles<Dim>> packed_;
};

SPAM_COMPILED(extern template class PairTerm);

}  // namespace spam
