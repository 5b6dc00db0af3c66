// SPDX-License-Identifier: GPL-3.0-or-later
// What searches for the entries of a part of a list's clusters share.
#pragma once

#include "../core/levels.hpp"
#include "search.hpp"
#include <spam/neighbors/cluster_list.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace spam {

/// Some clusters of a list, whose entries follow each other in one place.
template <int Dim>
class ClusterList<Dim>::Part {
  public:
    Part(ClusterList& list, std::vector<std::uint32_t>& out)
        : list_(list),
          width_(static_cast<std::size_t>(list.width_)),
          out_(out),
          search_(at_level(instruction_set(),
                           [&](auto level) { return search_for<Dim, level>(list.width_); })) {
        const double cutoff = list.range_ + list.skin_;
        input_.cutoff2 = cutoff * cutoff;
        input_.reach2 = list.reach() * list.reach();
        input_.slots = list.size_;
        input_.bounds = list.boxes_.data();
        input_.stride = list.stride_;
        for (int a = 0; a < Dim; ++a) input_.x[a] = list.x_[static_cast<std::size_t>(a)].data();
    }

    /// To be called when all of them have their entries: these move no more.
    void finish() {
        if (out_.size() < used_ + 1) out_.resize(used_ + 1);
        out_[used_] = 0;  // sweeps look one entry ahead
        const std::uint32_t* next = out_.data();
        for (const std::uint32_t cluster : finished_) {
            list_.entries_[cluster].first = next;
            next += list_.entries_[cluster].count;
        }
    }

  protected:
    /// The repeated particle of the last cluster counts once.
    unsigned members(std::size_t cluster) const {
        return static_cast<unsigned>(std::min(width_, list_.size_ - cluster * width_));
    }
    /// For that many entries of the next cluster.
    void make_room(std::size_t entries) {
        if (out_.size() < used_ + entries) out_.resize((used_ + entries) * 5 / 4);
    }
    /// Where they begin.
    std::uint32_t* begin() { return out_.data() + used_; }
    void keep(std::size_t cluster, const std::uint32_t* end) {
        const auto count = static_cast<std::size_t>(end - begin());
        used_ += count;
        list_.entries_[cluster].count = static_cast<std::uint32_t>(count);
        finished_.push_back(static_cast<std::uint32_t>(cluster));
    }

    ClusterList& list_;
    std::size_t width_;
    std::vector<std::uint32_t>& out_;
    Search<Dim> search_;
    SearchInput<Dim> input_;

  private:
    std::size_t used_ = 0;
    std::vector<std::uint32_t> finished_;
};

}  // namespace spam
