// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/cluster_list.hpp>
#include <spam/rhs/sweeps.hpp>
#include <spam/rhs/wall_rates.hpp>

#include <cstdint>
#include <vector>

namespace spam {

/// The sweeps of a term once more, over the images behind each wall alone. These are neighbours of few
/// particles: both are copied together and swept, at a cost that goes by the length of the walls and not by
/// the number of particles.
template <int Dim>
class WallSweeps {
  public:
    /// For each wall of the box that has images. Images of images, at corners, are behind the wall of the last
    /// direction (Ghosts::behind): every pair counts once.
    explicit WallSweeps(const Box<Dim>& box);

    /// Sets v_dot and e_dot to what the sweep stores of them; several sweeps in turn find what they find in
    /// the term's own output. An `approach` (of own ranges) comes into e_dot. To be called next to the whole
    /// sweep: later ones find other records. Allocates only after a build of the list.
    void sweep(const ClusterList<Dim>& list, const SweepInput<Dim>& in, Sweep<Dim> run);

    /// Null where that side has no images.
    const WallRates<Dim>* find(int a, bool upper) const;
    /// change(rates): where a term makes something else of what was swept.
    template <class Change>
    void for_each(const Change& change) {
        for (Part& part : parts_) change(part.rates);
    }

  private:
    struct Part {
        WallRates<Dim> rates{};
        std::size_t build = 0;  ///< of which list; 0: of none
        std::size_t particles = 0;
        std::vector<std::uint32_t> slots{};  ///< of the list, by slot here: particles, then images
        std::vector<std::uint32_t> order{}, entries{};
        std::vector<ClusterView::Entries> clusters{};
        std::vector<double> records{}, not_wanted{};
    };

    static void gather(Part& part, const ClusterList<Dim>& list, std::size_t stride);
    static void number_places(Part& part, const ClusterList<Dim>& list);

    std::vector<Part> parts_;
};

}  // namespace spam
