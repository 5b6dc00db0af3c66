// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_particles.hpp"
#include <spam/core/error.hpp>
#include <spam/setup/drawn.hpp>
#include <spam/study/lowest_modes.hpp>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace spam {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Golub, Underwood, The block Lanczos method for computing eigenvalues (1977), with all vectors kept orthogonal.
class BlockLanczos {
  public:
    /// `A`: symmetric, n x n, as a product.
    BlockLanczos(std::function<VectorXd(const VectorXd&)> A, Index n, Index block)
        : A_(std::move(A)),
          Q_(n, 0),
          AQ_(n, 0) {
        while (vectors_ < block) append(VectorXd::Zero(n));
    }
    Index known() const { return known_; }
    bool complete() const { return known() == Q_.rows(); }

    /// One block more: products with the vectors of the last, which make the next.
    void extend() {
        const Index first = known_;
        known_ = vectors_;
        AQ_.conservativeResize(Eigen::NoChange, Q_.cols());
        for (Index k = first; k < known_; ++k) AQ_.col(k) = A_(Q_.col(k));
        for (Index k = first; k < known_ && vectors_ < Q_.rows(); ++k) append(AQ_.col(k));
    }

    struct Pairs {
        VectorXd values;
        MatrixXd vectors;
        double largest = 0.0;  ///< |value| of all
        double residual = 0.0;
    };
    Pairs lowest(Index count) const {
        const auto Q = Q_.leftCols(known_), AQ = AQ_.leftCols(known_);
        MatrixXd T = Q.transpose() * AQ;
        T = (0.5 * (T + T.transpose())).eval();  // differences leave it symmetric to 1e-10
        const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(T);
        const MatrixXd s = solver.eigenvectors().leftCols(count);
        Pairs found{solver.eigenvalues().head(count), Q * s,
                    solver.eigenvalues().cwiseAbs().maxCoeff()};
        const MatrixXd off = AQ * s - found.vectors * found.values.asDiagonal();
        found.residual = off.colwise().norm().maxCoeff();
        return found;
    }

  private:
    /// What of v is new; something arbitrary where nothing is.
    void append(VectorXd v) {
        const double before = v.norm();
        for (bool drawn_anew = false;; drawn_anew = true) {
            for (int twice = 0; twice < 2; ++twice)
                v -= Q_.leftCols(vectors_) * (Q_.leftCols(vectors_).transpose() * v);
            if (v.norm() > (drawn_anew ? 1e-3 : 1e-8 * before)) break;
            for (double& number : v) number = drawn(random_) - 0.5;
            v.normalize();
        }
        if (vectors_ == Q_.cols())
            Q_.conservativeResize(Eigen::NoChange, std::min(Q_.rows(), 2 * vectors_ + 1));
        Q_.col(vectors_++) = v.normalized();
    }

    std::function<VectorXd(const VectorXd&)> A_;
    MatrixXd Q_, AQ_;  ///< vectors and products, with room for more
    Index vectors_ = 0, known_ = 0;
    std::mt19937_64 random_{11};
};

}  // namespace

template <int Dim>
LowestModes lowest_modes(Model<Dim>& model, std::span<const double> y,
                         const std::vector<bool>& held, std::size_t count, double t) {
    FreeParticles<Dim> free(model, y, held, t);
    free.require_potential("modes");
    if (count < 1 || count > free.size())
        throw InputError(
            fmt::format("modes: {} must be between 1 and {}, the numbers of free positions", count,
                        free.size()));
    const auto x = free.positions(), mass = free.masses();
    const auto n = static_cast<Index>(x.size()), modes = static_cast<Index>(count);
    const VectorXd by_root_mass =
        Eigen::Map<const VectorXd>(mass.data(), n).array().rsqrt().matrix();
    BlockLanczos lanczos(
        [&](const VectorXd& q) -> VectorXd {
            const VectorXd v = by_root_mass.cwiseProduct(q);
            VectorXd Kv(n);
            if (!free.derivative(x, {v.data(), x.size()}, {Kv.data(), x.size()}))
                throw GuardStop("modes: " + model.failure());
            return by_root_mass.cwiseProduct(Kv);
        },
        n, modes);
    BlockLanczos::Pairs found;
    for (Index look_at = 10 * modes;;) {
        lanczos.extend();
        if (lanczos.known() < look_at && !lanczos.complete()) continue;
        found = lanczos.lowest(modes);
        if (lanczos.complete() || found.residual < 1e-9 * found.largest) break;
        look_at = lanczos.known() + std::max(lanczos.known() / 4, modes);
    }
    LowestModes lowest;
    lowest.omega_squared.assign(found.values.begin(), found.values.end());
    lowest.shapes = MatrixXd::Zero(Dim * static_cast<Index>(held.size()), modes);
    free.each([&](std::size_t k, std::size_t at, std::size_t) {
        lowest.shapes.row(static_cast<Index>(at)) =
            by_root_mass[static_cast<Index>(k)] * found.vectors.row(static_cast<Index>(k));
    });
    lowest.largest_residual = found.residual;
    lowest.rhs_evaluations = free.rhs_evaluations();
    return lowest;
}

#define SPAM_INSTANTIATE(D)                                                  \
    template LowestModes lowest_modes<D>(Model<D>&, std::span<const double>, \
                                         const std::vector<bool>&, std::size_t, double);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam
