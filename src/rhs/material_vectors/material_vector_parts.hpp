// SPDX-License-Identifier: GPL-3.0-or-later
// What the sources of MaterialVectors share.
#pragma once

#include "bond_table.hpp"
#include <spam/core/parallel.hpp>
#include <spam/physics/material_vectors.hpp>
#include <spam/rhs/material_vectors.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace spam {

/// What the bonds of one particle say.
template <int Dim>
struct MaterialVectors<Dim>::Fit {
    Fit() = default;
    explicit Fit(const double* record)
        : F(numbers_at<Mat<Dim>>(record + BondRecord<Dim>::F)),
          K(numbers_at<SymTensor<Dim>>(record + BondRecord<Dim>::K)) {}
    Mat<Dim> F;
    SymTensor<Dim> K;  ///< N^-1
    double misfit = 0.0;
};

template <int Dim>
struct MaterialVectors<Dim>::Parts {
    using Record = BondRecord<Dim>;

    BondSweeps<Dim> sweeps;
    BondTable<Dim> table;
    double N0 = 0.0;  ///< tr N/D of a whole particle
    std::vector<double> volume{}, heat{};
    double stiffness = 0.0;       ///< c_k/V_k = kappa eta/N0 of the stiffest law
    std::vector<double> share{};  ///< of that stiffness, by particle
    double least_share = 1.0;
    std::vector<std::uint32_t> numbers{};
    double misfit_limit = HUGE_VAL;  ///< |e|/|F X| of the law that yields first
    bool brittle = false;
    BondBreaks breaks{};
    std::size_t told = 0;  ///< pairs, by the latest remark
    /// Pairs of numbers k < j that have broken and have not been apart since, ascending; with one of ours at least.
    std::vector<std::array<std::uint32_t, 2>> excluded{};
    std::vector<unsigned char> breaking{};  ///< by particle
    std::vector<SymTensor<Dim>> tau{};      ///< likewise, and by partner elsewhere
    std::size_t watched = 0;                ///< states that watch() was shown
    bool warned = false;

    double penalty(std::size_t k) const { return stiffness * share[k]; }
    /// Sum of body(records, first, last) over blocks of groups, whose records are fitted in lanes.
    template <class Body>
    std::size_t count_blocks(const BondView<Dim>& shown, const Body& body) const {
        const std::size_t each = table.block / static_cast<std::size_t>(sweeps.lanes);
        return parallel_count(
            table.blocks(),
            [&](std::size_t b) {
                std::array<double, BondTable<Dim>::block * Record::numbers> records;
                const std::size_t first = b * each, last = std::min(table.groups(), first + each);
                sweeps.gradients(shown, records.data(), first, last);
                return body(records.data(), first, last);
            },
            table.block);
    }
    /// body(k, record) for the particles of the groups [first, last).
    template <class Body>
    void each_record(const double* records, std::size_t first, std::size_t last,
                     const Body& body) const {
        const auto lanes = static_cast<std::size_t>(sweeps.lanes);
        for (std::size_t k = first * lanes; k < std::min(last * lanes, table.particles()); ++k)
            body(k, records + (k - first * lanes) * Record::numbers);
    }
    /// Sum of body(k, F, beyond) over all particles, beyond: whether a bond of k exceeds one of these limits
    /// (BondUpdates::beyond). body may change the bonds of k.
    template <class Body>
    std::size_t count_particles(const double* x, double misfit2, double stretch2,
                                const Body& body) {
        table.load(x);
        const BondView<Dim> shown = view();
        return count_blocks(shown, [&](const double* records, std::size_t first, std::size_t last) {
            const auto lanes = static_cast<std::size_t>(sweeps.lanes);
            std::array<unsigned char, BondTable<Dim>::block> found{};
            if (std::min(misfit2, stretch2) < HUGE_VAL)
                table.loops().beyond(shown, records, misfit2, stretch2, found.data(), first, last);
            std::size_t sum = 0;
            each_record(records, first, last, [&](std::size_t k, const double* record) {
                const std::size_t at = k - first * lanes;
                sum += body(k, Fit(record).F, (found[at / lanes] >> at % lanes & 1U) != 0);
            });
            return sum;
        });
    }
    /// body(k, fit) for all particles, in any order.
    template <class Body>
    void each_fit(const double* x, const Body& body) {
        const std::vector<double> placed = table.positions(x);
        BondView<Dim> shown = view();
        shown.x = placed.data();
        count_blocks(shown, [&](double* records, std::size_t first, std::size_t last) {
            table.loops().misfits(shown, records, first, last);
            each_record(records, first, last, [&](std::size_t k, const double* record) {
                Fit fit(record);
                fit.misfit = record[Record::c];
                body(k, fit);
            });
            return std::size_t{0};
        });
    }
    /// The numbers of what stands at these places.
    std::array<std::uint32_t, 2> pair_of(std::uint32_t k, std::uint32_t j) const {
        const std::uint32_t a = table.others().number(k), b = table.others().number(j);
        return {std::min(a, b), std::max(a, b)};
    }
    /// Those of all parts of the run, ascending.
    void add_other_pairs(std::vector<std::array<std::uint32_t, 2>>& pairs) const;
    /// Forgets pairs of others.
    void keep_own(std::vector<std::array<std::uint32_t, 2>>& pairs) const;
    bool is_own(std::uint32_t place) const { return place < numbers.size(); }
    bool excludes(std::uint32_t k, std::uint32_t j) const {
        return std::binary_search(excluded.begin(), excluded.end(), pair_of(k, j));
    }
    /// No weight for the bonds of the pair with these numbers.
    void part(const std::array<std::uint32_t, 2>& pair) {
        const std::uint32_t a = table.others().place(pair[0]), b = table.others().place(pair[1]);
        for (const auto& [k, j] : {std::pair(a, b), {b, a}}) {
            if (!is_own(k)) continue;
            const std::size_t m = table.place_of(k, j);
            table.set_bond(k, m, table.X(k, m), 0.0);
        }
    }

    BondView<Dim> view() { return table.view(N0); }
    /// find(first, last) for blocks of groups, then give(first, last), as BondSchedule says. The view must be taken
    /// after schedule().
    template <class Find, class Give>
    void for_blocks(const BondSchedule& schedule, const Find& find, const Give& give) {
        const std::size_t groups = table.groups();
        const auto of_block = [&](const auto& body, std::size_t b) {
            const std::size_t each = table.block / static_cast<std::size_t>(sweeps.lanes);
            body(b * each, std::min(groups, (b + 1) * each));
        };
        parallel_for(
            schedule.threads(),
            [&](std::size_t thread) {
                for (std::size_t b = schedule.begin(thread); b < schedule.end(thread); ++b) {
                    of_block(find, b);
                    for (const std::uint32_t given : schedule.after(b)) of_block(give, given);
                }
            },
            (table.particles() + schedule.threads() - 1) / schedule.threads());
        table.pass_on();
        const auto last = schedule.last();
        parallel_for(
            last.size(), [&](std::size_t n) { of_block(give, last[n]); }, table.block);
    }
    const BondSchedule& schedule() {
        return table.schedule(static_cast<std::size_t>(set_threads(0)));
    }
};

}  // namespace spam
