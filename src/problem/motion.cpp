// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/parts.hpp>
#include <spam/diagnostics/total_energy.hpp>
#include <spam/integrate/interrupt.hpp>
#include <spam/problem/motion.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace spam {
namespace {

template <int Dim>
void add_energy(Ode& ode, Model<Dim>& model, std::size_t& pair_interactions) {
    ode.no_energy = why_no_energy(model);
    if (!ode.no_energy.empty()) return;
    ode.energy = [&model](std::span<const double> y) { return total_energy(model, y); };
    ode.energy_gradient = [&](double t, std::span<const double> y, std::span<double> gradient) {
        const std::size_t evaluations = energy_gradient(model, t, y, gradient);
        pair_interactions += evaluations * model.pairs();
        return evaluations;
    };
}

}  // namespace

template <int Dim>
Ode as_ode(Model<Dim>& model, const IntegratorOptions& options, std::size_t& pair_interactions) {
    Ode ode;
    ode.rates = [&](double t, std::span<const double> y, std::span<double> y_dot) {
        model.rates(t, y, y_dot);
        pair_interactions += model.pairs();
    };
    ode.failure = [&model] { return model.failure(); };
    ode.entry_name = [&model](std::size_t k) {
        const auto entry = model.layout().entry(k);
        std::string name = model.layout().entry_name(k);
        if (entry.field.role() == Role::account) return name;
        if (entry.holder == Holder::element)
            return fmt::format("{} of element {}", name, entry.number);
        return fmt::format("{} of particle {}", name, model.particles().id[entry.number]);
    };
    ode.time_scale = model.time_scale();
    ode.events = model.events();
    if (model.settles())
        ode.settle = [&model](double t, std::span<double> y) { return model.settle(t, y); };
    ode.settles_seldom = model.settles_seldom();
    ode.inseparable = model.inseparable();
    add_energy(ode, model, pair_interactions);
    for (const auto& block : model.layout().blocks())
        if (block.field.role() == Role::account)
            ode.accounts += block.size;
        else
            ode.blocks.push_back({std::string(block.field.name()), block.offset, block.size});
    // With fixed steps GSL alone wants them, and they are as long as y.
    if (!options.adaptive() && options.method.find("gsl:") != 0) return ode;
    ode.absolute_tolerance.resize(model.layout().size());
    // Accounts and what only changes between steps have no say in how long steps are.
    for (const auto& block : model.layout().blocks())
        std::fill_n(ode.absolute_tolerance.begin() + static_cast<std::ptrdiff_t>(block.offset),
                    block.size,
                    block.field.role() == Role::integrated
                        ? options.absolute_tolerance(block.field.name(), block.scale)
                        : std::numeric_limits<double>::infinity());
    return ode;
}

template <int Dim>
Motion<Dim>::Motion(Model<Dim>& model, std::span<const double> y0, const IntegratorOptions& options,
                    double t0)
    : model_(model),
      y_(y0.size(), context_),
      ode_(as_ode(model, options, pairs_)) {
    Parts::here().copies = ode_.accounts;
    std::copy(y0.begin(), y0.end(), y_.span().begin());
    integrator_ = make_integrator(options, ode_, y_, t0, context_);
}

template <int Dim>
void Motion<Dim>::advance_to(double t) {
    while (integrator_->t() < t) {
        InterruptWatch::check();
        integrator_->step(t);
    }
}

template <int Dim>
bool Motion<Dim>::edit(const std::function<bool(std::span<double> y)>& change) {
    if (!change(y_.span())) return false;
    integrator_->reset(integrator_->t());
    return true;
}

template <int Dim>
void Motion<Dim>::remember(Archive& archive) {
    model_.remember(archive);
    integrator_->remember(archive);
}

#define SPAM_INSTANTIATE(D) template Ode as_ode(Model<D>&, const IntegratorOptions&, std::size_t&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)
SPAM_COMPILED(template class Motion);

}  // namespace spam
