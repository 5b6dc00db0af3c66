// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>
#include <spam/material/material.hpp>

#include <functional>
#include <memory>

namespace spam {

/// One particle of a material on a prescribed way of deformation: y = (stress and history of the law, energy,
/// density), integrated by any method, without neighbours. For laws and methods by themselves.
template <int Dim>
class MaterialPoint {
  public:
    /// (grad v)_ab = d v_b/d x_a at time t.
    using Gradient = std::function<Mat<Dim>(double t)>;

    /// At rest, without stress or energy, at t = 0. Throws InputError as make_integrator() does.
    MaterialPoint(const Material<Dim>& material, Gradient gradient,
                  const IntegratorOptions& options, double density = 1.0);
    MaterialPoint(const MaterialPoint&) = delete;
    MaterialPoint& operator=(const MaterialPoint&) = delete;

    void advance_to(double t);
    double t() const { return integrator_->t(); }
    SymTensor<Dim> stress() const;
    /// The first component of a field of the law.
    double value(Field field) const;
    /// Stress power by mass, integrated.
    double energy() const { return value(Field::energy); }
    const Integrator::Statistics& statistics() const { return integrator_->statistics(); }

  private:
    static FieldLayout<Dim> layout_of(const Material<Dim>& material);
    void rates(double t, std::span<const double> y, std::span<double> y_dot) const;

    Material<Dim> material_;
    Gradient gradient_;
    FieldLayout<Dim> layout_;
    SundialsContext context_;
    Vector y_;
    Ode ode_;
    std::unique_ptr<Integrator> integrator_;
};

extern template class MaterialPoint<2>;
extern template class MaterialPoint<3>;

}  // namespace spam
