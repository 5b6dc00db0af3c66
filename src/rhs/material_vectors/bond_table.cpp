// SPDX-License-Identifier: GPL-3.0-or-later
#include "bond_table.hpp"

#include <spam/core/parallel.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/physics/material_vectors.hpp>
#include <spam/physics/record.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace spam {
namespace {

constexpr FieldKind listed_kind{"listed_at", Rank::vector, Role::derived, "l"};
constexpr FieldKind sought_kind{"sought_at", Rank::vector, Role::derived, "l"};
constexpr FieldKind moved_kind{"moved_since", Rank::scalar, Role::derived, "1"};
constexpr FieldKind bodies_kind{"body_of_vectors", Rank::scalar, Role::memory, "1", 100,
                                Quantity::scalar,  Share::equal};

// Of the range: how much farther than rows the list looks.
constexpr double list_skin = 0.25;

/// Of a position, a body and a number of a particle.
template <int Dim>
constexpr auto kinds_of_record = [] {
    std::array<NumberKind, Dim + 2> kinds{};
    std::copy_n(RecordOf<Dim, double, column::Position>::kinds.begin(), Dim, kinds.begin());
    return kinds;
}();

/// Whether a number is that of a partner of a particle, answered by a table of hashes.
class Partners {
  public:
    template <int Dim>
    void take(const BondRows<Dim>& rows, std::size_t k) {
        mask_ = std::bit_ceil(2 * rows.row(k) + 1) - 1;
        held_.assign(mask_ + 1, none);
        for (std::size_t m = 0; m < rows.row(k); ++m)
            if (!rows.vacant(k, m)) {
                const std::uint32_t j = rows.others().number(rows.partner(k, m));
                held_[place(j)] = j;
            }
    }
    bool contain(std::uint32_t j) const { return held_[place(j)] == j; }

  private:
    static constexpr std::uint32_t none = ~0U;
    std::size_t place(std::uint32_t j) const {
        std::size_t at = j & mask_;
        while (held_[at] != j && held_[at] != none) at = (at + 1) & mask_;
        return at;
    }

    std::size_t mask_ = 0;
    std::vector<std::uint32_t> held_;
};

}  // namespace

template <int Dim>
BondTable<Dim>::BondTable(double range, const Box<Dim>& box, int lanes,
                          const BondUpdates<Dim>& loops, const Points<Dim>& x,
                          std::vector<std::int32_t> bodies, const MaterialWeight& weight)
    : range_(range),
      weight_(weight),
      box_(box),
      loops_(loops),
      bodies_(std::move(bodies)),
      near_((1.0 + skin) * range, list_skin * range, box, lanes, Dim + 2, kinds_of_record<Dim>),
      rows_(static_cast<std::size_t>(x.cols()), static_cast<std::size_t>(lanes)) {
    require_one_image(box, (1.0 + skin) * range);
    const std::size_t filled = groups() * rows_.lanes();
    x_.assign(filled * Dim, 0.0);
    missing_.assign(filled * NeighbourSums::numbers, 0.0);
    anchoring_.assign(filled * Dim * Dim, 0.0);
    list_neighbours(x);
    renew(x, 0.0);
    admit();
    for (const Newcomer& bond : newcomers_) set_X(bond.k, bond.row, bond.r);
    newcomers_ = std::vector<Newcomer>();  // as many as there are bonds: their room is not kept
}

template <int Dim>
void BondTable<Dim>::set_X(std::size_t k, std::size_t m, const Vec<Dim>& X) {
    set_bond(k, m, X, weight_(std::sqrt(dot(X, X)), range_));
}

template <int Dim>
void BondTable<Dim>::set_bond(std::size_t k, std::size_t m, const Vec<Dim>& X, double g) {
    rows_.set(k, m, X, g);
}

template <int Dim>
Vec<Dim> BondTable<Dim>::separation(const double* x, std::size_t k, std::size_t j) const {
    const auto at = [x](std::size_t i) { return Eigen::Map<const Point<Dim>>(x + Dim * i); };
    return numbers_at<Vec<Dim>>(box_.separation(at(j), at(k)).data());
}

template <int Dim>
std::vector<double> BondTable<Dim>::positions(const double* x) const {
    std::vector<double> placed(others().places() * Dim, 0.0);
    place(x, placed.data());
    place_others(x, placed, nullptr);
    return placed;
}

template <int Dim>
void BondTable<Dim>::place(const double* x, double* to) const {
    const bool periodic = box_.periodic();
    parallel_for(particles(), [&, periodic](std::size_t i) {
        for (std::size_t a = 0; a < Dim; ++a)
            to[i * Dim + a] =
                periodic ? box_.wrap(static_cast<int>(a), x[i * Dim + a]) : x[i * Dim + a];
    });
}

