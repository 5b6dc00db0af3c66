// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/io/csv.hpp>
#include <spam/problem/plan.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace spam {

/// Rows of invariants.csv, in memory and on disk.
template <int Dim>
class Recorder {
  public:
    /// `folder`: null for rows in memory only. Throws InputError, and writes nothing, where two columns have one
    /// name.
    Recorder(const Model<Dim>& model, const Plan<Dim>& plan, const RunFolder* folder)
        : model_(&model),
          bodies_(model.particles().bodies()),
          columns_(columns_of(plan)),
          history_(names()) {
        if (folder != nullptr) csv_.emplace(*folder / "invariants.csv", history_.names());
    }

    void add(double t, double dt, std::span<const double> y) {
        const auto now = measure_invariants(*model_, y);
        std::vector<double> row{t, dt, now.mass};
        for (int a = 0; a < Dim; ++a) row.push_back(now.momentum[a]);
        for (int p = 0; p < Invariants<Dim>::planes; ++p) row.push_back(now.angular_momentum[p]);
        row.insert(row.end(), {now.kinetic, now.internal, now.energy});
        for (const auto& account : accounts())
            row.insert(row.end(), y.data() + account.offset,
                       y.data() + account.offset + account.size);
        if constexpr (Dim > 1)
            if (bodies_ > 1) {
                auto L = angular_momentum_of_bodies(*model_, y);
                // the columns of the start
                L.resize(static_cast<std::size_t>(bodies_ * Invariants<Dim>::planes));
                row.insert(row.end(), L.begin(), L.end());
            }
        for (const auto& column : columns_) row.push_back(column.measure(*model_, y));
        if (csv_) csv_->add(row);
        history_.add(std::move(row));
        scales_.add(t, measure_scales(*model_, y));
        if (swing_) swing_->add_to(scales_, t, y);
    }

    /// Of a method that is symplectic with steps dt; `model`: that of the rows.
    void expect_swing(double dt, Model<Dim>& model) { swing_.emplace(Swing{dt, &model}); }

    /// Rows go on with a model of other particles and the same laws.
    void go_on_with(Model<Dim>& model) {
        model_ = &model;
        if (swing_) swing_->model = &model;
    }

    const History& history() const { return history_; }

    /// Columns of the latest row that hold no finite number, and did before: their cells are empty.
    std::vector<std::string> newly_empty() {
        std::vector<std::string> names;
        const auto& row = history_.rows().back();
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (std::isfinite(row[k])) continue;
            const std::string& name = history_.names()[k];
            if (std::find(empty_.begin(), empty_.end(), name) != empty_.end()) continue;
            empty_.push_back(name);
            names.push_back(name);
        }
        return names;
    }

    /// The rows so far; those read are written anew.
    void remember(Archive& archive) {
        archive(history_, scales_, empty_);
        if (!archive.reading() || !csv_) return;
        for (const auto& row : history_.rows()) csv_->add(row);
    }
    std::vector<Drift> drifts(double integrator_limit) const {
        return measure_drifts(history_, model_->promises(), scales_, integrator_limit);
    }

    /// Of the latest row against the first.
    std::vector<Drift> latest_drifts(double integrator_limit) const {
        History both(history_.names());
        both.add(history_.rows().front());
        both.add(history_.rows().back());
        return measure_drifts(both, model_->promises(), scales_, integrator_limit);
    }

  private:
    static std::vector<Column<Dim>> columns_of(const Plan<Dim>& plan) {
        std::vector<Column<Dim>> all;
        for (const auto& one : plan.observers)
            all.insert(all.end(), one.columns.begin(), one.columns.end());
        return all;
    }

    /// What a symplectic method makes of the energy. Leapfrog keeps E + dt^2 (v . E'' v/12 - sum m |v_dot|^2/24),
    /// E'' the second derivatives in positions, but for higher orders; other methods are nearer to E. The first term
    /// follows from how forces change in a step along v.
    struct Swing {
        double dt;
        Model<Dim>* model;

        void add_to(DriftScales& scales, double t, std::span<const double> y) const {
            const auto v = ConstState<Dim>(model->layout(), y).velocity();
            const Points<Dim> after = accelerations(0.5 * dt, t, y),
                              before = accelerations(-0.5 * dt, t, y);
            const auto [squares, bent] = exact_sums(model->particles().size(), [&](std::size_t k) {
                const auto i = static_cast<Eigen::Index>(k);
                const double m = model->particles().mass[k];
                return std::array<double, 2>{
                    0.5 * m * (after.col(i).squaredNorm() + before.col(i).squaredNorm()),
                    m * v.col(i).dot(before.col(i) - after.col(i)) / dt};
            });
            scales.add_swing(dt, std::abs(bent) / 12.0 + squares / 24.0);
        }

      private:
        /// Where the particles would be after so long a time without forces.
        Points<Dim> accelerations(double drift, double t, std::span<const double> y) const {
            std::vector<double> moved(y.begin(), y.end()), y_dot(y.size());
            const State<Dim> state(model->layout(), moved);
            state.position() += drift * state.velocity();
            model->rates(t, moved, y_dot);
            return ConstState<Dim>(model->layout(), y_dot).velocity();
        }
    };

    /// What externals and walls have given.
    std::vector<typename FieldLayout<Dim>::Block> accounts() const {
        std::vector<typename FieldLayout<Dim>::Block> accounts;
        for (const auto& block : model_->layout().blocks())
            if (block.field.role() == Role::account) accounts.push_back(block);
        return accounts;
    }

    std::vector<std::string> names() const {
        std::vector<std::string> result{"t", "dt", "mass"};
        const std::vector<std::string> axes{"x", "y", "z"};
        for (std::size_t a = 0; a < Dim; ++a) result.push_back("momentum_" + axes[a]);
        if (Dim == 2) result.emplace_back("angular_momentum");
        if (Dim == 3)
            for (const auto& axis : axes) result.push_back("angular_momentum_" + axis);
        result.insert(result.end(), {"kinetic", "internal", "energy"});
        for (const auto& account : accounts())
            for (std::size_t c = 0; c < account.components; ++c)
                result.push_back(std::string(account.field.name()) +
                                 account.field.template suffix<Dim>(c));
        if (Dim > 1 && bodies_ > 1)
            for (int b = 1; b <= bodies_; ++b)
                for (int p = 0; p < Invariants<Dim>::planes; ++p)
                    result.push_back(fmt::format("angular_momentum_body_{}{}", b,
                                                 Dim == 2 ? "" : "_" + axes[std::size_t(p)]));
        for (const auto& column : columns_) {
            if (column.name.empty() || column.name.find_first_of(",\"\r\n") != std::string::npos)
                throw InputError(fmt::format(
                    "columns: the name '{}' is empty or has a comma, a quote or a line's end; "
                    "choose another name",
                    column.name));
            if (std::find(result.begin(), result.end(), column.name) != result.end())
                throw InputError(fmt::format(
                    "columns: there is a column '{}' already; choose another name", column.name));
            result.push_back(column.name);
        }
        return result;
    }

    const Model<Dim>* model_;
    std::int32_t bodies_;
    std::vector<Column<Dim>> columns_;  ///< of the observers
    History history_;
    std::optional<CsvWriter> csv_;
    DriftScales scales_;
    std::optional<Swing> swing_;
    std::vector<std::string> empty_;  ///< columns that have had empty cells
};

}  // namespace spam
