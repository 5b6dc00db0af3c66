// SPDX-License-Identifier: GPL-3.0-or-later
#include "bond_rows.hpp"

#include <spam/core/parallel.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

namespace spam {
namespace {

constexpr FieldKind vector_kind{"material_vector", Rank::vector, Role::memory, "l", 100,
                                Quantity::position};
constexpr FieldKind weight_kind{"weight_of_vector", Rank::scalar, Role::memory, "1"};

/// What grows by itself takes twice as much.
template <int Dim>
BondNumbers room_for(std::size_t particles, std::size_t bonds) {
    BondNumbers room{std::vector<std::uint32_t>(particles, 0), {}, {}};
    room.partners.reserve(bonds);
    room.numbers.reserve(bonds * (Dim + 1));
    return room;
}

}  // namespace

template <int Dim>
BondRows<Dim>::BondRows(std::size_t particles, std::size_t lanes)
    : lanes_(lanes),
      others_(particles, (particles + lanes - 1) / lanes * lanes),
      count_(particles, 0),
      first_((particles + lanes - 1) / lanes + 1, 0),
      shift_((particles + block - 1) / block, 0) {}

template <int Dim>
Vec<Dim> BondRows<Dim>::X(std::size_t k, std::size_t m) const {
    Vec<Dim> X;
    for (int a = 0; a < Dim; ++a) X[a] = vectors_[number(k, m, static_cast<std::size_t>(a))];
    return X;
}

template <int Dim>
void BondRows<Dim>::set(std::size_t k, std::size_t m, const Vec<Dim>& X, double g) {
    for (int a = 0; a < Dim; ++a) vectors_[number(k, m, static_cast<std::size_t>(a))] = X[a];
    vectors_[number(k, m, Dim)] = g;
}

template <int Dim>
void BondRows<Dim>::vacate(std::size_t begin, std::size_t end, std::size_t group) {
    for (std::size_t s = begin; s < end; ++s) {
        partner_[s] = static_cast<std::uint32_t>(group * lanes_ + s % lanes_);
        reverse_[s] =
            static_cast<std::uint32_t>(s / lanes_ * lanes_ + place_of_lane(s % lanes_, lanes_)) +
            shift_[group * lanes_ / block];
    }
    std::fill(vectors_.begin() + static_cast<std::ptrdiff_t>(begin * (Dim + 1)),
              vectors_.begin() + static_cast<std::ptrdiff_t>(end * (Dim + 1)), 0.0);
}

/// Room for rows of groups with these lengths, none shorter than before; what is in rows stays.
template <int Dim>
void BondRows<Dim>::lay_out(const std::vector<std::uint32_t>& capacity) {
    std::vector<std::size_t> first(groups() + 1, 0);
    for (std::size_t group = 0; group < groups(); ++group)
        first[group + 1] = first[group] + capacity[group] * lanes_;
    const std::vector<std::size_t> first_before = std::exchange(first_, std::move(first));
    const auto partner = std::exchange(partner_, std::vector<std::uint32_t>(first_.back())),
               reverse = std::exchange(reverse_, std::vector<std::uint32_t>(first_.back()));
    const auto vectors =
        std::exchange(vectors_, std::vector<double>(first_.back() * (Dim + 1), 0.0));
    const auto shift_before = std::exchange(shift_, std::vector<std::uint32_t>(shift_.size(), 0));
    scheduled_ = false;
    parallel_for(
        groups(),
        [&](std::size_t group) {
            const std::size_t from = first_before[group], to = first_[group],
                              held = first_before[group + 1] - from;
            for (std::size_t s = 0; s < held; ++s) {
                const std::uint32_t j = partner[from + s];
                partner_[to + s] = j;
                if (others_.elsewhere(j)) continue;
                reverse_[to + s] =
                    static_cast<std::uint32_t>(reverse[from + s] - shift_before[j / block] -
                                               first_before[j / lanes_] + first_[j / lanes_]);
            }
            std::copy_n(vectors.data() + from * (Dim + 1), held * (Dim + 1),
                        vectors_.data() + to * (Dim + 1));
            vacate(to + held, first_[group + 1], group);
        },
        lanes_);
}

/// Finds places in rows, and makes those longer that do not suffice.
template <int Dim>
void BondRows<Dim>::make_room(std::vector<Newcomer>& newcomers) {
    if (newcomers.empty()) return;
    // What once was full is given more than it needs, but for the first rows of all: those of a solid that does
    // not flow stay as they are.
    const std::uint32_t spare = first_.back() == 0 ? 0 : 4;
    std::vector<std::uint32_t> capacity(groups());
    bool grows = false;
    for (std::size_t group = 0; group < groups(); ++group)
        capacity[group] = static_cast<std::uint32_t>((first_[group + 1] - first_[group]) / lanes_);
    for (std::size_t n = 0; n < newcomers.size();) {
        const std::size_t k = newcomers[n].k;
        std::size_t m = 0;
        for (; n < newcomers.size() && newcomers[n].k == k; ++n, ++m) {
            while (m < count_[k] && !vacant(k, m)) ++m;
            newcomers[n].row = m;
        }
        count_[k] = std::max(count_[k], static_cast<std::uint32_t>(m));
        if (count_[k] > capacity[k / lanes_]) {
            capacity[k / lanes_] = count_[k] + spare;
            grows = true;
        }
    }
    if (!grows) return;
    // Where one row has become too short others will: none that is all but full is left so.
    if (spare > 0) {
        std::vector<std::uint32_t> longest(groups(), 0);
        for (std::size_t k = 0; k < particles(); ++k)
            longest[k / lanes_] = std::max(longest[k / lanes_], count_[k]);
        for (std::size_t group = 0; group < groups(); ++group)
            if (longest[group] + 1 >= capacity[group]) capacity[group] = longest[group] + spare;
    }
    lay_out(capacity);
}

/// Bonds that are there in both directions: where rounding lets only one of two meet the other, they meet next time.
/// Partners in other parts have been found there as well (BondTable::meet_others).
template <int Dim>
class BondRows<Dim>::Meetings {
  public:
    Meetings(std::vector<Newcomer>& newcomers, std::size_t particles)
        : newcomers_(newcomers),
          first_(particles + 1, 0) {
        index();
        const auto met = [&](const Newcomer& bond) { return elsewhere(bond) || back(bond); };
        if (std::all_of(newcomers.begin(), newcomers.end(), met)) return;
        std::vector<Newcomer> both;
        std::copy_if(newcomers.begin(), newcomers.end(), std::back_inserter(both), met);
        newcomers = std::move(both);
        index();
    }
    /// The other direction.
    const Newcomer* back(const Newcomer& bond) const {
        for (std::size_t n = first_[bond.j]; n < first_[bond.j + 1]; ++n)
            if (newcomers_[n].j == bond.k) return &newcomers_[n];
        return nullptr;
    }

