// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/neighbourhood.hpp>
#include <spam/rhs/sweeps.hpp>

#include <optional>
#include <vector>

namespace spam {

/// A neighbourhood whose records are made of fields of y, as sweeps want them (Pack).
template <int Dim>
class PackedParticles : public Neighbourhood<Dim> {
  public:
    /// `range`: where it is not the weight's.
    PackedParticles(const GeneralWeight<Dim>& weight, ListUse use, const Box<Dim>& box,
                    const Sweeps<Dim>& sweeps, std::optional<double> range = {})
        : Neighbourhood<Dim>(range.value_or(weight.range()), use, box, sweeps.width, sweeps.numbers,
                             sweeps.pack.kinds),
          weight_(weight),
          make_records_(sweeps.pack) {}

    /// List and records for n particles. False where a position is not finite: nothing may be swept.
    bool follow(std::size_t n, const PackedFields& fields);
    /// Of what follow() or load_density() met last.
    std::size_t invalid_densities() const { return invalid_; }
    /// Densities for n particles, summed by that sweep; NaN where a position is not finite.
    std::vector<double> summed_density(Sweep<Dim> sum, std::size_t n, const PackedFields& fields);
    /// Density and what depends on it, where it became known after follow().
    void load_density(const PackedFields& fields);

    /// For observers: list and records of their own, as Neighbourhood::for_observer().
    PackedParticles for_observer() const {
        return {Neighbourhood<Dim>::for_observer(), weight_, make_records_};
    }
    SweepInput<Dim> input() const {
        return {this->list().view(), this->records(), this->range(), &weight_};
    }

  private:
    PackedParticles(Neighbourhood<Dim> near, const GeneralWeight<Dim>& weight,
                    const Pack<Dim>& pack)
        : Neighbourhood<Dim>(std::move(near)),
          weight_(weight),
          make_records_(pack) {}
    std::size_t pack(const PackedFields& fields, bool density_only);

    GeneralWeight<Dim> weight_;
    Pack<Dim> make_records_;
    std::size_t invalid_ = 0;
};

/// The sweep once more, over the images behind each wall alone: sets v_dot and e_dot of BehindWall to what the sweep
/// stores of them; several sweeps in turn find what they find in the term's own output. An `approach` (of own
/// ranges) comes into e_dot. To be called next to the whole sweep: later ones find other records.
template <int Dim>
void sweep_walls(Neighbourhood<Dim>& near, const SweepInput<Dim>& in, Sweep<Dim> sweep);

/// The range, if it makes sense for so many particles of this spacing; else throws InputError.
template <int Dim>
double valid_range(double range, double spacing, std::size_t particles);

}  // namespace spam
