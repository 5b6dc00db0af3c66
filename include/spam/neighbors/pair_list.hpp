// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/box.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace spam {

/// Throws InputError where more than one image of a particle may be closer than `reach`: then the nearest
/// image of a separation is not the only one that counts.
template <int Dim>
void require_one_image(const Box<Dim>& box, double reach);

/// For every particle i the particles j with |r_ij| < reach, i itself included, in ascending j, without
/// images behind walls: for set-up and observers. Right-hand sides sweep a ClusterList.
template <int Dim>
class PairList {
  public:
    /// Positions Dim x N, finite, not necessarily wrapped. Throws InputError when a periodic length
    /// is not above 2 reach.
    PairList(const Points<Dim>& position, double reach, const Box<Dim>& box);

    std::span<const std::uint32_t> neighbours(std::size_t i) const {
        return {entries_.data() + start_[i], start_[i + 1] - start_[i]};
    }
    std::size_t size() const { return start_.size() - 1; }

  private:
    std::vector<std::size_t> start_;
    std::vector<std::uint32_t> entries_;
};

SPAM_COMPILED(extern template class PairList);

}  // namespace spam
