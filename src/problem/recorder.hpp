// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/diagnostics/invariants.hpp>
#include <spam/io/csv.hpp>
#include <spam/problem/plan.hpp>

#include <fmt/format.h>

namespace spam {

/// Rows of invariants.csv, in memory and on disk.
template <int Dim>
class Recorder {
  public:
    Recorder(const Model<Dim>& model, const Plan<Dim>& plan, const RunFolder& folder)
        : model_(model),
          plan_(plan),
          history_(names(model, plan)),
          csv_(folder / "invariants.csv", history_.names()) {}

    void add(double t, double dt, std::span<const double> y) {
        const auto now = measure_invariants(model_, y);
        std::vector<double> row{t, dt, now.mass};
        for (int a = 0; a < Dim; ++a) row.push_back(now.momentum[a]);
        for (int p = 0; p < Invariants<Dim>::planes; ++p) row.push_back(now.angular_momentum[p]);
        row.insert(row.end(), {now.kinetic, now.internal, now.energy});
        if constexpr (Dim == 2)
            if (model_.particles().bodies() > 1)
                for (const double L : angular_momentum_of_bodies(model_, y)) row.push_back(L);
        for (const auto& column : plan_.columns) row.push_back(column.measure(model_, y));
        csv_.add(row);
        history_.add(std::move(row));
        const auto scales = measure_scales(model_, y);
        momentum_scale_ = std::max(momentum_scale_, scales.momentum);
        angular_momentum_scale_ = std::max(angular_momentum_scale_, scales.angular_momentum);
    }

    const History& history() const { return history_; }
    std::vector<Drift> drifts(double integrator_limit) const {
        return measure_drifts(history_, model_.promises(), momentum_scale_, angular_momentum_scale_,
                              integrator_limit);
    }

  private:
    static std::vector<std::string> names(const Model<Dim>& model, const Plan<Dim>& plan) {
        std::vector<std::string> result{"t", "dt", "mass"};
        const std::vector<std::string> axes{"x", "y", "z"};
        for (std::size_t a = 0; a < Dim; ++a) result.push_back("momentum_" + axes[a]);
        if (Dim == 2) result.emplace_back("angular_momentum");
        if (Dim == 3)
            for (const auto& axis : axes) result.push_back("angular_momentum_" + axis);
        result.insert(result.end(), {"kinetic", "internal", "energy"});
        if (Dim == 2 && model.particles().bodies() > 1)
            for (int b = 1; b <= model.particles().bodies(); ++b)
                result.push_back(fmt::format("angular_momentum_body_{}", b));
        for (const auto& column : plan.columns) result.push_back(column.name);
        return result;
    }

    const Model<Dim>& model_;
    const Plan<Dim>& plan_;
    History history_;
    CsvWriter csv_;
    double momentum_scale_ = 0.0, angular_momentum_scale_ = 0.0;
};

}  // namespace spam
