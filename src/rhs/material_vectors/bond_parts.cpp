// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds with particles of other parts of a run (core/parts.hpp). Each end's row is where that particle lives, as it is
// in a run of one part. What one end finds of the bond travels as it is, 8 Dim bytes, and the particle at the other end
// adds it where its own row says: the same numbers in the same order.
#include "bond_table.hpp"
#include <spam/core/parallel.hpp>

#include <algorithm>
#include <array>

namespace spam {

template <int Dim>
std::vector<std::uint32_t> BondRows<Dim>::meet(std::vector<std::uint32_t> numbers) {
    if (others_.none()) return {};
    const auto each_elsewhere = [&](const auto& body) {
        for (std::uint32_t& j : partner_)
            if (others_.elsewhere(j)) body(j);
    };
    each_elsewhere([&](std::uint32_t j) { numbers.push_back(others_.number(j)); });
    const auto now = others_.set(std::move(numbers));
    each_elsewhere([&](std::uint32_t& j) { j = now[j - groups() * lanes_]; });
    scheduled_ = false;
    return now;
}

/// Where the first of the two lives. Called once a step.
template <int Dim>
std::size_t BondRows<Dim>::pairs() const {
    if (others_.none()) return bonds_ / 2;
    return parallel_count(particles(), [&](std::size_t k) {
        std::size_t first = 0;
        for (std::size_t m = 0; m < row(k); ++m)
            first += others_.number(k) < others_.number(partner(k, m)) ? 1 : 0;
        return first;
    });
}

/// Both parts find the order in which bonds travel by themselves: by the number of one end, then of the other.
template <int Dim>
void BondRows<Dim>::find_ways_across(std::size_t base) {
    if (others_.none()) return;
    using Way =
        std::array<std::uint32_t, 4>;  // part, number of one end, of the other one, place or slot
    std::vector<Way> out, in;
    for (std::size_t k = 0; k < particles(); ++k)
        for (std::size_t m = 0; m < row(k); ++m) {
            if (!others_.elsewhere(partner(k, m))) continue;
            const std::uint32_t own = others_.number(k), other = others_.number(partner(k, m)),
                                part = others_.home(other);
            out.push_back({part, own, other, place(k, m)});
            in.push_back({part, other, own, static_cast<std::uint32_t>(slot(k, m))});
        }
    std::ranges::sort(out);
    std::ranges::sort(in);
    given_.assign(Parts::here().count(), {});
    taken_ = given_;
    for (const Way& way : out) given_[way[0]].push_back(way[3]);
    for (const Way& way : in) {
        reverse_[way[3]] = static_cast<std::uint32_t>(base);
        taken_[way[0]].push_back(static_cast<std::uint32_t>(base++));
    }
    t_.resize(base * Dim);
}

template <int Dim>
void BondRows<Dim>::pass_on() {
    if (others_.none()) return;
    using Addend = std::array<double, Dim>;
    OtherPartners::exchange<Addend>(
        given_, taken_,
        [&](std::size_t at) {
            Addend found;
            std::copy_n(&t_[at * Dim], Dim, found.begin());
            return found;
        },
        [&](std::size_t at, const Addend& found) {
            std::copy_n(found.begin(), Dim, &t_[at * Dim]);
        });
}

/// Positions of partners elsewhere: as they are, behind our own, and as the loops want them.
template <int Dim>
void BondTable<Dim>::load_others(const double* x) {
    if (others().none()) return;
    x_.resize(others().places() * Dim);
    at_.resize(others().places() * Dim);
    std::copy_n(x, particles() * Dim, at_.begin());
    place_others(x, x_, at_.data());
}

template <int Dim>
void BondTable<Dim>::place_others(const double* x, std::vector<double>& placed, double* at) const {
    others().template fetch<Vec<Dim>>(
        [&](std::size_t i) { return numbers_at<Vec<Dim>>(x + i * Dim); },
        [&](std::size_t j, const Vec<Dim>& theirs) {
            for (std::size_t a = 0; a < Dim; ++a) {
                if (at != nullptr) at[j * Dim + a] = theirs.c[a];
                placed[j * Dim + a] =
                    box_.periodic() ? box_.wrap(static_cast<int>(a), theirs.c[a]) : theirs.c[a];
            }
        });
}

/// Newcomers have been found by number. Those of two parts are told to each other: they enter where both found them.
template <int Dim>
void BondTable<Dim>::meet_others(const double* x) {
    const OtherPartners& all = others();
    if (all.none()) return;
    Parts& parts = Parts::here();
    using Pair = std::array<std::uint32_t, 2>;
    std::vector<std::vector<Pair>> found(parts.count());
    for (const Newcomer& bond : newcomers_)
        found[all.home(bond.j)].push_back({bond.j, all.number(bond.k)});
    found[parts.own()].clear();
    std::vector<Parts::Bytes> messages;
    for (const auto& of_part : found)
        messages.push_back(Parts::bytes_of(std::span<const Pair>(of_part)));
    std::vector<Pair> met;  // ours, theirs
    for (const Parts::Bytes& message : parts.exchange(std::move(messages)))
        for (const Pair& pair : Parts::values_of<Pair>(message)) met.push_back(pair);
    std::ranges::sort(met);
    std::erase_if(newcomers_, [&](const Newcomer& bond) {
        return all.home(bond.j) != parts.own() &&
               !std::ranges::binary_search(met, Pair{all.number(bond.k), bond.j});
    });

    std::vector<std::uint32_t> numbers;
    for (const Newcomer& bond : newcomers_) numbers.push_back(bond.j);
    for (Newcomer& bond : idle_) bond.j = all.number(bond.j);
    rows_.meet(std::move(numbers));
    for (auto* bonds : {&newcomers_, &idle_})
        for (Newcomer& bond : *bonds) bond.j = all.place(bond.j);
    load_others(x);
    for (Newcomer& bond : newcomers_) bond.r = separation(places(x), bond.k, bond.j);
}

#define SPAM_INSTANTIATE(D)                                                                       \
    template std::vector<std::uint32_t> BondRows<D>::meet(std::vector<std::uint32_t>);            \
    template std::size_t BondRows<D>::pairs() const;                                              \
    template void BondRows<D>::find_ways_across(std::size_t);                                     \
    template void BondRows<D>::pass_on();                                                         \
    template void BondTable<D>::load_others(const double*);                                       \
    template void BondTable<D>::place_others(const double*, std::vector<double>&, double*) const; \
    template void BondTable<D>::meet_others(const double*);
SPAM_INSTANTIATE(2)
SPAM_INSTANTIATE(3)

}  // namespace spam