  private:
    bool elsewhere(const Newcomer& bond) const { return bond.j + 1 >= first_.size(); }
    void index() {
        std::fill(first_.begin(), first_.end(), 0);
        for (const Newcomer& bond : newcomers_) ++first_[bond.k + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
    }

    const std::vector<Newcomer>& newcomers_;
    std::vector<std::uint32_t> first_;  ///< by particle
};

template <int Dim>
void BondRows<Dim>::enter(std::vector<Newcomer>& newcomers) {
    const Meetings meetings(newcomers, particles());
    make_room(newcomers);
    parallel_for(newcomers.size(), [&](std::size_t n) {
        const Newcomer& bond = newcomers[n];
        partner_[slot(bond.k, bond.row)] = bond.j;
        if (others_.elsewhere(bond.j)) return;
        reverse_[slot(bond.k, bond.row)] = place(bond.j, meetings.back(bond)->row);
    });
    bonds_ += newcomers.size();
    scheduled_ = scheduled_ && others_.none();
    for (const Newcomer& bond : newcomers) {
        if (!scheduled_) break;
        const BondSchedule::Reach& reach = reach_[bond.k / block];
        scheduled_ = reach.first <= bond.j / block && bond.j / block <= reach.last;
    }
}

template <int Dim>
void BondRows<Dim>::find_way_back(std::size_t k, std::size_t m) {
    const std::size_t j = partner(k, m);
    if (others_.elsewhere(j)) return;
    reverse_[slot(k, m)] = place(j, place_of(j, k));
}

/// One more bond in what the rows hold, one after the other.
template <int Dim>
void BondRows<Dim>::add(BondNumbers& contents, std::size_t k, std::size_t m) const {
    ++contents.count[k];
    contents.partners.push_back(partner(k, m));
    const Vec<Dim> X = this->X(k, m);
    contents.numbers.insert(contents.numbers.end(), X.c.begin(), X.c.end());
    contents.numbers.push_back(g(k, m));
}

template <int Dim>
void BondRows<Dim>::hold(const BondNumbers& contents) {
    count_ = contents.count;
    std::vector<std::uint32_t> capacity(groups(), 0);
    for (std::size_t k = 0; k < particles(); ++k)
        capacity[k / lanes_] = std::max(capacity[k / lanes_], count_[k]);
    std::fill(first_.begin(), first_.end(), 0);
    lay_out(capacity);
    bonds_ = 0;
    std::size_t at = 0;
    for (std::size_t k = 0; k < particles(); ++k)
        for (std::size_t m = 0; m < row(k); ++m, ++at) {
            partner_[slot(k, m)] = contents.partners[at];
            const double* const bond = &contents.numbers[at * (Dim + 1)];
            set(k, m, numbers_at<Vec<Dim>>(bond), bond[Dim]);
            if (!vacant(k, m)) ++bonds_;
        }
    parallel_for(particles(), [&](std::size_t k) {
        for (std::size_t m = 0; m < row(k); ++m)
            if (!vacant(k, m)) find_way_back(k, m);
    });
}

template <int Dim>
void BondRows<Dim>::tidy() {
    Parts& parts = Parts::here();
    if (5 * parts.total(places()) <= 6 * parts.total(bonds_)) return;
    BondNumbers contents = room_for<Dim>(particles(), bonds_);
    std::vector<std::uint32_t> order;
    for (std::size_t k = 0; k < particles(); ++k) {
        order.clear();
        for (std::uint32_t m = 0; m < row(k); ++m)
            if (!vacant(k, m)) order.push_back(m);
        const auto number = [&](std::uint32_t m) { return others_.number(partner(k, m)); };
        std::sort(order.begin(), order.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return number(a) < number(b); });
        for (const std::uint32_t m : order) add(contents, k, m);
    }
    hold(contents);
}

template <int Dim>
void BondRows<Dim>::find_reach() {
    const std::size_t n = particles();
    reach_.resize(shift_.size());
    parallel_for(
        reach_.size(),
        [&](std::size_t b) {
            reach_[b] = {b, b};
            for (std::size_t k = b * block; k < std::min(n, (b + 1) * block); ++k)
                for (std::size_t m = 0; m < row(k); ++m) {
                    if (others_.elsewhere(partner(k, m))) {
                        reach_[b].elsewhere = true;
                        continue;
                    }
                    reach_[b].first = std::min<std::size_t>(reach_[b].first, partner(k, m) / block);
                    reach_[b].last = std::max<std::size_t>(reach_[b].last, partner(k, m) / block);
                }
        },
        block);
}

template <int Dim>
const BondSchedule& BondRows<Dim>::schedule(std::size_t threads) {
    if (scheduled_ &&
        schedule_.threads() == std::max<std::size_t>(1, std::min(threads, shift_.size())))
        return schedule_;
    find_reach();
    schedule_ = BondSchedule(reach_, threads);
    scheduled_ = true;
    const auto begins = [&](std::size_t b) {  // slots of a block
        return first_[std::min(groups(), b * block / lanes_)];
    };
    std::size_t largest = 0;
    for (std::size_t b = 0; b < shift_.size(); ++b)
        largest = std::max(largest, begins(b + 1) - begins(b));
    t_.resize(schedule_.rooms() * largest * Dim);
    std::vector<std::uint32_t> change(shift_.size());
    for (std::size_t b = 0; b < shift_.size(); ++b) {
        const auto shift = static_cast<std::uint32_t>(schedule_.room(b) * largest - begins(b));
        change[b] = shift - std::exchange(shift_[b], shift);
    }
    parallel_for(
        groups(),
        [&](std::size_t group) {
            for (std::size_t s = first_[group]; s < first_[group + 1]; ++s)
                if (!others_.elsewhere(partner_[s])) reverse_[s] += change[partner_[s] / block];
        },
        lanes_);
    find_ways_across(schedule_.rooms() * largest);
    return schedule_;
}

template <int Dim>
void BondRows<Dim>::show(BondView<Dim>& view) {
    view.particles = particles();
    view.first = first_.data();
    view.partner = partner_.data();
    view.reverse = reverse_.data();
    view.vectors = vectors_.data();
    view.t = t_.data();
    view.shift = shift_.data();
    view.block = block / lanes_;
}

template <int Dim>
void BondRows<Dim>::remember(Memory<Dim>& memory) {
    BondNumbers contents = room_for<Dim>(particles(), memory.reading() ? 0 : places());
    if (!memory.reading())
        for (std::size_t k = 0; k < particles(); ++k)
            for (std::size_t m = 0; m < row(k); ++m) add(contents, k, m);
    for (std::uint32_t& j : contents.partners) j = others_.number(j);
    memory.bonds(std::array<Field, 2>{vector_kind, weight_kind}, contents);
    if (!memory.reading()) return;
    others_.set(contents.partners);
    for (std::uint32_t& j : contents.partners) j = others_.place(j);
    hold(contents);
}

template class BondRows<2>;
template class BondRows<3>;

}  // namespace spam
