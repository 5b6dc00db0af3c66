// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/diagnostics/total_energy.hpp>
#include <spam/integrate/integrator.hpp>
#include <spam/rhs/model.hpp>

#include <algorithm>
#include <memory>

namespace spam::test {

/// A small model with its state at the start, as integrators see it.
struct System {
    std::unique_ptr<Model<2>> model;
    std::vector<double> y0;
    Ode ode{};

    System(std::unique_ptr<Model<2>> of, std::vector<double> start, double atol = 1e-10)
        : model(std::move(of)),
          y0(std::move(start)) {
        ode.rates = [this](double t, std::span<const double> y, std::span<double> y_dot) {
            model->rates(t, y, y_dot);
        };
        ode.failure = [this] { return model->failure(); };
        ode.entry_name = [](std::size_t k) { return "entry " + std::to_string(k); };
        ode.inseparable = model->inseparable();
        ode.energy = [this](std::span<const double> y) { return total_energy(*model, y); };
        ode.energy_gradient = [this](double t, std::span<const double> y,
                                     std::span<double> gradient) {
            return energy_gradient(*model, t, y, gradient);
        };
        for (const auto& block : model->layout().blocks()) {
            if (block.field.role() == Role::account)
                ode.accounts += block.size;
            else
                ode.blocks.push_back({std::string(block.field.name()), block.offset, block.size});
            ode.absolute_tolerance.insert(ode.absolute_tolerance.end(), block.size, atol);
        }
    }
    System(const System&) = delete;  // ode refers to it
    System& operator=(const System&) = delete;
};

/// y0 in a vector of the context.
inline Vector start_of(const System& system, const SundialsContext& context) {
    Vector y(system.y0.size(), context);
    std::copy(system.y0.begin(), system.y0.end(), y.span().begin());
    return y;
}

inline double largest_difference(std::span<const double> a, std::span<const double> b) {
    double largest = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
    return largest;
}

}  // namespace spam::test