template <int Dim>
BondView<Dim> BondTable<Dim>::view(double N0) {
    BondView<Dim> view{};
    rows_.show(view);
    view.little = FitSolver<Dim, double>::little(N0);
    view.x = x_.data();
    view.inverse_range = 1.0 / range_;
    for (int a = 0; a < Dim; ++a) {
        view.length[a] = box_.length(a);
        view.inverse_length[a] = box_.periodic(a) ? 1.0 / box_.length(a) : 0.0;
    }
    return view;
}

template <int Dim>
void BondTable<Dim>::list_neighbours(const Eigen::Ref<const Points<Dim>>& x) {
    near_.build(x);
    listed_.begin(x);
    slot_of_.resize(particles());
    for (std::size_t slot = 0; slot < particles(); ++slot)
        slot_of_[near_.list().order()[slot]] = static_cast<std::uint32_t>(slot);
}

/// NeighbourSums of those of its body that are nearer than range + skin, by particle.
template <int Dim>
void BondTable<Dim>::count_neighbours(const double* x) {
    const double reach = (1.0 + skin) * range_;
    near_.write(
        0, Dim + 2,
        [&](std::size_t i, double* record) {
            std::copy_n(x + i * Dim, Dim, record);
            record[Dim] = 2.0 * reach * bodies_[i];  // another body is far away
            record[Dim + 1] = others().number(i);
        },
        kinds_of_record<Dim>);
    const ClusterView view = near_.list().view();
    parallel_blocks(view.clusters, [&](std::size_t first, std::size_t count) {
        loops_.count(view, near_.records().numbers, reach * reach, missing_.data(), first,
                     first + count);
    });
}

template <int Dim>
template <class Partners>
void BondTable<Dim>::newcomers_of(std::size_t k, const double* x, Partners& partners,
                                  std::vector<Newcomer>& newcomers) const {
    const double reach2 = (1.0 + skin) * (1.0 + skin) * range_ * range_;
    const std::size_t cluster = slot_of_[k] / rows_.lanes(), before = newcomers.size();
    const double *const own = near_.record(slot_of_[k]), *const records = near_.records().numbers;
    partners.take(rows_, k);
    for (const std::uint32_t entry : near_.list().entries(cluster)) {
        double r2 = 0.0;
        for (std::size_t a = 0; a <= Dim; ++a) {
            const double r = records[entry + a] - own[a];
            r2 += r * r;
        }
        if (!(r2 < reach2)) continue;
        const auto j = static_cast<std::uint32_t>(records[entry + Dim + 1]);
        if (j == static_cast<std::uint32_t>(own[Dim + 1]) || partners.contain(j)) continue;
        newcomers.push_back({static_cast<std::uint32_t>(k), j, {}});
        if (others().none()) newcomers.back().r = separation(x, k, j);
    }
    const auto begin = newcomers.begin() + static_cast<std::ptrdiff_t>(before);
    std::sort(begin, newcomers.end(),
              [](const Newcomer& a, const Newcomer& b) { return a.j < b.j; });
    newcomers.erase(std::unique(begin, newcomers.end(),
                                [](const Newcomer& a, const Newcomer& b) { return a.j == b.j; }),
                    newcomers.end());
}

/// One or two follow from how many are missing, the sum of their numbers and that of the squares. False where these
/// say something else, and where places are no numbers.
template <int Dim>
bool BondTable<Dim>::newcomers_by_sums(std::size_t k, const double* x,
                                       std::vector<Newcomer>& newcomers) const {
    if (!others().none()) return false;
    using N = NeighbourSums;
    const double* const missing = &missing_[k * N::numbers];
    const double sum = missing[N::sum], squares = missing[N::squares];
    std::array<double, 2> numbers{sum, sum};
    std::size_t count = 1;
    if (missing[N::count] == 2.0) {
        const double apart = std::round(std::sqrt(std::max(0.0, 2.0 * squares - sum * sum)));
        numbers = {0.5 * (sum - apart), 0.5 * (sum + apart)};
        count = 2;
    } else if (missing[N::count] != 1.0) {
        return false;
    }
    const double own = count == 1 ? sum * sum : numbers[0] * numbers[0] + numbers[1] * numbers[1];
    if (own != squares || (count == 2 && !(numbers[0] < numbers[1]))) return false;
    const double reach2 = (1.0 + 1e-9) * (1.0 + skin) * (1.0 + skin) * range_ * range_;
    std::array<Newcomer, 2> found;
    for (std::size_t n = 0; n < count; ++n) {
        const double number = numbers[n];
        if (!(number >= 0.0 && number < static_cast<double>(particles())) ||
            number != std::floor(number))
            return false;
        const auto j = static_cast<std::uint32_t>(number);
        if (j == k || bodies_[j] != bodies_[k]) return false;
        found[n] = {static_cast<std::uint32_t>(k), j, separation(x, k, j)};
        if (!(dot(found[n].r, found[n].r) < reach2)) return false;
    }
    newcomers.insert(newcomers.end(), found.begin(), found.begin() + count);
    return true;
}

