// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../model/other_partners.hpp"
#include "bond_schedule.hpp"
#include "bond_sweeps.hpp"
#include <spam/core/memory.hpp>
#include <spam/core/tensor.hpp>

#include <cstdint>
#include <numeric>
#include <vector>

namespace spam {

/// Bonds by particle k: row(k) of them, each with a partner, its material vector X and the fixed part g of its
/// weight; every pair stands in both rows. Rows of as many particles as there are lanes, a group, lie together
/// and are as long as the longest. A bond that is gone leaves a vacancy, whose partner is k itself and whose
/// X and g are 0: it adds exact zeros to every sum. The order of a row is that in which bonds came, whatever the
/// number of lanes. Partners in other parts of the run have places behind those of all groups, and their rows are
/// there (bond_parts.cpp).
template <int Dim>
class BondRows {
  public:
    /// Particles are summed in blocks of so many, whose bonds fit the cache.
    static constexpr std::size_t block = 128;

    BondRows(std::size_t particles, std::size_t lanes);

    std::size_t particles() const { return count_.size(); }
    std::size_t groups() const { return first_.size() - 1; }
    std::size_t lanes() const { return lanes_; }
    /// Each pair is counted in one part of the run.
    std::size_t pairs() const;

    std::size_t row(std::size_t k) const { return count_[k]; }  ///< with vacancies
    /// The lengths of all rows.
    std::size_t places() const {
        return std::accumulate(count_.begin(), count_.end(), std::size_t{0});
    }
    bool vacant(std::size_t k, std::size_t m) const { return partner(k, m) == k; }
    std::uint32_t partner(std::size_t k, std::size_t m) const { return partner_[slot(k, m)]; }
    /// Where j stands in the row of k, which has it; probably near the end.
    std::size_t place_of(std::size_t k, std::size_t j) const {
        std::size_t m = row(k) - 1;
        while (partner(k, m) != j) --m;
        return m;
    }
    Vec<Dim> X(std::size_t k, std::size_t m) const;
    double g(std::size_t k, std::size_t m) const { return vectors_[number(k, m, Dim)]; }
    void set(std::size_t k, std::size_t m, const Vec<Dim>& X, double g);

    /// A bond that is to come.
    struct Newcomer {
        std::uint32_t k, j;
        Vec<Dim> r;           ///< x_j - x_k
        std::size_t row = 0;  ///< where it stands; set by enter()
    };
    /// Takes them in, where vacancies are first, and says which row of k each has; with X = g = 0 until set().
    /// `newcomers`: ascending by k, then the number of j; those that have no other direction are dropped.
    void enter(std::vector<Newcomer>& newcomers);
    /// What bonds are left after so many have gone, where loops have written vacancies.
    void discount(std::size_t gone) { bonds_ -= gone; }
    /// Rows without vacancies, partners ascending, where these have become many in all parts of the run together.
    void tidy();

    const OtherPartners& others() const { return others_; }
    /// The partners in other parts are those that rows have and those of these numbers. Returns what OtherPartners::set
    /// returns.
    std::vector<std::uint32_t> meet(std::vector<std::uint32_t> numbers);
    /// Gives other parts what our bonds with their particles have found, and takes what theirs have: before any block
    /// that is given last.
    void pass_on();

    /// Blocks in an order for so many threads, with t laid out for it; made anew where rows have changed.
    const BondSchedule& schedule(std::size_t threads);
    /// All of a BondView that rows know.
    void show(BondView<Dim>& view);
    /// Rows in their order, vacancies included; nothing that depends on lanes.
    void remember(Memory<Dim>& memory);

  private:
    std::size_t slot(std::size_t k, std::size_t m) const {
        return first_[k / lanes_] + m * lanes_ + k % lanes_;
    }
    std::size_t number(std::size_t k, std::size_t m, std::size_t a) const {
        return (first_[k / lanes_] + m * lanes_) * (Dim + 1) + a * lanes_ + k % lanes_;
    }
    /// The place in t of a bond (place_of_lane).
    std::uint32_t place(std::size_t k, std::size_t m) const {
        return static_cast<std::uint32_t>(first_[k / lanes_] + m * lanes_ +
                                          place_of_lane(k % lanes_, lanes_)) +
               shift_[k / block];
    }
    class Meetings;
    void add(BondNumbers& contents, std::size_t k, std::size_t m) const;
    void hold(const BondNumbers& contents);
    void make_room(std::vector<Newcomer>& newcomers);
    void lay_out(const std::vector<std::uint32_t>& capacity);
    void find_reach();
    void vacate(std::size_t begin, std::size_t end, std::size_t group);
    void find_way_back(std::size_t k, std::size_t m);
    void find_ways_across(std::size_t base);

    std::size_t lanes_, bonds_ = 0;
    OtherPartners others_;
    std::vector<std::uint32_t> count_;  ///< by particle
    std::vector<std::size_t> first_;    ///< by group
    std::vector<std::uint32_t> partner_, reverse_;
    std::vector<double> vectors_, t_;
    std::vector<std::uint32_t> shift_;  ///< by block: from a slot to the place in t
    std::vector<BondSchedule::Reach> reach_;
    BondSchedule schedule_;
    bool scheduled_ = false;  ///< for these rows
    /// By part: places in t of what it is given, and of what comes from there.
    std::vector<std::vector<std::uint32_t>> given_, taken_;
};

extern template class BondRows<2>;
extern template class BondRows<3>;

}  // namespace spam
