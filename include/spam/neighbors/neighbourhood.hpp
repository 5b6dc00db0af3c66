// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/parallel.hpp>
#include <spam/core/parts.hpp>
#include <spam/neighbors/behind_wall.hpp>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace spam {

/// What a list of neighbours is made for.
enum class ListUse {
    once,             ///< for one state
    again_and_again,  ///< it follows the particles, and looks a little beyond the range to last some states
    for_good          ///< for a reference configuration, whose neighbours stay
};

/// Neighbours of particles within a range, and the numbers that sweeps read of each: the one owner of a list, of
/// its records, of the images across periodic borders and behind walls, and of what each wall gives. Laws write
/// what they know of particles; images follow from it here and nowhere else.
///
///     positions -> follow() or build() -> ClusterList: slots of particles, then those of their images
///     numbers   -> write(): by slot, positions brought home -> refresh(): the same of images
///     sweep over list().view() and records() -> numbers that neighbours read next -> refresh() -> sweep ...
template <int Dim>
class Neighbourhood {
  public:
    /// For records of `numbers` numbers, the first of which are what `kinds` says, and clusters of `width`. The
    /// walls of the box that have no images are left out. Throws InputError as ClusterList does.
    Neighbourhood(double range, ListUse use, const Box<Dim>& box, int width, int numbers,
                  std::span<const NumberKind> kinds);
    /// The same with a skin that stays as it is.
    Neighbourhood(double range, double skin, const Box<Dim>& box, int width, int numbers,
                  std::span<const NumberKind> kinds);

    /// Makes list and records those of positions x, Dim x N. pack() writes the records of all slots of particles by
    /// this list and returns how many particles it found to be too far for it (ClusterList::displacement): most
    /// often none, and it has read all positions anyway. Images get the first `packed` numbers: those that it writes.
    /// False where a position is not finite: nothing may be swept.
    template <class Pack>
    bool follow(const Eigen::Ref<const Points<Dim>>& x, const Pack& pack, std::size_t packed) {
        ++served_;
        const auto written = std::span<const NumberKind>(kinds_).first(packed);
        // All parts of a run go on with their lists, or all make new ones: one exchange where all go on.
        const bool serves = list_->size() == static_cast<std::size_t>(x.cols()) && pack() == 0;
        if (list_->refresh(records_.data(), written, 0, serves)) return true;
        if (!list_->serves(x)) {
            if (Parts::here().any(!x.allFinite())) return false;
            build(x);
            pack();
        }
        refresh(written, 0);
        return true;
    }
    /// A list for these finite positions, and room for records: zeros at first.
    void build(const Eigen::Ref<const Points<Dim>>& x);

    /// fill(i, number): sets `count` numbers, from that one on, in the record R of each particle i, positions as they
    /// are in y; these come home as in ClusterList::home. Images follow.
    template <class R, class Fill>
    void write(int from, int count, const Fill& fill) {
        write(from, count, fill, R::kinds);
    }
    template <class Fill>
    void write(int from, int count, const Fill& fill, std::span<const NumberKind> kinds) {
        const auto order = list_->order();
        const Home<Dim> home = list_->home();
        const auto of_these = kinds.subspan(static_cast<std::size_t>(from),
                                            std::min(kinds.size() - static_cast<std::size_t>(from),
                                                     static_cast<std::size_t>(count)));
        const auto is_position = [](const NumberKind& kind) {
            return kind.quantity == Quantity::position;
        };
        const bool moved =
            home.periods != nullptr && std::any_of(of_these.begin(), of_these.end(), is_position);
        parallel_for(order.size(), [&](std::size_t slot) {
            double* const number = record(slot) + from;
            fill(std::size_t{order[slot]}, number);
            if (!moved) return;
            for (std::size_t k = 0; k < of_these.size(); ++k)
                if (is_position(of_these[k]))
                    number[k] = home(order[slot], of_these[k].a, number[k]);
        });
        refresh(kinds, from);
    }
    /// Gives images what the records of their particles hold now, as a record R from a number on: before every sweep
    /// that reads of neighbours what was written since.
    template <class R>
    void refresh(int from) {
        refresh(R::kinds, from);
    }
    void refresh(std::span<const NumberKind> kinds, int from) {
        list_->refresh(records_.data(), kinds, static_cast<std::size_t>(from));
    }

    const ClusterList<Dim>& list() const { return *list_; }
    int numbers() const { return static_cast<int>(numbers_); }  ///< in a record
    /// Of slot 0 where there are no particles as well: a part may have none.
    double* record(std::size_t slot) { return records_.data() + slot * numbers_; }
    const double* record(std::size_t slot) const { return records_.data() + slot * numbers_; }
    Records records() const { return {records_.data(), numbers_}; }
    double range() const { return range_; }
    bool for_good() const { return use_ == ListUse::for_good; }

    /// For observers: records of their own, so that those of right-hand sides stay as they are. Of a list for good
    /// with a copy of them; any other list is made anew by the first follow().
    Neighbourhood for_observer() const;
    /// Forgets list and records of particles that are not there any more, and all that followed from them.
    void forget();
    /// Another range, for lists to come.
    void set_range(double range);

    /// change(BehindWall&): of every wall that has images.
    template <class Change>
    void for_each_wall(const Change& change) {
        for (BehindWall<Dim>& wall : walls_) change(wall);
    }
    /// Null where that side has no images.
    const BehindWall<Dim>* behind(int a, bool upper) const;

  private:
    // Of the range. The first costs about a tenth more lanes; a wider one pays where lists are soon used up.
    static constexpr double first_share = 0.075, least_share = 0.05, most_share = 0.36;
    double skin() const { return use_ == ListUse::again_and_again ? share_ * range_ : skin_; }
    void choose_skin();

    double range_, skin_ = 0.0;
    ListUse use_;
    Box<Dim> box_;
    int width_;
    std::size_t numbers_;
    std::vector<NumberKind> kinds_;
    double share_ = first_share;
    std::size_t served_ = 0;                  ///< states by this list
    std::shared_ptr<ClusterList<Dim>> list_;  ///< shared by observers where it stays
    std::vector<double> records_;             ///< by slot
    std::vector<BehindWall<Dim>> walls_;
};

SPAM_COMPILED(extern template class Neighbourhood);

}  // namespace spam
