// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {

template <int Dim>
PairList<Dim>::PairList(double range, double skin, const Box<Dim>& box)
    : range_(range),
      skin_(skin),
      box_(box) {
    for (int a = 0; a < Dim; ++a) {
        const double least = 2.0 * (range + skin);
        if (box.periodic(a) && box.length(a) <= least)
            throw InputError(fmt::format(
                "box: periodic length {} of direction {} must exceed 2 (range + skin) = {}; "
                "enlarge the box or shorten --range",
                box.length(a), "xyz"[a], least));
    }
}

template <int Dim>
template <class Visit>
void PairList<Dim>::for_each_within(std::size_t i, const Visit& visit) const {
    const double cutoff = range_ + skin_;
    const auto ci = static_cast<Eigen::Index>(i);
    grid_.for_each_near(i, [&](std::uint32_t j) {
        double r2 = 0.0;
        for (int a = 0; a < Dim; ++a) {
            const double s = box_.nearest_image(a, wrapped_(a, ci) - wrapped_(a, j));
            r2 += s * s;
        }
        if (r2 < cutoff * cutoff) visit(j);
    });
}

template <int Dim>
void PairList<Dim>::build(const Points<Dim>& position) {
    const auto n = static_cast<std::size_t>(position.cols());
    built_at_ = position;
    wrapped_ = position;
    for (int a = 0; a < Dim; ++a)
        if (box_.periodic(a))
            for (Eigen::Index i = 0; i < position.cols(); ++i)
                wrapped_(a, i) = box_.wrap(a, position(a, i));
    grid_.build(wrapped_, range_ + skin_, box_);

    // Counted first, then filled: no growing vectors, and any thread may take any particle.
    start_.assign(n + 1, 0);
    parallel_for(n, [&](std::size_t i) {
        std::size_t count = 0;
        for_each_within(i, [&](std::uint32_t) { ++count; });
        start_[i + 1] = count;
    });
    for (std::size_t i = 0; i < n; ++i) start_[i + 1] += start_[i];
    if (entries_.capacity() < start_[n]) entries_.reserve(start_[n] + start_[n] / 4);
    entries_.resize(start_[n]);
    parallel_for(n, [&](std::size_t i) {
        std::size_t k = start_[i];
        for_each_within(i, [&](std::uint32_t j) { entries_[k++] = j; });
        std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(start_[i]),
                  entries_.begin() + static_cast<std::ptrdiff_t>(start_[i + 1]));
    });
    ++builds_;
}

template <int Dim>
bool PairList<Dim>::update(const Points<Dim>& position) {
    if (built_at_.cols() == position.cols()) {
        const double limit = 0.25 * skin_ * skin_;
        bool moved = false;
        for (Eigen::Index i = 0; i < position.cols() && !moved; ++i)
            moved = !((position.col(i) - built_at_.col(i)).squaredNorm() <= limit);
        if (!moved) return false;
    }
    build(position);
    return true;
}

template class PairList<1>;
template class PairList<2>;
template class PairList<3>;

}  // namespace spam
