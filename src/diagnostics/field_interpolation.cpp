// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/diagnostics/field_interpolation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace spam {

template <int Dim>
FieldInterpolation<Dim>::FieldInterpolation(const AnyWeight<Dim>& weight, std::vector<double> mass,
                                            const Points<Dim>& position, const Box<Dim>& box)
    : weight_(weight),
      mass_(std::move(mass)),
      position_(box.wrapped(position)),
      box_(box) {
    const double h = weight_.range();
    for (int a = 0; a < Dim; ++a)
        if (box.periodic(a) && !(box.length(a) > 2.0 * h))
            throw InputError(fmt::format(
                "box: a periodic length of {:g} is not above twice the range {:g}; use a "
                "larger box or a shorter range",
                box.length(a), h));
    lay_cells();
    sort_into_cells();
}

template <int Dim>
void FieldInterpolation<Dim>::lay_cells() {
    // No more cells than particles, about: far outliers must not cost memory.
    const double most = std::pow(static_cast<double>(position_.cols()), 1.0 / Dim) + 1.0;
    for (int a = 0; a < Dim; ++a) {
        const bool free = !box_.periodic(a), any = position_.cols() > 0;
        const double low = free && any ? position_.row(a).minCoeff() : 0.0;
        const double high = free && any ? position_.row(a).maxCoeff() : box_.length(a);
        const double n =
            std::clamp(std::floor((high - low) / weight_.range()), 1.0, std::floor(most));
        cells_[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(n);
        corner_(a) = low;
        inverse_side_(a) = high > low ? n / (high - low) : 0.0;
    }
}

template <int Dim>
void FieldInterpolation<Dim>::sort_into_cells() {
    std::int64_t count = 1;
    for (const auto n : cells_) count *= n;
    std::vector<std::size_t> cell(static_cast<std::size_t>(position_.cols()));
    start_.assign(static_cast<std::size_t>(count) + 1, 0);
    for (std::size_t j = 0; j < cell.size(); ++j) {
        std::int64_t c = 0;
        for (int a = Dim - 1; a >= 0; --a) {
            const auto n = cells_[static_cast<std::size_t>(a)];
            const double x = position_(a, static_cast<Eigen::Index>(j));
            const auto k = static_cast<std::int64_t>((x - corner_(a)) * inverse_side_(a));
            c = c * n + std::clamp<std::int64_t>(k, 0, n - 1);
        }
        cell[j] = static_cast<std::size_t>(c);
        ++start_[cell[j] + 1];
    }
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    particle_.resize(cell.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t j = 0; j < cell.size(); ++j)
        particle_[next[cell[j]]++] = static_cast<Eigen::Index>(j);
    sorted_.resize(Dim, position_.cols());
    for (Eigen::Index e = 0; e < sorted_.cols(); ++e)
        sorted_.col(e) = position_.col(particle_[static_cast<std::size_t>(e)]);
}

/// The cells that the range about x reaches along axis a: the first, unwrapped, and how many.
template <int Dim>
std::pair<std::int64_t, std::int64_t> FieldInterpolation<Dim>::cells_near(int a, double x) const {
    const auto n = cells_[static_cast<std::size_t>(a)];
    const auto cell = [&](double at) {  // clamped first: numbers far outside are no whole numbers
        const double c = std::floor((at - corner_(a)) * inverse_side_(a));
        return static_cast<std::int64_t>(std::clamp(c, -2.0 * double(n), 3.0 * double(n)));
    };
    std::int64_t low = cell(x - weight_.range()), high = cell(x + weight_.range());
    if (box_.periodic(a)) {
        high = std::min(high, low + n - 1);
    } else {
        low = std::clamp<std::int64_t>(low, 0, n - 1);
        high = std::clamp<std::int64_t>(high, 0, n - 1);
    }
    return {low, high - low + 1};
}

/// visit(j, r - r_j, distance) for all particles within the range.
template <int Dim>
template <class Visit>
void FieldInterpolation<Dim>::each_near(const Point<Dim>& place, const Visit& visit) const {
    std::array<std::int64_t, Dim> first, number;
    Point<Dim> at;
    for (int a = 0; a < Dim; ++a) {
        const auto k = static_cast<std::size_t>(a);
        at(a) = box_.wrap(a, place(a));
        std::tie(first[k], number[k]) = cells_near(a, at(a));
    }
    std::int64_t all = 1;
    for (const auto n : number) all *= n;
    const double range2 = weight_.range() * weight_.range();
    for (std::int64_t c = 0; c < all; ++c) {
        std::int64_t rest = c, cell = 0, stride = 1;
        Point<Dim> here = at;  // as seen from the particles' images in this cell
        bool nearest = true;
        for (std::size_t a = 0; a < Dim; ++a) {
            const std::int64_t n = cells_[a], k = first[a] + rest % number[a];
            const std::int64_t inside = (k % n + n) % n;
            rest /= number[a];
            cell += inside * stride;
            stride *= n;
            const auto axis = static_cast<int>(a);
            here(axis) -= static_cast<double>((k - inside) / n) * box_.length(axis);
            nearest = nearest && (n >= 3 || !box_.periodic(axis));  // else a cell holds two images
        }
        for (std::size_t e = start_[static_cast<std::size_t>(cell)];
             e < start_[static_cast<std::size_t>(cell) + 1]; ++e) {
            Point<Dim> s = here - sorted_.col(static_cast<Eigen::Index>(e));
            if (!nearest) s = box_.nearest(s);
            const double r2 = s.squaredNorm();
            if (r2 < range2) visit(particle_[e], s, std::sqrt(r2));
        }
    }
}

template <int Dim>
Eigen::RowVectorXd FieldInterpolation<Dim>::density(const Places& at) const {
    Eigen::RowVectorXd rho(at.cols());
    parallel_for(static_cast<std::size_t>(at.cols()), [&](std::size_t k) {
        const auto p = static_cast<Eigen::Index>(k);
        double sum = 0.0;
        each_near(at.col(p), [&](Eigen::Index j, const Point<Dim>&, double r) {
            sum += mass_[static_cast<std::size_t>(j)] * weight_.value(r);
        });
        rho(p) = sum;
    });
    return rho;
}

template <int Dim>
Points<Dim> FieldInterpolation<Dim>::density_gradient(const Places& at) const {
    Points<Dim> gradient(Dim, at.cols());
    parallel_for(static_cast<std::size_t>(at.cols()), [&](std::size_t k) {
        const auto p = static_cast<Eigen::Index>(k);
        Point<Dim> sum = Point<Dim>::Zero();
        each_near(at.col(p), [&](Eigen::Index j, const Point<Dim>& s, double r) {
            sum -= (mass_[static_cast<std::size_t>(j)] * weight_.minus_slope_over_r(r)) * s;
        });
        gradient.col(p) = sum;
    });
    return gradient;
}

/// `rows`: how many, as a number or, where that is quicker, as a constant of the compiler.
template <int Dim>
template <class Rows>
void FieldInterpolation<Dim>::add_up(const Field& f, const Places& at, const Rows& rows,
                                     Eigen::MatrixXd& result) const {
    parallel_for(static_cast<std::size_t>(at.cols()), [&](std::size_t k) {
        const auto p = static_cast<Eigen::Index>(k);
        double* const sum = result.col(p).data();
        std::fill_n(sum, Eigen::Index{rows}, 0.0);
        each_near(at.col(p), [&](Eigen::Index j, const Point<Dim>&, double r) {
            const double mw = mass_[static_cast<std::size_t>(j)] * weight_.value(r);
            const double* const of_j = f.col(j).data();
            for (Eigen::Index c = 0; c < rows; ++c) sum[c] += mw * of_j[c];
        });
    });
}

template <int Dim>
Eigen::MatrixXd FieldInterpolation<Dim>::sum(const Field& f, const Places& at) const {
    Eigen::MatrixXd result(f.rows(), at.cols());
    // What an entropy needs: 1, e, v, v^2.
    using Moments = std::integral_constant<Eigen::Index, Dim + 3>;
    if (f.rows() == Moments::value)
        add_up(f, at, Moments(), result);
    else
        add_up(f, at, f.rows(), result);
    return result;
}

template <int Dim>
Eigen::MatrixXd FieldInterpolation<Dim>::value(const Field& f, const Places& at) const {
    Eigen::MatrixXd result(f.rows(), at.cols());
    parallel_for(static_cast<std::size_t>(at.cols()), [&](std::size_t k) {
        const auto p = static_cast<Eigen::Index>(k);
        double rho = 0.0;
        result.col(p).setZero();
        each_near(at.col(p), [&](Eigen::Index j, const Point<Dim>&, double r) {
            const double mw = mass_[static_cast<std::size_t>(j)] * weight_.value(r);
            rho += mw;
            result.col(p) += mw * f.col(j);
        });
        result.col(p) /= rho;  // 0/0 where nothing is near
    });
    return result;
}

template <int Dim>
Eigen::MatrixXd FieldInterpolation<Dim>::gradient(const Field& f, const Places& at) const {
    const Eigen::MatrixXd here = value(f, at);
    Eigen::MatrixXd result(f.rows() * Dim, at.cols());
    parallel_for(static_cast<std::size_t>(at.cols()), [&](std::size_t k) {
        const auto p = static_cast<Eigen::Index>(k);
        double rho = 0.0;
        result.col(p).setZero();
        each_near(at.col(p), [&](Eigen::Index j, const Point<Dim>& s, double r) {
            const double m = mass_[static_cast<std::size_t>(j)];
            rho += m * weight_.value(r);
            const Point<Dim> grad_w = -weight_.minus_slope_over_r(r) * s;
            for (Eigen::Index c = 0; c < f.rows(); ++c)
                for (int a = 0; a < Dim; ++a)
                    result(a + Dim * c, p) += m * (f(c, j) - here(c, p)) * grad_w(a);
        });
        result.col(p) /= rho;
    });
    return result;
}

SPAM_COMPILED(template class FieldInterpolation);

}  // namespace spam
