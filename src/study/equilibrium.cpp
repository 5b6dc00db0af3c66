// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/integrate/root.hpp>
#include <spam/study/equilibrium.hpp>

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

/// Forces on the particles that may move, as a function of where these are, and its derivative.
template <int Dim>
class FreeParticles {
  public:
    FreeParticles(Model<Dim>& model, std::span<const double> y, const std::vector<bool>& held,
                  double t)
        : model_(model),
          t_(t),
          y_(y.begin(), y.end()),
          y_dot_(y.size()),
          v_(y.size()),
          Jv_(y.size()) {
        for (std::size_t i = 0; i < held.size(); ++i)
            if (!held[i]) free_.push_back(i);
        State<Dim>(model.layout(), y_).velocity().setZero();
    }
    std::size_t size() const { return Dim * free_.size(); }
    std::size_t rhs_evaluations() const { return evaluations_; }
    const std::vector<double>& y() const { return y_; }

    std::vector<double> positions() const {
        std::vector<double> x(size());
        each([&](std::size_t k, std::size_t at, std::size_t) { x[k] = y_[position_ + at]; });
        return x;
    }
    /// Minus the forces.
    bool residual(std::span<const double> x, std::span<double> F) {
        place(x);
        model_.rates(t_, y_, y_dot_);
        ++evaluations_;
        each([&](std::size_t k, std::size_t at, std::size_t i) {
            F[k] = -model_.particles().mass[i] * y_dot_[velocity_ + at];
        });
        return model_.failure().empty();
    }
    bool derivative(std::span<const double> x, std::span<const double> v, std::span<double> Jv) {
        place(x);
        std::fill(v_.begin(), v_.end(), 0.0);
        each([&](std::size_t k, std::size_t at, std::size_t) { v_[position_ + at] = v[k]; });
        model_.tangent(t_, y_, v_, Jv_);
        evaluations_ += 2;
        each([&](std::size_t k, std::size_t at, std::size_t i) {
            Jv[k] = -model_.particles().mass[i] * Jv_[velocity_ + at];
        });
        return model_.failure().empty();
    }

  private:
    template <class Visit>
    void each(const Visit& visit) const {
        for (std::size_t k = 0; k < free_.size(); ++k)
            for (std::size_t a = 0; a < Dim; ++a) visit(Dim * k + a, Dim * free_[k] + a, free_[k]);
    }
    void place(std::span<const double> x) {
        each([&](std::size_t k, std::size_t at, std::size_t) { y_[position_ + at] = x[k]; });
    }

    Model<Dim>& model_;
    double t_;
    std::vector<double> y_, y_dot_, v_, Jv_;
    std::vector<std::size_t> free_;
    std::size_t evaluations_ = 0;
    std::size_t position_ = model_.layout().find(Field::position, Holder::particle)->offset,
                velocity_ = model_.layout().find(Field::velocity, Holder::particle)->offset;
};

template <int Dim>
void refuse_without_potential(Model<Dim>& model, FreeParticles<Dim>& free) {
    if (const auto why = model.inseparable(); !why.empty())
        throw InputError(fmt::format(
            "equilibrium: forces must be those of a potential, but {}; use a total-Lagrangian solid, springs or pair "
            "potentials without friction",
            why));
    const auto n = static_cast<Eigen::Index>(free.size());
    if (n == 0) throw InputError("equilibrium: all particles are held; leave some free");
    Eigen::VectorXd a(n), b(n), Ja(n), Jb(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        a[k] = std::sin(1.0 + 2.7 * static_cast<double>(k));
        b[k] = std::cos(1.3 * static_cast<double>(k));
    }
    const auto x = free.positions();
    free.derivative(x, {a.data(), x.size()}, {Ja.data(), x.size()});
    free.derivative(x, {b.data(), x.size()}, {Jb.data(), x.size()});
    if (std::abs(a.dot(Jb) - b.dot(Ja)) > 1e-6 * (a.norm() * Jb.norm() + b.norm() * Ja.norm()))
        throw InputError(
            "equilibrium: the derivative of the forces is not symmetric: they have no potential; use a law that has "
            "one (total Lagrangian, springs, pair potentials)");
}

}  // namespace

template <int Dim>
Equilibrium equilibrium(Model<Dim>& model, std::span<const double> y, const std::vector<bool>& held,
                        double tolerance, double t) {
    FreeParticles<Dim> free(model, y, held, t);
    refuse_without_potential(model, free);
    const RootFound found = find_root(
        [&](std::span<const double> x, std::span<double> F) { return free.residual(x, F); },
        free.positions(), {.tolerance = tolerance, .longest_step = 1e3});
    Equilibrium rest;
    std::vector<double> F(found.x.size());
    free.residual(found.x, F);
    for (const double force : F) rest.largest_force = std::max(rest.largest_force, std::abs(force));
    rest.y = free.y();
    rest.newton_steps = found.steps;
    rest.rhs_evaluations = free.rhs_evaluations();
    return rest;
}

template Equilibrium equilibrium<1>(Model<1>&, std::span<const double>, const std::vector<bool>&,
                                    double, double);
template Equilibrium equilibrium<2>(Model<2>&, std::span<const double>, const std::vector<bool>&,
                                    double, double);
template Equilibrium equilibrium<3>(Model<3>&, std::span<const double>, const std::vector<bool>&,
                                    double, double);

}  // namespace spam
