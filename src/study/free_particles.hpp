// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace spam {

/// Forces on the particles that may move, as a function of where these are, and its derivative. Velocities are 0.
template <int Dim>
class FreeParticles {
  public:
    FreeParticles(Model<Dim>& model, std::span<const double> y, const std::vector<bool>& held,
                  double t);
    std::size_t size() const { return Dim * free_.size(); }
    std::size_t rhs_evaluations() const { return evaluations_; }
    const std::vector<double>& y() const { return y_; }

    std::vector<double> positions() const;
    std::vector<double> masses() const;  ///< of each number of a position
    /// Minus the forces. False where these have no meaning.
    bool residual(std::span<const double> x, std::span<double> F);
    /// K v, K = - d force/d x.
    bool derivative(std::span<const double> x, std::span<const double> v, std::span<double> Kv);
    /// Where in y's positions each number is.
    template <class Visit>
    void each(const Visit& visit) const {
        for (std::size_t k = 0; k < free_.size(); ++k)
            for (std::size_t a = 0; a < Dim; ++a) visit(Dim * k + a, Dim * free_[k] + a, free_[k]);
    }

    /// Throws InputError (`whose`) for forces that depend on velocities, where all particles are held, and where the
    /// derivative is not symmetric (tried with two vectors).
    void require_potential(std::string_view whose);

  private:
    void place(std::span<const double> x);

    Model<Dim>& model_;
    double t_;
    std::vector<double> y_, y_dot_, v_, Jv_;
    std::vector<std::size_t> free_;
    std::size_t evaluations_ = 0;
    std::size_t position_, velocity_;
};

SPAM_COMPILED(extern template class FreeParticles);

}  // namespace spam
