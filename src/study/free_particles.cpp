// SPDX-License-Identifier: GPL-3.0-or-later
#include "free_particles.hpp"

#include <spam/core/error.hpp>

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {

template <int Dim>
FreeParticles<Dim>::FreeParticles(Model<Dim>& model, std::span<const double> y,
                                  const std::vector<bool>& held, double t)
    : model_(model),
      t_(t),
      y_(y.begin(), y.end()),
      y_dot_(y.size()),
      v_(y.size()),
      Jv_(y.size()),
      position_(model.layout().find(Field::position, Holder::particle)->offset),
      velocity_(model.layout().find(Field::velocity, Holder::particle)->offset) {
    if (held.size() != model.particles().size())
        throw InputError(
            fmt::format("held: {} values are given for {} particles; give one for each",
                        held.size(), model.particles().size()));
    for (std::size_t i = 0; i < held.size(); ++i)
        if (!held[i]) free_.push_back(i);
    State<Dim>(model.layout(), y_).velocity().setZero();
}

template <int Dim>
std::vector<double> FreeParticles<Dim>::positions() const {
    std::vector<double> x(size());
    each([&](std::size_t k, std::size_t at, std::size_t) { x[k] = y_[position_ + at]; });
    return x;
}

template <int Dim>
std::vector<double> FreeParticles<Dim>::masses() const {
    std::vector<double> m(size());
    each([&](std::size_t k, std::size_t, std::size_t i) { m[k] = model_.particles().mass[i]; });
    return m;
}

template <int Dim>
void FreeParticles<Dim>::place(std::span<const double> x) {
    each([&](std::size_t k, std::size_t at, std::size_t) { y_[position_ + at] = x[k]; });
}

template <int Dim>
bool FreeParticles<Dim>::residual(std::span<const double> x, std::span<double> F) {
    place(x);
    model_.rates(t_, y_, y_dot_);
    ++evaluations_;
    each([&](std::size_t k, std::size_t at, std::size_t i) {
        F[k] = -model_.particles().mass[i] * y_dot_[velocity_ + at];
    });
    return model_.failure().empty();
}

template <int Dim>
bool FreeParticles<Dim>::derivative(std::span<const double> x, std::span<const double> v,
                                    std::span<double> Kv) {
    place(x);
    std::fill(v_.begin(), v_.end(), 0.0);
    each([&](std::size_t k, std::size_t at, std::size_t) { v_[position_ + at] = v[k]; });
    model_.tangent(t_, y_, v_, Jv_);
    evaluations_ += 2;
    each([&](std::size_t k, std::size_t at, std::size_t i) {
        Kv[k] = -model_.particles().mass[i] * Jv_[velocity_ + at];
    });
    return model_.failure().empty();
}

template <int Dim>
void FreeParticles<Dim>::require_potential(std::string_view whose) {
    if (const auto why = model_.inseparable(); !why.empty())
        throw InputError(fmt::format(
            "{}: forces must be those of a potential, but {}; use a total-Lagrangian solid, springs or pair "
            "potentials without friction",
            whose, why));
    // Rows of material vectors are renewed seldom, and give the forces of the same potential then.
    if (model_.settles() && !model_.settles_seldom())
        throw InputError(fmt::format(
            "{}: particles yield, break or are reflected, and come to rest where their history leaves them; use an "
            "elastic law without walls that reflect",
            whose));
    const auto n = static_cast<Eigen::Index>(size());
    if (n == 0) throw InputError(fmt::format("{}: all particles are held; leave some free", whose));
    Eigen::VectorXd a(n), b(n), Ka(n), Kb(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        a[k] = std::sin(1.0 + 2.7 * static_cast<double>(k));
        b[k] = std::cos(1.3 * static_cast<double>(k));
    }
    const auto x = positions();
    derivative(x, {a.data(), x.size()}, {Ka.data(), x.size()});
    derivative(x, {b.data(), x.size()}, {Kb.data(), x.size()});
    if (std::abs(a.dot(Kb) - b.dot(Ka)) > 1e-6 * (a.norm() * Kb.norm() + b.norm() * Ka.norm()))
        throw InputError(fmt::format(
            "{}: the derivative of the forces is not symmetric: they have no potential; use a law that has one (total "
            "Lagrangian, springs, pair potentials)",
            whose));
}

SPAM_COMPILED(template class FreeParticles);

}  // namespace spam