template <int Dim>
void BondTable<Dim>::idle_of(std::size_t k, const double* x, std::vector<Newcomer>& idle) const {
    for (std::size_t m = 0; m < row(k); ++m) {
        if (vacant(k, m) || g(k, m) > 0.0) continue;
        const Vec<Dim> r = separation(x, k, partner(k, m));
        if (dot(r, r) < range_ * range_)
            idle.push_back({static_cast<std::uint32_t>(k), partner(k, m), r, m});
    }
}

template <int Dim>
void BondTable<Dim>::renew(const Eigen::Ref<const Points<Dim>>& x, double N0) {
    if (!listed_.within(0.5 * near_.list().skin(), x, box_.of_images())) {
        list_neighbours(x);
        rows_.tidy();
    }
    motion_.begin(x);
    ++updates_;
    load(x.data());
    count_neighbours(x.data());
    const double reach = (1.0 + skin) * range_;
    std::vector<typename BondRenewal<Dim>::Lanes> found(groups());
    const BondRenewal<Dim> renewal{reach * reach,     N0,          weight_, missing_.data(),
                                   anchoring_.data(), found.data()};
    const BondView<Dim> view = this->view(N0);
    struct Found {
        std::vector<Newcomer> newcomers, idle;
    };
    std::vector<Found> of_block((particles() + block - 1) / block);
    rows_.discount(parallel_count(
        of_block.size(),
        [&](std::size_t b) {
            const std::size_t lanes = rows_.lanes(), first = b * block / lanes,
                              last = std::min(groups(), first + block / lanes);
            loops_.renew(view, renewal, first, last);
            Partners partners;
            double missing = 0.0;
            for (std::size_t k = first * lanes; k < last * lanes; ++k)
                missing += missing_[k * NeighbourSums::numbers + NeighbourSums::count];
            of_block[b].newcomers.reserve(static_cast<std::size_t>(std::max(missing, 0.0)));
            std::size_t gone = 0;
            for (std::size_t group = first; group < last; ++group) {
                gone += found[group].gone;
                for (std::size_t l = 0; l < lanes; ++l) {
                    const std::size_t k = group * lanes + l;
                    if ((found[group].fewer >> l & 1) != 0 &&
                        !newcomers_by_sums(k, x.data(), of_block[b].newcomers))
                        newcomers_of(k, x.data(), partners, of_block[b].newcomers);
                    if ((found[group].idle >> l & 1) != 0)
                        idle_of(k, places(x.data()), of_block[b].idle);
                }
            }
            return gone;
        },
        block));
    newcomers_.clear();
    idle_.clear();
    std::size_t count = 0;
    for (const Found& some : of_block) count += some.newcomers.size();
    newcomers_.reserve(count);
    for (Found& some : of_block) {
        newcomers_.insert(newcomers_.end(), some.newcomers.begin(), some.newcomers.end());
        idle_.insert(idle_.end(), some.idle.begin(), some.idle.end());
        some = {};
    }
    meet_others(x.data());
}

template <int Dim>
Mat<Dim> BondTable<Dim>::anchoring(std::size_t k) const {
    return numbers_at<Mat<Dim>>(&anchoring_[k * Dim * Dim]);
}

template <int Dim>
void BondTable<Dim>::remember(Memory<Dim>& memory) {
    const auto flat = [](const Points<Dim>& x) {
        return std::vector<double>(x.data(), x.data() + x.size());
    };
    const auto points = [](const std::vector<double>& x) {
        return Eigen::Map<const Points<Dim>>(x.data(), Dim,
                                             static_cast<Eigen::Index>(x.size() / Dim));
    };
    std::vector<double> listed_at = flat(listed_.then()), sought_at = flat(motion_.then());
    memory.particles(listed_kind, listed_at);
    memory.particles(sought_kind, sought_at);
    memory.particles(bodies_kind, bodies_);
    RigidMotion<Dim> listed = listed_.motion(), sought = motion_.motion();
    memory.run(moved_kind, listed, sought);
    rows_.remember(memory);
    if (!memory.reading() || memory.carries()) return;
    list_neighbours(points(listed_at));
    listed_.begin(points(listed_at), listed);
    motion_.begin(points(sought_at), sought);
}

template class BondTable<2>;
template class BondTable<3>;

}  // namespace spam
