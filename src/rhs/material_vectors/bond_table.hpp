// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bond_rows.hpp"
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/physics/material_vectors.hpp>

namespace spam {

/// The neighbours of each particle, and the material vector of each. Rows hold the particles of the same body that
/// are nearer than range + skin: what is beyond the range weighs exactly nothing, so that a neighbour enters and
/// leaves with no trace, and rows serve until particles have moved by half the skin (a common rigid motion apart).
/// Then a list of those that are somewhat farther still, which lasts longer, tells how many neighbours each particle
/// has now; one that has as many bonds has no new neighbour.
template <int Dim>
class BondTable {
  public:
    static constexpr double skin = 0.1;  ///< of the range
    using Newcomer = typename BondRows<Dim>::Newcomer;

    /// Throws InputError where a periodic length is not above twice range + skin.
    BondTable(double range, const Box<Dim>& box, int lanes, const BondUpdates<Dim>& loops,
              const Points<Dim>& x, std::vector<std::int32_t> bodies,
              const MaterialWeight& weight = {});

    /// Whether every particle nearer than the range is in these rows.
    bool serves(const Eigen::Ref<const Points<Dim>>& x) {
        return motion_.within(0.5 * skin * range_, x, box_);
    }
    /// Drops bonds that are beyond range + skin, gives others that are beyond the range vectors without misfit, and
    /// finds particles that have come nearer and are in no row yet. N0: of a whole particle (Wholeness).
    void renew(const Eigen::Ref<const Points<Dim>>& x, double N0);
    /// Of the last renew(), ascending by k, then the number of j, both directions of every pair; to be admitted, and
    /// their vectors set.
    const std::vector<Newcomer>& newcomers() const { return newcomers_; }
    void admit() { rows_.enter(newcomers_); }
    /// Bonds within the range that weigh nothing, because their vectors are too long: they may be anchored anew.
    const std::vector<Newcomer>& idle() const { return idle_; }
    /// F^-1 at the last renew(), before any newcomer was admitted; 1 where there is none.
    Mat<Dim> anchoring(std::size_t k) const;

    const BondUpdates<Dim>& loops() const { return loops_; }

    std::size_t particles() const { return rows_.particles(); }
    std::size_t groups() const { return rows_.groups(); }
    /// Each once, in one part of the run.
    std::size_t pairs() const { return rows_.pairs(); }
    std::size_t updates() const { return updates_; }

    std::size_t row(std::size_t k) const { return rows_.row(k); }
    /// No bond, but the place of one: of weight 0.
    bool vacant(std::size_t k, std::size_t m) const { return rows_.vacant(k, m); }
    std::uint32_t partner(std::size_t k, std::size_t m) const { return rows_.partner(k, m); }
    /// Where j stands in the row of k, which has it.
    std::size_t place_of(std::size_t k, std::size_t j) const { return rows_.place_of(k, j); }
    Vec<Dim> X(std::size_t k, std::size_t m) const { return rows_.X(k, m); }
    double g(std::size_t k, std::size_t m) const { return rows_.g(k, m); }
    /// The partner sees no change: its vector to k is another one. g is that of X.
    void set_X(std::size_t k, std::size_t m, const Vec<Dim>& X);
    /// The same with another g, which stays until X is set again or rows are made anew.
    void set_bond(std::size_t k, std::size_t m, const Vec<Dim>& X, double g);
    /// x_j - x_k, the nearest image.
    Vec<Dim> separation(const double* x, std::size_t k, std::size_t j) const;

    static constexpr std::size_t block = BondRows<Dim>::block;
    std::size_t blocks() const { return (particles() + block - 1) / block; }
    const BondSchedule& schedule(std::size_t threads) { return rows_.schedule(threads); }
    void pass_on() { rows_.pass_on(); }

    const OtherPartners& others() const { return rows_.others(); }
    /// Of our own particles and of partners in other parts, by place: x, the positions that were loaded last.
    const double* places(const double* x) const { return others().none() ? x : at_.data(); }

    /// Positions for the loops: inside a periodic box, and some behind the last one.
    void load(const double* x) {
        place(x, x_.data());
        load_others(x);
    }
    /// The same for a view of its own, so that observers leave alone what right-hand sides have loaded.
    std::vector<double> positions(const double* x) const;
    /// For these loops, which write t.
    BondView<Dim> view(double N0);

    /// After reading, rows and their age are those that were written; rows of other particles must be renewed.
    void remember(Memory<Dim>& memory);

  private:
    void place(const double* x, double* to) const;
    void load_others(const double* x);
    void place_others(const double* x, std::vector<double>& placed, double* at) const;
    void meet_others(const double* x);
    void list_neighbours(const Eigen::Ref<const Points<Dim>>& x);
    void count_neighbours(const double* x);
    template <class Partners>
    void newcomers_of(std::size_t k, const double* x, Partners& partners,
                      std::vector<Newcomer>& newcomers) const;
    bool newcomers_by_sums(std::size_t k, const double* x, std::vector<Newcomer>& newcomers) const;
    void idle_of(std::size_t k, const double* x, std::vector<Newcomer>& idle) const;

    double range_;
    MaterialWeight weight_;
    Box<Dim> box_;
    BondUpdates<Dim> loops_;
    std::vector<std::int32_t> bodies_;
    Neighbourhood<Dim> near_;             ///< of positions, bodies and numbers
    std::vector<std::uint32_t> slot_of_;  ///< in the list, of a particle
    MotionSince<Dim> motion_;             ///< since newcomers were looked for
    MotionSince<Dim> listed_;             ///< since the list was made
    BondRows<Dim> rows_;
    std::vector<double> x_, at_, anchoring_;
    std::vector<double> missing_;  ///< NeighbourSums by particle
    std::vector<Newcomer> newcomers_, idle_;
    std::size_t updates_ = 0;
};

extern template class BondTable<2>;
extern template class BondTable<3>;

}  // namespace spam
