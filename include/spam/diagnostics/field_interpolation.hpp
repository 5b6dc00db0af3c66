// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/any_weight.hpp>
#include <spam/neighbors/box.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace spam {

/// Fields between the particles, at any places r, [HH01] eqs 4, 5, 9 and 16:
///     rho(r)    = sum_j m_j w(|r - r_j|)
///     f(r)      = sum_j m_j f_j w(|r - r_j|) / rho(r)
///     grad rho  = sum_j m_j grad w,   grad f = sum_j m_j (f_j - f(r)) grad w / rho(r)
/// The gradients are those of the interpolated fields themselves. f(r_i) is not f_i: it is smoother.
/// Where no particle is within the range, rho and its gradient are 0, and f and its gradient NaN.
template <int Dim>
class FieldInterpolation {
  public:
    using Places = Eigen::Ref<const Points<Dim>>;
    using Field = Eigen::Ref<const Eigen::MatrixXd>;

    /// Particles of `mass` (N) at `position` (Dim x N, finite, not necessarily wrapped), as they are now.
    /// Throws InputError when a periodic length is not above twice the range.
    FieldInterpolation(const AnyWeight<Dim>& weight, std::vector<double> mass,
                       const Points<Dim>& position, const Box<Dim>& box);

    /// 1 x M at the places `at`, Dim x M.
    Eigen::RowVectorXd density(const Places& at) const;
    /// Dim x M
    Points<Dim> density_gradient(const Places& at) const;
    /// `f`: C x N, the particles' values of C components. C x M: sum_j m_j f_j w, that is rho f, and 0
    /// where nothing is near.
    Eigen::MatrixXd sum(const Field& f, const Places& at) const;
    /// Likewise, f.
    Eigen::MatrixXd value(const Field& f, const Places& at) const;
    /// (C Dim) x M, row a + Dim c: d f_c / d x_a. Of velocities: (grad v)_ac column by column.
    Eigen::MatrixXd gradient(const Field& f, const Places& at) const;

  private:
    void lay_cells();
    void sort_into_cells();
    std::pair<std::int64_t, std::int64_t> cells_near(int a, double x) const;
    template <class Visit>
    void each_near(const Point<Dim>& place, const Visit& visit) const;
    template <class Rows>
    void add_up(const Field& f, const Places& at, const Rows& rows, Eigen::MatrixXd& result) const;

    AnyWeight<Dim> weight_;
    std::vector<double> mass_;
    Points<Dim> position_;
    Box<Dim> box_;
    // Cells of about the range: what is in cell c is particle_[start_[c]] ... particle_[start_[c+1] - 1].
    Point<Dim> corner_, inverse_side_;
    std::array<std::int64_t, Dim> cells_;
    std::vector<std::size_t> start_;
    std::vector<Eigen::Index> particle_;
    Points<Dim> sorted_;  ///< positions in the order of particle_
};

SPAM_COMPILED(extern template class FieldInterpolation);

}  // namespace spam
