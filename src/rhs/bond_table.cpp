// SPDX-License-Identifier: GPL-3.0-or-later
#include "bond_table.hpp"

#include <spam/core/parallel.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/physics/material_vectors.hpp>

#include <algorithm>

namespace spam {

template <int Dim>
BondTable<Dim>::BondTable(double range, const Box<Dim>& box, int lanes,
                          std::vector<std::int32_t> bodies)
    : range_(range),
      box_(box),
      bodies_(std::move(bodies)),
      list_(range, skin * range, box.of_images(), 1),
      rows_{static_cast<std::size_t>(lanes)} {
    require_one_image(box, (1.0 + skin) * range);
}

template <int Dim>
Vec<Dim> BondTable<Dim>::Rows::X(std::size_t k, std::size_t m) const {
    Vec<Dim> X;
    for (int a = 0; a < Dim; ++a) X[a] = vectors[number(k, m, static_cast<std::size_t>(a))];
    return X;
}

template <int Dim>
void BondTable<Dim>::set_X(std::size_t k, std::size_t m, const Vec<Dim>& X) {
    for (int a = 0; a < Dim; ++a)
        rows_.vectors[rows_.number(k, m, static_cast<std::size_t>(a))] = X[a];
    rows_.vectors[rows_.number(k, m, Dim)] = material_weight(std::sqrt(dot(X, X)), range_);
}

template <int Dim>
Vec<Dim> BondTable<Dim>::separation(const double* x, std::size_t k, std::size_t j) const {
    Vec<Dim> r;
    for (int a = 0; a < Dim; ++a) {
        const auto c = static_cast<std::size_t>(a);
        r[a] =
            box_.periodic(a)
                ? box_.nearest_image(a, box_.wrap(a, x[Dim * j + c]) - box_.wrap(a, x[Dim * k + c]))
                : x[Dim * j + c] - x[Dim * k + c];
    }
    return r;
}

template <int Dim>
BondView<Dim> BondTable<Dim>::view() {
    BondView<Dim> view{};
    view.particles = particles();
    view.first = rows_.first.data();
    view.partner = rows_.partner.data();
    view.reverse = rows_.reverse.data();
    view.vectors = rows_.vectors.data();
    view.t = t_.data();
    view.inverse_range = 1.0 / range_;
    for (int a = 0; a < Dim; ++a) {
        view.length[a] = box_.length(a);
        view.inverse_length[a] = box_.periodic(a) ? 1.0 / box_.length(a) : 0.0;
    }
    return view;
}

/// Room for rows of these lengths; all bonds are those of particles with themselves.
template <int Dim>
void BondTable<Dim>::lay_out(std::vector<std::uint32_t> count) {
    const std::size_t lanes = rows_.lanes, n = count.size(), groups = (n + lanes - 1) / lanes;
    rows_.count = std::move(count);
    rows_.first.assign(groups + 1, 0);
    bonds_ = 0;
    for (std::size_t group = 0; group < groups; ++group) {
        std::size_t longest = 0;
        for (std::size_t k = group * lanes; k < std::min(n, (group + 1) * lanes); ++k) {
            longest = std::max(longest, row(k));
            bonds_ += row(k);
        }
        rows_.first[group + 1] = rows_.first[group] + longest * lanes;
    }
    const std::size_t slots = rows_.first.back();
    rows_.partner.resize(slots);
    rows_.reverse.resize(slots);
    t_.resize(slots * Dim);
    rows_.vectors.assign(slots * (Dim + 1), 0.0);
    parallel_for(
        groups,
        [&](std::size_t group) {
            for (std::size_t s = rows_.first[group]; s < rows_.first[group + 1]; ++s) {
                rows_.partner[s] = static_cast<std::uint32_t>(group * lanes + s % lanes);
                rows_.reverse[s] =
                    static_cast<std::uint32_t>(s / lanes * lanes + place_of_lane(s % lanes, lanes));
            }
        },
        lanes);
}

template <int Dim>
void BondTable<Dim>::find_reverse() {
    parallel_for(particles(), [&](std::size_t k) {
        for (std::size_t m = 0; m < row(k); ++m) {
            const std::size_t j = partner(k, m);
            std::size_t low = 0, high = row(j);
            while (low < high) {  // where k stands in the row of j
                const std::size_t middle = (low + high) / 2;
                if (partner(j, middle) < k)
                    low = middle + 1;
                else
                    high = middle;
            }
            const std::size_t back = rows_.slot(j, low), lanes = rows_.lanes;
            rows_.reverse[rows_.slot(k, m)] = static_cast<std::uint32_t>(
                back / lanes * lanes + place_of_lane(back % lanes, lanes));
        }
    });
}

template <int Dim>
void BondTable<Dim>::find_reach() {
    const std::size_t n = particles();
    reach_.resize((n + block - 1) / block);
    for (std::size_t b = 0; b < reach_.size(); ++b) {
        reach_[b] = {b, b};
        for (std::size_t k = b * block; k < std::min(n, (b + 1) * block); ++k)
            if (row(k) > 0) {
                reach_[b].first = std::min<std::size_t>(reach_[b].first, partner(k, 0) / block);
                reach_[b].last =
                    std::max<std::size_t>(reach_[b].last, partner(k, row(k) - 1) / block);
            }
    }
}

template <int Dim>
void BondTable<Dim>::update(const Eigen::Ref<const Points<Dim>>& x, const Anchor& anchor) {
    list_.build(x);
    built_at_.assign(x.data(), x.data() + x.size());
    const std::size_t n = list_.size();
    const double reach2 = (1.0 + skin) * (1.0 + skin) * range_ * range_;
    std::vector<std::size_t> cluster(n);  // of a particle
    for (std::size_t c = 0; c < n; ++c) cluster[list_.order()[c]] = c;
    const auto near = [&](std::size_t k, const auto& visit) {  // partners ascending
        for (const std::uint32_t entry : list_.entries(cluster[k])) {
            const std::uint32_t j = list_.particle(entry);
            if (j == k || bodies_[j] != bodies_[k]) continue;
            const Vec<Dim> r = separation(built_at_.data(), k, j);
            if (dot(r, r) < reach2) visit(j, r);
        }
    };
    std::vector<std::uint32_t> count(n);
    parallel_for(
        n, [&](std::size_t k) { near(k, [&](std::uint32_t, const Vec<Dim>&) { ++count[k]; }); });
    const Rows before = std::move(rows_);
    rows_ = {before.lanes};
    lay_out(std::move(count));
    parallel_for(n, [&](std::size_t k) {
        std::size_t m = 0, old = 0;
        const std::size_t row = before.count.empty() ? 0 : before.count[k];
        near(k, [&](std::uint32_t j, const Vec<Dim>& r) {
            while (old < row && before.partner[before.slot(k, old)] < j) ++old;
            const bool weighs = old < row && before.partner[before.slot(k, old)] == j &&
                                before.vectors[before.number(k, old, Dim)] > 0.0 &&
                                dot(r, r) < range_ * range_;
            rows_.partner[rows_.slot(k, m)] = j;
            set_X(k, m++, weighs ? before.X(k, old) : anchor(k, r));
        });
    });
    find_reverse();
    find_reach();
}

/// Rows without what fills groups, so that lanes do not matter.
template <int Dim>
void BondTable<Dim>::remember(Archive& archive) {
    std::vector<std::uint32_t> count = rows_.count, partners;
    std::vector<double> vectors;
    for (std::size_t k = 0; k < particles(); ++k)
        for (std::size_t m = 0; m < row(k); ++m) {
            partners.push_back(partner(k, m));
            const Vec<Dim> one = X(k, m);
            vectors.insert(vectors.end(), one.c.begin(), one.c.end());
        }
    archive(built_at_, count, partners, vectors);
    if (!archive.reading()) return;
    list_.build(Eigen::Map<const Points<Dim>>(built_at_.data(), Dim,
                                              static_cast<Eigen::Index>(built_at_.size() / Dim)));
    lay_out(std::move(count));
    std::size_t at = 0;
    for (std::size_t k = 0; k < particles(); ++k)
        for (std::size_t m = 0; m < row(k); ++m, ++at) {
            rows_.partner[rows_.slot(k, m)] = partners[at];
            Vec<Dim> one;
            std::copy_n(&vectors[at * Dim], Dim, one.c.begin());
            set_X(k, m, one);
        }
    find_reverse();
    find_reach();
}

template class BondTable<2>;
template class BondTable<3>;

}  // namespace spam
