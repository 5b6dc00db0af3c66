// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/exact_sum.hpp>
#include <spam/core/rigid_motion.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <cmath>
#include <limits>

namespace spam {

template <int Dim>
double shape_error(const Points<Dim>& reference, const Points<Dim>& position, double spacing) {
    const RigidMotion<Dim> motion = best_rigid_motion<Dim>(reference, position);
    const double sum = exact_sum(static_cast<std::size_t>(reference.cols()), [&](std::size_t k) {
        const auto i = static_cast<Eigen::Index>(k);
        return (position.col(i) - motion(reference.col(i))).squaredNorm();
    });
    return std::sqrt(sum / static_cast<double>(reference.cols())) / spacing;
}

template <int Dim>
double closest_pair(const Points<Dim>& position, double reach, const Box<Dim>& box) {
    const auto n = static_cast<std::size_t>(position.cols());
    double extent = 2.0 * reach;
    for (int a = 0; a < Dim && n > 0; ++a)
        extent += position.row(a).maxCoeff() - position.row(a).minCoeff();
    double closest2 = std::numeric_limits<double>::infinity();
    // In a periodic box the list may reach no further than half of it.
    for (int a = 0; a < Dim; ++a)
        if (box.periodic(a)) extent = std::min(extent, 0.499 * box.length(a));
    const auto look_at = [&](std::size_t i, std::size_t j) {
        const Point<Dim> r = box.nearest(position.col(static_cast<Eigen::Index>(i)) -
                                         position.col(static_cast<Eigen::Index>(j)));
        closest2 = std::min(closest2, r.squaredNorm());
    };
    for (double look = std::min(reach, extent); n > 1; look = std::min(2.0 * look, extent)) {
        const PairList<Dim> list(position, look, box);
        for (std::size_t i = 0; i < n; ++i)
            for (const std::uint32_t j : list.neighbours(i))
                if (j > i) look_at(i, j);
        if (std::isfinite(closest2) || look >= extent) break;
    }
    if (!std::isfinite(closest2) &&
        position.allFinite())  // farther apart than a narrow box is wide
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j) look_at(i, j);
    return std::sqrt(closest2);
}

template <int Dim>
double clumped_fraction(const Points<Dim>& position, double distance, const Box<Dim>& box) {
    const PairList<Dim> list(position, distance, box);
    std::size_t clumped = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list.neighbours(i).size() > 1) ++clumped;  // than itself
    return static_cast<double>(clumped) / static_cast<double>(list.size());
}

Survival survival(const History& history) {
    const auto t = history.column("t"), error = history.column("shape_error"),
               pair = history.column("closest_pair");
    for (std::size_t k = 0; k < t.size(); ++k) {
        const bool deformed = !(error[k] < 0.5), clumped = !(pair[k] > 0.3);
        if (deformed || clumped)
            return {t[k], false,
                    deformed && clumped ? "clumped and deformed"
                    : deformed          ? "deformed"
                                        : "clumped"};
    }
    return {t.back(), true, "whole"};
}

#define SPAM_INSTANTIATE(D)                                                     \
    template double shape_error<D>(const Points<D>&, const Points<D>&, double); \
    template double closest_pair<D>(const Points<D>&, double, const Box<D>&);   \
    template double clumped_fraction<D>(const Points<D>&, double, const Box<D>&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
