// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wall_sweeps.hpp"
#include <spam/neighbors/cluster_list.hpp>
#include <spam/rhs/sweeps.hpp>

#include <vector>

namespace spam {

enum class ListUse { once, again_and_again };

/// The cluster list of a model, and in its order the records that sweeps read. Both follow the
/// particles; the list is built anew only when they have moved too far for it.
template <int Dim>
class PackedParticles {
  public:
    /// Records for these sweeps. A list that is used again looks a little beyond the range, so that it
    /// lasts some right-hand sides.
    PackedParticles(const GeneralWeight<Dim>& weight, ListUse use, const Box<Dim>& box,
                    const Sweeps<Dim>& sweeps)
        : list_(weight.range(), use == ListUse::once ? 0.0 : first_share * weight.range(),
                box.of_images(), sweeps.width, static_cast<std::size_t>(sweeps.numbers)),
          walls_(list_.box()),
          weight_(weight),
          stride_(static_cast<std::size_t>(sweeps.numbers)),
          make_records_(sweeps.pack) {}

    /// List and records for n particles. False where a position is not finite: nothing may be swept.
    bool follow(std::size_t n, const PackedFields& fields);
    /// Of what follow() or load_density() met last.
    std::size_t invalid_densities() const { return invalid_; }
    /// Densities for n particles, summed by that sweep; NaN where a position is not finite.
    std::vector<double> summed_density(Sweep<Dim> sum, std::size_t n, const PackedFields& fields);
    /// Density and what depends on it, where it became known after follow().
    void load_density(const PackedFields& fields);
    /// Gives images of particles what their records hold now, as a record R from number `from` on: before
    /// every sweep that reads of neighbours what was written since.
    template <class R>
    void refresh(int from) {
        refresh(R::kinds, from);
    }
    void refresh(std::span<const NumberKind> kinds, int from) {
        list_.refresh(records_.data(), kinds, static_cast<std::size_t>(from));
    }

    /// The sweep once more, for the images behind each wall alone (WallSweeps::sweep).
    WallSweeps<Dim>& sweep_walls(const SweepInput<Dim>& in, Sweep<Dim> sweep) {
        walls_.sweep(list_, in, sweep);
        return walls_;
    }
    const WallSweeps<Dim>& walls() const { return walls_; }

    const ClusterList<Dim>& list() const { return list_; }
    int numbers() const { return static_cast<int>(stride_); }  ///< in a record
    double* record(std::size_t slot) { return &records_[slot * stride_]; }
    SweepInput<Dim> input() const {
        return {list_.view(), {records_.data(), stride_}, weight_.range(), &weight_};
    }

  private:
    // Of the range. The first costs about a tenth more lanes; a wider one pays where lists are soon
    // used up.
    static constexpr double first_share = 0.075, least_share = 0.05, most_share = 0.36;

    /// Images of what has been packed.
    void refresh() { list_.refresh(records_.data(), make_records_.kinds); }
    void choose_skin();
    std::size_t pack(const PackedFields& fields, bool density_only);

    ClusterList<Dim> list_;
    WallSweeps<Dim> walls_;
    GeneralWeight<Dim> weight_;
    std::size_t stride_;
    Pack<Dim> make_records_;
    std::vector<double> records_;  ///< by slot
    std::size_t invalid_ = 0;
    double share_ = first_share;
    std::size_t served_ = 0;  ///< right-hand sides by this list
};

/// The range, if it makes sense for so many particles of this spacing; else throws InputError.
template <int Dim>
double valid_range(double range, double spacing, std::size_t particles);

}  // namespace spam
