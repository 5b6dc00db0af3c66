// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/analysis/material_point.hpp>

#include <algorithm>
#include <limits>

namespace spam {

template <int Dim>
FieldLayout<Dim> MaterialPoint<Dim>::layout_of(const Material<Dim>& material) {
    FieldLayout<Dim> layout(1, {Field::density, Field::stress, Field::energy});
    for (const Field field : material.history()) layout.add(field);
    return layout;
}

template <int Dim>
MaterialPoint<Dim>::MaterialPoint(const Material<Dim>& material, Gradient gradient,
                                  const IntegratorOptions& options, double density)
    : material_(material),
      gradient_(std::move(gradient)),
      layout_(layout_of(material)),
      y_(layout_.size(), context_) {
    State<Dim>(layout_, y_.span()).density()(0, 0) = density;
    ode_.rates = [this](double t, std::span<const double> y, std::span<double> y_dot) {
        rates(t, y, y_dot);
    };
    ode_.failure = [] { return std::string(); };
    ode_.entry_name = [this](std::size_t k) { return layout_.entry_name(k); };
    if (std::any_of(layout_.blocks().begin(), layout_.blocks().end(),
                    [](const auto& block) { return block.field.role() == Role::history; }))
        ode_.settle = [this](double t, std::span<double> y) {
            return material_.settle(t, 0, 1, State<Dim>(layout_, y));
        };
    for (const auto& block : layout_.blocks()) {
        ode_.blocks.push_back({std::string(block.field.name()), block.offset, block.size});
        ode_.absolute_tolerance.insert(ode_.absolute_tolerance.end(), block.size,
                                       block.field.role() == Role::integrated
                                           ? options.absolute_tolerance(block.field.name(), 1.0)
                                           : std::numeric_limits<double>::infinity());
    }
    integrator_ = make_integrator(options, ode_, y_, 0.0, context_);
}

template <int Dim>
void MaterialPoint<Dim>::rates(double t, std::span<const double> y, std::span<double> y_dot) const {
    std::fill(y_dot.begin(), y_dot.end(), 0.0);
    const ConstState<Dim> state(layout_, y);
    const State<Dim> rate(layout_, y_dot);
    SymTensor<Dim> stress;
    material_.return_stress(t, 0, 1, state, stress.c.data());
    const Mat<Dim> grad_v = gradient_(t);
    const std::uint32_t self = 0;
    material_.stress_rates({&self, 1}, {&grad_v, 1}, stress.c.data(), state, rate);
    const double rho = state.density()(0, 0);
    double power = 0.0;
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) power += stress(a, b) * grad_v(a, b);
    rate.density()(0, 0) = -rho * grad_v.trace();
    rate.energy()(0, 0) = power / rho;
}

template <int Dim>
void MaterialPoint<Dim>::advance_to(double t) {
    while (integrator_->t() < t) integrator_->step(t);
}

template <int Dim>
SymTensor<Dim> MaterialPoint<Dim>::stress() const {
    return numbers_at<SymTensor<Dim>>(ConstState<Dim>(layout_, y_.span()).stress().data());
}

template <int Dim>
double MaterialPoint<Dim>::value(Field field) const {
    return ConstState<Dim>(layout_, y_.span()).field(field)(0, 0);
}

template class MaterialPoint<2>;
template class MaterialPoint<3>;

}  // namespace spam
